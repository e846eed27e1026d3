// Whether an equilibrium is a minimum of the energy: it is if there is no conjugate point between the tip and the
// clamp.
#pragma once

#include "fam/varied_march.h"

#include <complex>
#include <span>
#include <vector>

namespace fam {

// Conjugate points between the tip and the clamp, as the arcs show them, and the logarithm of the size of the
// determinant of the small turns at the clamp over those of the free tip: 0 for the unloaded rod, -infinity where an
// equilibrium becomes critical.
struct Stability {
  int conjugate_points = 0;
  double log_determinant = 0;
};
// Two resolutions of one rod that tell the same: the determinants are closer than this share of a quarter.
bool agree(const Stability& a, const Stability& b, double share = 1);

// Of the equilibrium under the rod's present load whose segments start at these nodes (clamp to tip, fam/shooting.h).
// Only for fixed forces, gravity and tendons (the caller's to check). is_free: the rod may turn about its axis at no
// cost; the small turn at the clamp that this makes is no conjugate point.
Stability stability(const LoadedRod<3>& rod, std::span<const ArcRange> segments, std::span<const SectionState<3>> nodes,
                    bool is_free = false);

// The conjugate points that a march met which carries other small motions, too: those that leave the tip free are made
// of them, arc by arc from the tip to the clamp. stability() without a march of its own.
class ConjugatePoints {
 public:
  // Of a segment that starts at this node with N small motions: of the tip its three turns; of another node its turn,
  // force and moment, in these units.
  void start(const SectionState<3>& node) { back_ = node.rotation_SB; }
  template <int N>
  void after_arc(const SectionState<3>& proximal, const Fields<3, N>& fields) {
    meet(proximal.rotation_SB.transpose() * fields.turn * start_.topRows<N>());
  }
  template <int N>
  void end(const Fields<3, N>& fields, double force_unit, double moment_unit) {
    const Eigen::Matrix<double, N, 3> free = start_.topRows<N>() * (fields.turn * start_.topRows<N>()).inverse();
    start_ << Matrix3d::Identity(), fields.force_N * free / force_unit, fields.moment_Nmm * free / moment_unit;
  }
  int count() const { return count_; }

 private:
  void meet(const Matrix3d& turn_B);  // the turns of a section in the base frame

  // The motions that leave the tip free and turn the node as unit vectors do, in those it starts with.
  Eigen::Matrix<double, 9, 3> start_ = Eigen::Matrix<double, 9, 3>::Identity();
  Matrix3d back_;  // what turns the last section's turns back into those of the node
  int count_ = 0;
};

// Of a rod on its axis that nothing tells one direction across from another: the small turns at the clamp over those
// of the free tip, about the axes y and z as one complex number. Its zeros are the double critical points, whatever
// the loads; through one its sign changes.
struct CrossTurn {
  std::complex<double> direction;  // of size 1
  double log_size = 0;
};
CrossTurn cross_turn(const LoadedRod<3>& rod, std::span<const ArcRange> segments,
                     std::span<const SectionState<3>> nodes);

// Judges a rod along its load without allocating. A planar rod may buckle out of its plane and is judged in space:
// there its arcs get constants of their own, but nothing is solved for again.
template <int D>
class StabilityJudge;

template <>
class StabilityJudge<3> {
 public:
  void reserve(const Room&) {}
  void set(const LoadedRod<3>&) {}
  Stability operator()(const LoadedRod<3>& rod, std::span<const ArcRange> segments,
                       std::span<const SectionState<3>> nodes) {
    return stability(rod, segments, nodes);
  }
};

template <>
class StabilityJudge<2> {
 public:
  // So that no judgement takes memory.
  void reserve(const Room& room) {
    in_space_.reserve(room);
    nodes_.reserve(room.arcs);
  }
  void set(const LoadedRod<2>&) { is_in_space_ = false; }
  Stability operator()(const LoadedRod<2>& rod, std::span<const ArcRange> segments,
                       std::span<const SectionState<2>> nodes);

 private:
  bool is_in_space_ = false;  // made when first asked for
  LoadedRod<3> in_space_;
  std::vector<SectionState<3>> nodes_;
};

}  // namespace fam
