// Scenes with loads in the base frame: a two-point boundary value problem over the arcs.
//
// Fixed loads have known components in the section frame only once the rod's rotation is known, so the march starts
// from a guessed tip rotation and must arrive at the clamp with R = I. Long marches are ill-conditioned: a change at
// the tip grows like exp(w) towards the clamp, w = integral of sqrt(force / EI) ds (sqrt(|F| L^2 / EI) for a tip force
// F); in space a moment M about the axis of middle stiffness adds M sqrt((c2 - c1)(c3 - c2)) ds, with the compliances
// 1/GJ, 1/EI_y, 1/EI_z in order. So the rod is cut into segments of w <= segment_growth, the pose and wrench at their
// ends are unknowns too, and all are solved for together (multiple shooting; 3 unknowns with one segment, 9 more with
// each further one; cost linear in the arcs and the segments).
//
// Branch. Below unique_load a rod under fixed forces has one equilibrium, its energy being convex up to w^2 = pi^2/4 (w
// with the least of EI and GJ; with EI in planar scenes), and the full load is solved for at once, as long as the
// moments turn the rod by no more than largest_turn_rad. Beyond it the load grows from zero in steps; a step is taken
// only if Newton converges and no segment end turns by more than largest_turn_rad in it nor lies farther than
// largest_surprise_rad from where the last two steps pointed. Beside a buckling or turning point the branches lie too
// close to be told apart by their distance, but the sign of the equations' determinant differs from one to the next: a
// step that changes it is shortened as well, or one that leads on to where it vanishes by the line through the last two
// (beyond it the sign may be the old one again, where two branches part or two roots lie together). Where the loads
// have an energy one that ends unstable is shortened as well, but passes below smallest_bifurcation_step if its
// symmetry can hold the rod there: in the plane, whose determinant is that of motions in it alone, and on the axis (a
// column loaded exactly on its axis stays straight), where none is watched. So the answer is the equilibrium that the
// rod reaches when its loads grow together from zero; a snap-through ends in load_step_too_small.
#pragma once

#include "fam/band_solver.h"
#include "fam/march.h"

#include <Eigen/LU>

#include <memory>
#include <optional>
#include <string>

namespace fam {

constexpr double unique_load = 2.4;
constexpr double largest_total_turn_rad = 0.8;  // by moments, rest curvature and tendons
constexpr double largest_strain = 0.1;
constexpr double segment_growth = 1.6;
constexpr double largest_turn_rad = 0.5;
constexpr double largest_surprise_rad = 0.05;
constexpr double smallest_load_step = 1e-12;  // over the load reached: a column pushed aside by 1e-12 EI/L^2 needs it
constexpr double smallest_bifurcation_step = 1e-5;
constexpr int max_newton_steps = 20;
// Growing the load ends in work_limit after this many Newton steps, or arcs marched, or growth_passes times the rod's
// arcs, if that is more. The random scenes that are solved need up to 900 steps and 250 000 arcs.
constexpr int most_newton_steps = 3000;
constexpr long long most_arcs_marched = 600'000;
constexpr int growth_passes = 100;
constexpr double load_step_tolerance = 1e-6;  // of Newton on the way to the full load, where the last is tighter
// Newton ends where the next step is expected below newton_tolerance: rotations in rad, moments in EI/L, forces in
// EI/L^2. The expectation is newton_curvature times the step squared after fresh derivatives, else the step times
// the last shrinkage.
constexpr double newton_curvature = 30;
constexpr double tightest_newton_tolerance = 1e-13;

// Conjugate points between the tip and the clamp, as the arcs show them, and the logarithm of the size of the
// determinant of the small turns at the clamp over those of the free tip: 0 for the unloaded rod, -infinity where an
// equilibrium becomes critical.
struct Stability {
  int conjugate_points = 0;
  double log_determinant = 0;
};
// Two resolutions of one rod that tell the same: the determinants are closer than a quarter.
bool agree(const Stability& a, const Stability& b);

// In space, D = 3, or for rods in the x-y plane, D = 2 (spans with nothing out of it): 1 unknown, 4 more with each
// further segment. A planar rod may still buckle out of its plane, so its stability is judged in space all the same.
template <int D>
class BasicBoundaryValue {
 public:
  // Any law but published; every kind of load. Throws nothing but std::bad_alloc.
  BasicBoundaryValue(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law, RodModel model,
                     double newton_tolerance = tightest_newton_tolerance);

  // From no load to the full load. converged, load_step_too_small, not_converged or not_finite; message() says why.
  scene::Status run();
  // The full load, starting from a solution of the same spans; the arcs of both must be multiples of those which it
  // was first found with.
  scene::Status run_from(const BasicBoundaryValue& other);

  int arc_count() const { return static_cast<int>(arcs_.size()); }
  const std::vector<BasicArc<D>>& arcs() const { return arcs_; }
  const std::vector<BasicPose<D>>& poses() const { return poses_; }
  // What dense output needs (shape.h), after a converged run.
  SolvedRod<D> solved() const { return {span_arcs_, arcs_, poses_, distal_wrenches_S_, law_, model_}; }
  int segment_count() const { return static_cast<int>(segments_.size()); }
  int load_steps() const { return load_steps_; }
  int newton_steps() const { return newton_steps_; }
  double load_factor() const { return factor_; }  // reached
  const std::string& message() const { return message_; }

  // Of the equilibrium, a minimum of the energy if it has no conjugate point. Only for fixed forces, gravity and
  // tendons (the caller's to check).
  Stability stability() const;
  // Whether the loads are too small for a second equilibrium; then the one found is stable.
  bool one_equilibrium() const;

 private:
  template <int>
  friend class BasicBoundaryValue;

  static constexpr int turns = turns_of(D);
  static constexpr int unknowns = 2 * turns + D;  // of a node: its turn, force and moment; of the tip's its turn alone

  template <class T>
  struct State {  // base axes in the section frame, and the wrench there
    Eigen::Matrix<T, D, D> rotation_SB;
    BasicWrench<T, D> wrench;
  };
  using Rotation = Eigen::Matrix<double, D, D>;
  struct Orientation {  // determinant of the equations' derivatives at a load
    double factor = 0;
    double log_size = 0;
    bool negative = false;
  };
  struct BranchWatch {  // what the load steps must keep to
    bool determinant;
    bool stability;  // the loads have an energy, and the rod was stable so far
    bool may_fall;   // where its symmetry can hold it
    Orientation last, before;
  };
  struct Segment {
    int first_arc, end_arc;  // arcs first_arc..end_arc-1, the last of them marched first
  };
  // What a segment's march misses at its proximal end (rotation, force, moment, scaled), its derivatives with respect
  // to the node at the distal end, and that of the rotation with respect to the node arrived at.
  struct SegmentEquations {
    Eigen::Matrix<double, unknowns, 1> residual;
    Eigen::Matrix<double, unknowns, unknowns> arrival;
    Eigen::Matrix<double, turns, turns> mismatch_slope;
    bool mismatch_is_small;  // a residual of half a turn vanishes too
  };

  BasicBoundaryValue<3> in_space() const;
  void cut_into_segments();
  void set_load(double factor);
  void start_unloaded();
  std::vector<State<double>> predict(double factor) const;
  bool newton(double tolerance);
  Orientation orientation(bool exact);
  double longest_step(const BranchWatch& watch) const;
  bool newton_one_segment(bool fresh_slope, double tolerance);
  bool solve_at_once();
  bool newton_segments(double tolerance);
  std::optional<double> try_step(double to, BranchWatch& watch);
  bool stays_on_branch(double step, BranchWatch& watch);
  bool gives_up(double step);
  scene::Status failure_ = scene::Status::load_step_too_small;
  bool grow_load();
  scene::Status finish(bool solved);
  template <class T, class After>
  void march(int first_arc, int end_arc, State<T>& state, After&& after_arc) const;
  template <bool with_shear, class T, class After>
  void march_law(int first_arc, int end_arc, State<T>& state, After&& after_arc) const;
  template <int N>
  void evaluate_segment(std::size_t k, SegmentEquations& equations) const;
  double apply(const Eigen::VectorXd& step);

  std::vector<scene::Span> spans_;
  std::vector<int> arcs_per_span_;
  Law law_;
  RodModel model_;
  double newton_tolerance_;
  double length_mm_ = 0;
  double bending_Nmm2_ = 0;  // the least stiffness: unit of forces and moments
  double total_growth_ = 0;  // w of the whole rod
  double total_turn_rad_ = 0;
  double strain_ = 0;  // bound on stretch and shear

  std::vector<SpanArcs<D>> span_arcs_;
  std::vector<Segment> segments_;     // clamp to tip
  std::vector<State<double>> nodes_;  // at the distal end of each segment
  BandSystem<turns + unknowns - 1, 2 * unknowns - turns - 1> system_;
  std::vector<State<double>> previous_;  // the same at the last load but one
  double factor_ = 0, previous_factor_ = 0, first_step_ = 1;

  Eigen::Matrix<double, turns, turns> slope_;   // of one segment
  std::unique_ptr<BasicBoundaryValue> coarse_;  // a quarter of the arcs, where the full load is solved for at once

  std::vector<BasicArc<D>> arcs_;
  std::vector<BasicMotion<double, D>> motions_;
  std::vector<BasicPose<D>> poses_;
  std::vector<BasicWrench<double, D>> distal_wrenches_S_;
  mutable bool tendon_collapsed_ = false;  // in the last march
  int load_steps_ = 0;
  int newton_steps_ = 0;
  std::string message_;
};

template <>
Stability BasicBoundaryValue<2>::stability() const;
template <>
Stability BasicBoundaryValue<3>::stability() const;

using BoundaryValue = BasicBoundaryValue<3>;

}  // namespace fam
