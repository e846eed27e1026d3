// Shooting from the tip to the clamp: the equations of a rod whose loads have components in the base frame.
//
// Fixed loads have known components in the section frame only once the rod's rotation is known, so the march starts
// from a guessed tip rotation and must arrive at the clamp with R = I. Long marches are ill-conditioned: a change at
// the tip grows like exp(w) towards the clamp, w the load length (load_length.h). So the rod is cut into segments of
// w <= segment_load_length, the pose and wrench at their ends are unknowns too, and all are solved for together
// (multiple shooting; 3 unknowns with one segment, 9 more with each further one; in the plane 1 and 4; cost linear in
// the arcs and the segments).
#pragma once

#include "fam/band_solver.h"
#include "fam/stability.h"

#include "scene/branch_watch.h"

#include <limits>
#include <memory>
#include <vector>

namespace fam {

// With 3 in its place random scenes take 1.02 times the instructions, columns among them 1.08 times and the catheter
// tube 1.57 times. Of 29 066 columns, 7618 strips, coils and the like (with 4) and 3498 campaign scenes that are not
// marched all end where they do with 3, but for two columns whose azimuth next to nothing holds, which find no end, and
// one rod that now does. With 4 so do four of 400 columns at 50 to 6000 EI/L^2, with 7 two of 91 041 columns lose their
// branch.
constexpr double segment_load_length = 3.5;
// Of a node in a Newton step, which is shortened beyond. With 0.5 in its place three of 28 scenes take 4 to 10 % more
// instructions and one 4 % less, with 1.5 one takes four times as many.
constexpr double largest_newton_turn_rad = 0.8;
constexpr int max_newton_steps = 20;
constexpr int most_stalled_steps = 2;  // longer than half the last; beside a critical point one is no bad sign
// A Newton step from the solution with fewer arcs that turns a node farther does not lead to that with more. With 0.1
// one of 1500 random scenes, a coil, ends in work_limit; with 0.2 none of 7500 changes, and the one of 630 000 that a
// bound on positions alone, 0.05 L, led astray is right: a coil is smaller than that. Beside a critical point branches
// lie as near each other as the root of the determinant: one strip of 8000 scenes that buckle was led across without
// it.
constexpr double leading_turn_rad = 0.2;
// Newton ends where the next step is expected below the tolerance: rotations in rad, moments in EI/L, forces in EI/L^2.
// The expectation is newton_curvature times the step squared after fresh derivatives, else the step times the last
// shrinkage. Chosen, not measured.
constexpr double newton_curvature = 30;
// Of the determinant's logarithm, from one factorisation to the next: a step that comes after more is not the last, and
// its factors are not kept. Four columns of 234 000 random scenes were off by 4e-4 to 5e-3 L, azimuths that next to
// nothing holds, at estimates of 1e-6 to 1e-4; with 0.2 to 1.4 none is (one ends without an answer at 1e-4 L), and 2000
// others are as before, in their time.
constexpr double most_log_change = 0.7;
constexpr double tightest_newton_tolerance = 1e-13;  // some hundred round-offs of a rotation

// A rod under fixed forces has one equilibrium while its energy is convex, at least up to a unique length
// (load_length.h) of 6^(1/4), its square 2.45; a uniform one up to pi/2, 2.47. In the plane turns by moments leave that
// as it is. In space they shift it: of 80 000 rods under fixed forces up to it and moments none ends elsewhere with 4
// in the place of 2 than with 0.8, nor with 3 of 80 000 with tendons, rest curvature, distributed and following loads;
// without a limit 242 of 80 000 do, whose moments alone would turn them by up to 20 rad. Strains shift it, too; their
// limit is chosen, not measured.
constexpr double unique_length_squared = 2.4;
constexpr double unique_turn_rad = 2;
constexpr double unique_strain = 0.1;
// Within, moments in a plane are too small to turn the rod out of it: a strip under one needs pi/2 of its geometric
// mean of EI and GJ, a turn by the least of them.
constexpr double stable_turn_rad = 0.8;

// What the full load can do to a rod at most.
struct LoadBounds {
  double load_length = 0;            // of the whole rod
  double unique_share = 0;           // of what leaves it one equilibrium (load_length.h), of a planar rod in its plane
  double unique_share_in_space = 0;  // the same in space
  double minimum_share = std::numeric_limits<double>::infinity();   // of what leaves it but minima of an energy
  double clamp_straying = std::numeric_limits<double>::infinity();  // of loads without an energy (load_length.h)
  double turn_rad = 0;           // by moments, and in space by rest curvature and tendons
  double turn_in_space_rad = 0;  // by all of these
  double strain = 0;             // stretch and shear
};

// What the last march over all arcs met, as dense output needs it (shape.h).
template <int D>
struct MarchedArcs {
  std::vector<BasicArc<D>> arcs;
  std::vector<BasicMotion<double, D>> motions;
  std::vector<BasicWrench<double, D>> distal_wrenches_S;
  Angular<double, D> clamp_moment_Nmm;

  void reserve(std::size_t count);
  void resize(std::size_t count);
  void meet(int arc, const SectionState<D>& state) { distal_wrenches_S[static_cast<std::size_t>(arc)] = state.wrench; }
  void operator()(int arc, const BasicScrew<double, D>& screw, const BasicMotion<double, D>& motion,
                  const SectionState<D>& state) {
    arcs[static_cast<std::size_t>(arc)].screw = screw;
    motions[static_cast<std::size_t>(arc)] = motion;
    if (arc == 0) clamp_moment_Nmm = state.wrench.moment_Nmm;
  }
};

// What Newton knows of a rod whose load grows.
struct OnTheWay {
  // Where the way began. Where neither the last solution's nor the present determinant has fallen from it, the
  // derivatives of the first Newton step serve for the rest.
  scene::Determinant start;
  double hopeless_turn_rad;  // a Newton step that turns a node farther is the last
  bool near_critical = false;
  int* conjugate_points = nullptr;  // wanted of a rod in space, where derivatives are taken
};

// Newton's steps on the way. Where no critical point is near and one does not turn the nodes by less than half of what
// the last did, both with fresh derivatives, the guess is too far off for the solution that they end at to be that of
// the branch (Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 5.1): scene 72 of campaign 60606 was led
// across to one 0.09 rad away, the determinant far from zero, in steps of 0.12 and 0.17 rad, and of 0.111 and 0.105
// where the load steps were shorter. Beside a critical point the step along the motion that costs next to nothing is
// no sign: there three of 10 000 columns lose their azimuth if it counts.
class Contraction {
 public:
  // After a step that turns a node by at most this.
  bool is_lost(const OnTheWay& way, double turn_rad, bool fresh);

 private:
  double last_turn_rad_ = std::numeric_limits<double>::infinity();
  bool last_was_fresh_ = false;
};

template <int D>
class Shooting {
 public:
  using Node = SectionState<D>;
  using Rotation = Eigen::Matrix<double, D, D>;

  // The load length that a segment has at most, but for one of a single arc.
  explicit Shooting(double longest = segment_load_length) : segment_load_length_(longest) {}

  void reserve(const Room& room);
  // Takes memory where more arcs, segments or spans are asked for than ever before. fewer: of the same way, whose arcs
  // these divide; its segments and bounds are taken over, and solve_from() leads on from its solution.
  void set(const LoadWay& way, std::span<const int> arcs_per_span, Law law, RodModel model, double newton_tolerance,
           const Shooting* fewer = nullptr);

  const LoadedRod<D>& rod() const { return rod_; }
  const LoadBounds& bounds() const { return bounds_; }
  // The loads are too small for a second equilibrium, of a planar rod in its plane, or all but follow.
  bool one_equilibrium() const;
  // The clamp turns with the tip but for less than all of it, and one segment is enough.
  bool loads_all_but_follow() const { return bounds_.clamp_straying < 1; }
  // Then the one found is stable, in space.
  bool is_surely_stable() const {
    const bool is_short = bounds_.unique_share_in_space <= 1 && bounds_.turn_in_space_rad <= stable_turn_rad;
    return one_equilibrium() && (is_short || bounds_.minimum_share < 1);
  }
  // All moments are known in the base's axes beforehand (scene::moments_are_known).
  bool moments_are_known() const { return moments_are_known_; }
  double newton_tolerance() const { return newton_tolerance_; }
  int newton_steps() const { return newton_steps_; }  // since forget_work()
  // Of a node in the step that Newton left out last: as a march measured it, or as the steps before let expect.
  double expected_turn_rad() const { return expected_turn_rad_; }
  void forget_work();

  // Before nodes are changed, too.
  void set_load(double factor) {
    rod_.set_load(factor);
    marched_is_of_nodes_ = false;
  }
  // No load: the rest shape.
  void start_unloaded();
  // The full load, and the shape that a march from the clamp leads to under the wrench that the loads would leave there
  // if the rod kept its rest shape: the same arcs with a negative length. Where the moments are known beforehand it is
  // off by no more than the law is. Returns the share of the clamp's moment that the loads on this shape do not bear.
  double start_from_clamp();
  // From there. False, too: the march back misses a segment's end by more than a quarter turn, the arcs are too long.
  bool solve_known_moments();
  // From the shape that the rod had, at the start of the way: state_at(arc) at an arc's distal end, without the point
  // loads there.
  template <class StateAt>
  void start_at(StateAt&& state_at) {
    set_load(0);
    for (std::size_t k = 0; k < segments_.size(); ++k) nodes_[k] = state_at(segments_[k].end_arc - 1);
    nodes_.back().wrench = {};
  }
  // From the nodes as they are to those of the present load. keep_derivatives: those at hand serve for the first step.
  bool newton(double tolerance, const OnTheWay* way = nullptr, bool keep_derivatives = false);
  // The full load from start_from_clamp(), first with a quarter of the arcs or one, whose derivatives then serve for
  // all; or from a march from the tip where the loads all but follow.
  bool solve_at_once();
  // The full load from the nodes as they are, or as start_from_clamp() leaves them.
  bool solve_from_here();
  bool solve_from_start();
  bool solve_from_tip();
  // The same near the solution of another one, whatever its arcs, from which the tip turns by about so much: of one
  // segment, with that one's derivatives in the first step.
  bool solve_near(const Shooting* other, const Angular<double, D>& tip_turn_B);
  // The full load from the solution of the one with fewer arcs that this was set by.
  bool solve_from(const Shooting& fewer);
  // The derivatives that another one's Newton left, for the first step from its solution. False: they are not those of
  // these arcs.
  bool take_derivatives(const Shooting& other);
  // Whether those at hand are this one's, not another one's or a rigid rod's.
  bool has_own_derivatives() const { return has_own_derivatives_; }

  // Of the equations' derivatives, after newton(): as that left them, or at the solution.
  scene::Determinant determinant() const;
  // Of the rest shape without load: of size 1.
  scene::Determinant determinant_at_rest() const { return {0, segments_.size() % 2 == 1}; }
  scene::Determinant exact_determinant();
  // scene::Determinant::log_growth, of the nodes as they are.
  double log_growth() const;

  // Clamp to tip: the segments, and the state at the distal end of each.
  const std::vector<ArcRange>& segments() const { return segments_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  void set_nodes(const std::vector<Node>& nodes) { nodes_ = nodes; }
  // What the last march met; that over the nodes as they are after march_all(), which has nothing to do where Newton
  // ended with it.
  const MarchedArcs<D>& marched() const { return marched_; }
  void march_all();
  // Of the arcs that the last march or the one from the clamp met: the changes of curvature from the rest shape, summed
  // along the rod. No section has turned by more.
  double bending_rad() const;
  // How the nodes change with the load factor after newton(): one more step with the derivatives that it left, at loads
  // by this much larger, over that.
  void set_load_tangent(double difference, std::vector<Fields<D, 1>>& tangent);

  // The equations by themselves, for those who solve them with a parameter (fam/path_equations.h).
  static constexpr int rotations = rotations_of(D);
  static constexpr int unknowns =
      2 * rotations + D;  // of a node: its rotation, force, moment; the tip's rotation alone
  // What a segment's march misses at its proximal end (rotation, force, moment, scaled), its derivatives with respect
  // to the node at the distal end, and that of the rotation with respect to the node arrived at.
  struct SegmentEquations {
    Eigen::Matrix<double, unknowns, 1> residual;
    Rotation mismatch;
    Eigen::Matrix<double, unknowns, unknowns> arrival;
    Eigen::Matrix<double, rotations, rotations> mismatch_slope;
    bool mismatch_is_small;  // a residual of half a turn vanishes too
  };
  // Of segment k at the nodes as they are; with_slopes: the derivatives, too.
  SegmentEquations equations(std::size_t k, bool with_slopes) const;
  // The residual alone, of the state that a march of segment k arrives with.
  SegmentEquations residual(std::size_t k, const Node& arrived) const {
    SegmentEquations result;
    set_residual(k, arrived, result);
    return result;
  }
  double force_unit() const { return least_stiffness_Nmm2_ / (length_mm_ * length_mm_); }
  double moment_unit() const { return least_stiffness_Nmm2_ / length_mm_; }

 private:
  void cut_into_segments();
  void take_segments(const Shooting& fewer);
  // clamp: the wrench there, or null for the rest shape. The nodes are those of the march; the result is what the loads
  // come to about the clamp on the way.
  BasicWrench<double, D> march_outwards(const BasicWrench<double, D>* clamp);
  bool has_few_arcs() const;
  void reserve_few_arcs();
  bool solve_few_arcs();
  bool newton_from_rigid(double first_shrinkage, double least_shrinkage);
  static int* points_wanted(const OnTheWay* way) { return D == 3 && way ? way->conjugate_points : nullptr; }
  void copy_derivatives(const Shooting& other);
  // points: wanted of a rod in space, where not null.
  template <int N>
  void evaluate_segment(std::size_t k, SegmentEquations& equations, ConjugatePoints* points = nullptr) const;
  // Of the state that a march of segment k arrives with.
  void set_residual(std::size_t k, const Node& arrived, SegmentEquations& equations) const;
  void assemble(int k, const SegmentEquations& equations);
  void set_right(std::size_t k, const SegmentEquations& equations);
  // The residuals of all segments and, unless the factors are to be kept, their derivatives, factorised. False: not
  // finite, or singular.
  bool evaluate_system(bool keep_factors, bool& mismatches_are_small, int* conjugate_points = nullptr);
  // keep_slope, keep_factors: the derivatives at hand serve for the first step. first_shrinkage: what a second step
  // with them would be of it, a tenth with a near solution's; least_shrinkage: what a next one is expected to be at
  // least.
  bool newton_one_segment(bool keep_slope, double tolerance, const OnTheWay* way = nullptr,
                          double first_shrinkage = 0.1, double least_shrinkage = 0);
  bool newton_segments(bool keep_factors, double tolerance, const OnTheWay* way = nullptr);
  // Over segment k from its node, which the state is; fills marched_.
  void march_remembered(std::size_t k, Node& state) { rod_.march(segments_[k], state, marched_); }
  // Whether the step that a march has shown to be left is small enough to be left out: then the solution is what the
  // march met. To be asked after a step has been taken, so that small changes of the loads are not lost.
  bool ends_measured(double size, double turn_rad, double tolerance);
  // Whether derivatives that led to a step of this size do for the next one too.
  static bool slopes_last(bool were_kept, double size, double last_size) {
    return size < 0.4 && (!were_kept || size < 0.5 * last_size);
  }
  // The largest turn of a node in a Newton step of several segments; moves the nodes by it.
  double largest_turn_rad(const Eigen::Ref<const Eigen::VectorXd>& step) const;
  void apply(const Eigen::Ref<const Eigen::VectorXd>& step, double largest_turn_rad);

  double segment_load_length_;
  LoadedRod<D> rod_;
  double newton_tolerance_ = 0, expected_turn_rad_ = 0;
  double length_mm_ = 0;
  double least_stiffness_Nmm2_ = 0;
  LoadBounds bounds_;
  std::vector<ArcRange> segments_;
  std::vector<Node> nodes_;
  MarchedArcs<D> marched_;
  bool marched_is_of_nodes_ = false;
  std::vector<double> softness_;  // of each segment: length over the root of EI, summed over the planes of bending
  BandSystem<rotations + unknowns - 1, 2 * unknowns - rotations - 1> system_;  // of several segments
  Eigen::Matrix<double, rotations, rotations> slope_;                          // of one segment
  bool has_own_derivatives_ = false;
  bool moments_are_known_ = false;
  std::unique_ptr<Shooting> few_arcs_;  // a quarter of the arcs, where the full load is solved for at once
  std::vector<int> few_counts_;
  int newton_steps_ = 0;
};

}  // namespace fam
