// A solved rod in space and in its own section frames, whatever it was solved as: in the plane, as a march, as a round
// rod without torsion.
#pragma once

#include "fam/shape.h"
#include "fam/tolerance.h"

#include "scene/equilibrium.h"

namespace fam {

// A place along the rod: a fraction in [0, 1] of an arc.
struct Place {
  int arc;
  double fraction;
};

class Solution {
 public:
  void reserve(const Room& room);
  // Of a converged run, which must stay as it is; takes memory where there are more arcs than ever before.
  void set(const Problem& problem, const Run& run);

  int arc_count() const { return run_->arc_count(); }
  // 0 <= s <= L; at the end of an arc that arc, at the clamp the first.
  Place place_at(double s_mm) const;
  double arc_end_mm(int arc) const;

  scene::Pose pose(const Place& place) const;
  // Base axes in the section frame, and the total internal wrench there as the law carries it (coupled laws); at an
  // arc's distal end with the loads at that place.
  SectionState<3> state(const Place& place) const { return state(place, pose(place)); }
  SectionState<3> state(const Place& place, const scene::Pose& pose_there) const;
  // What the section there is turned about the tangent beyond the rod that was solved: of a round rod, by GJ; else 0.
  double twist_rad(const Place& place) const;
  // The rod's own, as scene::Station has it.
  scene::Wrench own_wrench_B(const Place& place) const;

 private:
  std::size_t span_of(int arc) const;
  double length_of_arc_mm(std::size_t span) const;
  void shape() const;

  const Problem* problem_ = nullptr;
  const Run* run_ = nullptr;
  mutable bool is_shaped_ = false;  // made when first asked for
  mutable BasicShape<2> planar_shape_;
  mutable BasicShape<3> shape_;
  std::vector<int> first_arc_;     // of each span, and one more
  std::vector<double> twist_rad_;  // of a round rod, at the arcs' proximal ends: what GJ adds
};

}  // namespace fam
