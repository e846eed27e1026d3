// Rods of one kind that differ in the values of their loads alone, solved side by side, one rod a lane of the
// processor's vector unit (fam/lane_kernel.cpp). What lanes cannot solve surely they leave to the Solver: rods that may
// have a second equilibrium, tendons far from straight, arcs too long. Plain numbers alone: the kernels, one for each
// unit, must share no code with the rest.
#pragma once

#include <cstddef>
#include <span>

namespace fam {

// The numbers of a span that loads determine, in the frame that the rod is solved in; distributed forces times the arc
// length. `rest_rotation`: of an arc, by rest curvature and tendons along the tangent. In space the tensions follow.
namespace lane_number {
enum : int {
  follower_force = 0,
  follower_moment = 3,
  fixed_force = 6,
  fixed_moment = 9,
  fixed_force_arms = 12,  // by rows
  distributed_follower = 21,
  distributed_fixed = 24,
  rest_rotation = 27,
  tension = 30
};
}
constexpr int most_lane_tendons = 12;  // of a span, in space; a manipulator of three segments has as many at most

// All rods of a batch have these in common.
struct LaneSpan {
  int arcs;
  bool distributed;
  double arc_length_mm;
  double angular_compliance[3], linear_compliance[3];        // times h; 0: does not give way
  double numbers[lane_number::tension + most_lane_tendons];  // with every value of the columns 0
  double least_stiffness_Nmm2, buckling_stiffness_Nmm2, spin_rate_per_Nmm2, linear_compliance_per_N;  // load_length.h
  double compliance_to_clamp_per_Nmm;  // int ds / buckling stiffness
  double rest_turn_rad, twist_per_Nmm2;
  double tendon_arms_mm[2];  // least and largest, in the plane; 0 included
  int tendons;               // in space
  double tendon_y_mm[most_lane_tendons], tendon_z_mm[most_lane_tendons];
};
// A number of a span grows by `slope` times a column's value.
struct LaneTerm {
  int span, number, column;
  double slope;
};
struct LaneRods {
  std::span<const LaneSpan> spans;
  std::span<const LaneTerm> terms;
  int arc_count, numbers;  // numbers: of a span
  bool planar, march, reissner, round, conservative;
  double length_mm;
  double rotation_BP[9], rest_tip_rotation_SB[9];  // by rows
  std::ptrdiff_t row_stride;
  bool estimate;
  double longest_load_length, largest_swing_rad;
};

struct LaneTip {
  double position_mm[3], rotation_wxyz[4];  // base frame, but for the twist of round rods
  double twist_rad, error_mm;
  bool solved;
};

// Solves the named rows of `values` (row-major, rods.row_stride from one to the next), each into its own tip.
using LaneKernel = void (*)(const LaneRods& rods, const double* values, std::span<const std::ptrdiff_t> rows,
                            LaneTip* tips);
struct LaneUnit {
  const char* name;  // "x86-64-v4" ...
  int lanes;
  LaneKernel solve;
};
}  // namespace fam
