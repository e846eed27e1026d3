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
#include "fam/poses_in_arc.h"

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
  PosesAtOnce<D> poses(const PlacesAtOnce& fractions);
  BasicWrench<double, D> wrench(double fraction);
  // (u, v) by the series about the arc's distal end, of whatever law.
  BasicScrew<double, D> strain_per_mm(double fraction);

 private:
  void make_series();
  template <bool with_shear>
  void make_series();
  template <bool with_shear>
  BasicMotion<double, D> step(double fraction, BasicWrench<double, D>& wrench);
  BasicMotion<double, D> step(double fraction, BasicWrench<double, D>& wrench);

  const SolvedRod<D>* rod_;
  const SpanArcs<D>* span_;
  int arc_;
  bool has_series_ = false;
  RodSeries<double, D, 7> series_;
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
  // after_arc(arc): sees the interior of each, from the tip; what lies from there on may be asked for.
  template <class AfterArc>
  void set(const SolvedRod<D>& rod, const AfterArc& after_arc);
  void set(const SolvedRod<D>& rod) {
    set(rod, [](const auto&) {});
  }

  // Pose, and the rod's own internal wrench (base frame, of the side towards the clamp, loads included).
  struct Section {
    BasicPose<D> pose;
    BasicWrench<double, D> own_B;
  };
  using Sections = std::array<Section, places_at_once>;
  ArcInterior<D> interior(int arc) const { return {rod_, span_of(arc), arc}; }
  // At no more fractions of an arc than places_at_once.
  Sections sections(ArcInterior<D>& arc, std::span<const double> fractions) const;
  Section section(ArcInterior<D>& arc, double fraction) const;

 private:
  void begin(const SolvedRod<D>& rod);
  // Total wrenches, tendons' pulls among them: base frame; section frame.
  void add_point_loads(const SpanArcs<D>& span, BasicWrench<double, D>& total_B) const;
  BasicWrench<double, D> proximal_total_B(ArcInterior<D>& arc) const;
  void take_pulls_off(const SpanArcs<D>& span, Section& section) const;
  Sections totals(ArcInterior<D>& arc, std::span<const double> fractions) const;
  BasicWrench<double, D> wrench_towards(const ArcInterior<D>& arc, double fraction,
                                        std::span<const BasicPose<D>> poses) const;
  BasicScrew<double, D> strain_under(const SpanArcs<D>& span, const BasicWrench<double, D>& total_S) const;
  const SpanArcs<D>& span_of(int arc) const {
    return rod_.spans[static_cast<std::size_t>(span_of_arc_[static_cast<std::size_t>(arc)])];
  }

  SolvedRod<D> rod_;
  std::vector<int> span_of_arc_;
  std::vector<BasicWrench<double, D>> distal_totals_B_;  // at the arcs' distal ends, loads there included
};

template <int D>
template <class AfterArc>
void BasicShape<D>::set(const SolvedRod<D>& rod, const AfterArc& after_arc) {
  begin(rod);
  BasicWrench<double, D> total_B;
  for (std::size_t i = rod_.spans.size(); i-- > 0;) {
    const SpanArcs<D>& span = rod_.spans[i];
    add_point_loads(span, total_B);
    for (int k = span.end_arc; k-- > span.first_arc;) {
      distal_totals_B_[static_cast<std::size_t>(k)] = total_B;
      ArcInterior<D> arc(rod_, span, k);
      total_B = proximal_total_B(arc);
      after_arc(arc);
    }
  }
}

}  // namespace fam
