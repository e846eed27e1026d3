// The tip-to-clamp march: follower loads are known at the tip, so each arc in turn gets its strain from the wrench
// at its distal end and hands the wrench on. One pass, cost linear in the arcs, no iteration, no heap allocation.
#pragma once

#include "fam/arc_law.h"

#include "scene/equilibrium.h"
#include "scene/span.h"

#include <span>
#include <vector>

namespace fam {

// In space, D = 3, or for rods in the x-y plane, D = 2 (spans with nothing out of it; Law::published in space only).
template <int D>
class BasicMarch {
 public:
  // Allocates all it needs. arcs_per_span: at least one arc for each span. The spans must carry follower loads and
  // tendons only; law and model must not be automatic. Published: Kirchhoff rods with EI_y = EI_z.
  BasicMarch(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law, RodModel model,
             TwistOrder twist_order = TwistOrder::bend_twist);

  // Solves. converged, arc_not_converged (failed_arc() says which) or not_finite.
  scene::Status run() noexcept;

  int arc_count() const { return static_cast<int>(arcs_.size()); }
  // Clamp to tip, after run(): arcs, and the poses of their ends (one more than arcs).
  const std::vector<BasicArc<D>>& arcs() const { return arcs_; }
  const std::vector<BasicPose<D>>& poses() const { return poses_; }
  // Internal force and moment at the clamp, tendons included; the clamp's section frame is the base frame.
  const BasicWrench<double, D>& base_wrench() const { return base_wrench_; }
  int failed_arc() const { return failed_arc_; }

 private:
  struct SpanArcs {
    BasicArcConstants<D> constants;
    int first_arc;
    int arc_count;
    BasicWrench<double, D> load_S;    // follower loads at the span's distal end
    BasicWrench<double, D> tendon_S;  // internal wrench of the tendons in the span
  };

  template <class Step>
  void march(Step&& step);
  template <bool with_shear>
  void run_law();
  bool run_published();
  void place_arcs();

  std::vector<SpanArcs> spans_;
  std::vector<BasicArc<D>> arcs_;
  std::vector<BasicMotion<double, D>> motions_;  // of the arcs
  std::vector<BasicPose<D>> poses_;
  BasicWrench<double, D> base_wrench_;
  Law law_;
  RodModel model_;
  TwistOrder twist_order_;
  int failed_arc_ = -1;
};

using March = BasicMarch<3>;

}  // namespace fam
