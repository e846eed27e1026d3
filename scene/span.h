// A scene cut at everything that is not smooth: section changes, point loads, ends of distributed loads and tendons.
// Bookkeeping that every method needs and none owns; there is no mechanics in it.
#pragma once

#include "scene/reused.h"
#include "scene/scene.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace scene {

// The tendons that run through a section at one place, summed.
struct SectionTendon {
  Eigen::Vector3d arm_S_mm = Eigen::Vector3d::Zero();  // r = (0, y, z)
  double tension_N = 0;
};

// A stretch of rod with one section and the same loads all along it.
struct Span {
  double start_mm = 0;
  double end_mm = 0;
  Stiffness stiffness;
  Eigen::Vector3d rest_curvature_per_mm = Eigen::Vector3d::Zero();

  // Point loads at end_mm, summed.
  Wrench follower_load_S;  // in the section frame at end_mm; forces off the centreline with their moments
  Wrench fixed_load_B;     // in the base frame
  // Sum of F_B r_S^T over the fixed forces off the centreline (the astatic tensor of their lever arms): their moment
  // about the centreline, sum r x (R^T F) in the section frame, is the axial vector of R^T times it (moment_of_arms).
  Eigen::Matrix3d fixed_force_arms_BS_Nmm = Eigen::Matrix3d::Zero();

  // Distributed forces all along the span, gravity included.
  Eigen::Vector3d follower_force_S_N_per_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d fixed_force_B_N_per_mm = Eigen::Vector3d::Zero();

  std::vector<SectionTendon> tendons;  // with different offsets, none slack

  // Takes all loads off; the tendons' memory stays.
  void unload();

  double length_mm() const { return end_mm - start_mm; }
  bool has_fixed_point_load() const { return !fixed_load_B.is_zero() || !fixed_force_arms_BS_Nmm.isZero(0); }
};

// sum r x f over the pairs that the tensor A = sum f r^T holds, f and r in one frame.
template <class T>
Eigen::Matrix<T, 3, 1> moment_of_arms(const Eigen::Matrix<T, 3, 3>& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

// The spans of a valid scene, clamp to tip. Cost linear in sections + loads, but for the sort of the places and
// for distributed loads and tendons, which visit each span they cover.
std::vector<Span> spans_of(const Scene& scene);

// The same again and again for scenes with the same sections and loads but other values and places, without taking
// memory after reserve().
class SpanCutter {
 public:
  // Memory for this scene, wherever its loads move; `scenes` of them cut together.
  void reserve(const Scene& scene, std::size_t scenes = 1);
  // At everything that is not smooth in any of the scenes, which differ in the values and places of their loads.
  void cut(std::span<const Scene* const> scenes);
  // The spans of one of them.
  void fill(const Scene& scene, Reused<Span>& spans) const;
  // Each span's section.
  std::span<const std::size_t> sections() const { return section_of_span_; }
  // Where spans end, the clamp first.
  std::span<const double> cuts_mm() const { return cuts_; }
  // The cut nearest to a place.
  std::size_t nearest_cut(double place_mm) const;

 private:
  std::vector<double> section_ends_, places_, cuts_;
  std::vector<std::size_t> section_of_span_;
};

// Shares `count` cells (arcs, elements) out over the spans, by length, at least one each, so that the sum is
// max(count, number of spans). The second form keeps its memory in `shares`.
std::vector<int> cells_per_span(std::span<const Span> spans, int count);
struct CellShares {
  std::vector<double> share;
  std::vector<std::size_t> order;
};
void share_cells(std::span<const Span> spans, int count, std::vector<int>& cells, CellShares& shares);

}  // namespace scene
