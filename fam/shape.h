// A solved rod at any place: poses, strains and wrenches inside its arcs, and the wrenches that balance its loads.
//
// Dense output. Inside an arc the law's own step of the part from the arc's distal end to the place gives pose and
// wrench, to the law's order; at the arc's proximal end it is the arc itself. The published law's position lies on its
// cubic Bezier curve (where the arc bends by less than half a turn), its twist is spread evenly.
//
// Balance. The total internal wrench at a place is the sum of the loads beyond it on the returned shape: for fixed
// loads the force is exact, and the moment as accurate as the shape, whatever the arcs' series left of theirs. The
// rod's own is that less the tendons' pulls T t/|t| and r x T t/|t|, t = v + u x r.
#pragma once

#include "fam/arc_law.h"
#include "fam/march.h"

#include <array>
#include <vector>

namespace fam {

// Gauss points and weights of order eight on [0, 1].
constexpr std::array<double, 4> gauss_points{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                             0.93056815579702629};
constexpr std::array<double, 4> gauss_weights{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                              0.17392742256872693};

// The inside of an arc of a span. The series of sixth_order is made for the first place and serves all;
// another law takes its step over the part beyond the place.
template <int D>
class ArcInterior {
 public:
  // Keeps views of the rod and the span.
  ArcInterior(const SolvedRod<D>& rod, const SpanArcs<D>& span, int arc) : rod_(&rod), span_(&span), arc_(arc) {}

  int arc() const { return arc_; }
  const SpanArcs<D>& span() const { return *span_; }
  // At a fraction in [0, 1] of the arc's length from its proximal end: pose, and total wrench as the law carries it
  // (coupled laws).
  BasicPose<D> pose(double fraction);
  BasicWrench<double, D> wrench(double fraction);

 private:
  template <bool with_shear>
  BasicMotion<double, D> step(double fraction, BasicWrench<double, D>& wrench);
  BasicMotion<double, D> step(double fraction, BasicWrench<double, D>& wrench);

  const SolvedRod<D>* rod_;
  const SpanArcs<D>* span_;
  int arc_;
  bool has_series_ = false;
  RodSeries<double, D, 7> series_;       // with distributed forces
  RodSeries<double, D, 6> first_terms_;  // without
};

// Whether a straight tendon (fam/tendon.h), which the laws do not check, has collapsed (smallest_tendon_stretch).
template <int D>
bool any_tendon_collapsed(const SolvedRod<D>& rod);

// Where v + u x r of a tendon that is not straight changes from an arc to the next by more than it is, the tendon all
// but collapses between them, unseen: by how much the turns of two such arcs differ, at most.
template <int D>
double unseen_turn_rad(const SolvedRod<D>& rod);

template <int D>
class BasicShape {
 public:
  void reserve(std::size_t arcs);
  // Keeps the rod's views. Cost linear in the arcs; takes memory where there are more than ever before.
  void set(const SolvedRod<D>& rod);

  // Pose, and the rod's own internal wrench (base frame, of the side towards the clamp, loads included).
  struct Section {
    BasicPose<D> pose;
    BasicWrench<double, D> own_B;
  };
  ArcInterior<D> interior(int arc) const { return {rod_, span_of(arc), arc}; }
  Section section(ArcInterior<D>& arc, double fraction) const;
  BasicScrew<double, D> strain_per_mm(ArcInterior<D>& arc, double fraction) const;  // (u, v)

 private:
  // Of all, tendons' pulls among it: base frame; section frame.
  BasicWrench<double, D> total_B(ArcInterior<D>& arc, double fraction, const BasicPose<D>& pose) const;
  BasicScrew<double, D> strain_under(const SpanArcs<D>& span, const BasicWrench<double, D>& total_S) const;
  BasicWrench<double, D> wrench_towards(ArcInterior<D>& arc, double fraction, const BasicPose<D>& pose) const;
  const SpanArcs<D>& span_of(int arc) const {
    return rod_.spans[static_cast<std::size_t>(span_of_arc_[static_cast<std::size_t>(arc)])];
  }

  SolvedRod<D> rod_;
  std::vector<int> span_of_arc_;
  std::vector<BasicWrench<double, D>> distal_totals_B_;  // at the arcs' distal ends, loads there included
  BasicWrench<double, D> base_total_B_;
};

}  // namespace fam
