// The tip-to-clamp march: follower loads are known at the tip, so each arc in turn gets its strain from the wrench
// at its distal end and hands the wrench on. One pass, cost linear in the arcs, no iteration, no heap allocation.
#pragma once

#include "fam/arc_law.h"
#include "fam/loaded_rod.h"

#include "scene/equilibrium.h"
#include "scene/span.h"

#include <span>
#include <vector>

namespace fam {

// A solved rod: what shape.h reads. The views last as long as their solver, until it solves again.
template <int D>
struct SolvedRod {
  std::span<const SpanArcs<D>> spans;  // clamp to tip, as all here
  std::span<const BasicArc<D>> arcs;
  std::span<const BasicPose<D>> poses;                        // of the arcs' ends, one more than arcs
  std::span<const BasicWrench<double, D>> distal_wrenches_S;  // total, at each arc's distal end, its loads included
  Law law;
  RodModel model;
  TwistOrder twist_order = TwistOrder::bend_twist;
};

// In space, D = 3, or for rods in the x-y plane, D = 2 (spans with nothing out of it; coupled laws only).
template <int D>
class BasicMarch {
 public:
  void reserve(const Room& room);
  // Takes memory where more arcs or spans are asked for than ever before; nothing else here does. arcs_per_span: at
  // least one arc for each span. The spans must carry follower loads and tendons only; law and model must not be
  // automatic. Published: Kirchhoff rods with EI_y = EI_z.
  void set(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law, RodModel model,
           TwistOrder twist_order = TwistOrder::bend_twist);

  // Solves. converged, arc_not_converged (failed_arc() says which), tendon_collapsed or not_finite.
  scene::Status run() noexcept;

  int arc_count() const { return static_cast<int>(arcs_.size()); }
  // Clamp to tip, after run(): arcs, and the poses of their ends (one more than arcs).
  const std::vector<BasicArc<D>>& arcs() const { return arcs_; }
  const std::vector<BasicPose<D>>& poses() const { return poses_; }
  int failed_arc() const { return failed_arc_; }
  SolvedRod<D> solved() const { return {spans_, arcs_, poses_, distal_wrenches_S_, law_, model_, twist_order_}; }

 private:
  template <class MarchSpan>
  void march(MarchSpan&& march_span);
  template <class CoupledLaw, bool with_shear>
  void run_law();
  void run_published();
  void place_arcs();

  scene::Reused<SpanArcs<D>> spans_;
  std::vector<BasicArc<D>> arcs_;
  std::vector<BasicMotion<double, D>> motions_;  // of the arcs
  std::vector<BasicPose<D>> poses_;
  std::vector<BasicWrench<double, D>> distal_wrenches_S_;  // of the arcs
  BasicWrench<double, D> base_wrench_;
  Law law_ = AutomaticLaw::facts.law;
  RodModel model_ = RodModel::kirchhoff;
  TwistOrder twist_order_ = TwistOrder::bend_twist;
  int failed_arc_ = -1;
  bool tendon_collapsed_ = false;
};

using March = BasicMarch<3>;

}  // namespace fam
