// The equations of a path: those of multiple shooting (fam/shooting.h) in space, F(x, p) = 0, with the parameter p of
// the scene as one unknown more, and a row more that keeps a Newton step across the path.
//
// That row holds the rotation of one segment's end alone, the one that turns fastest, and the parameter: so it stands
// in the band beside that segment's rows, the parameter's column at its right end, and pivots are sought among all
// (fam/bordered_band.h). One factorisation serves for Newton's step, the tangent and the sign that changes at a simple
// branch point. Where a rod may turn about its axis at no cost a second row keeps its phase, and a column, a moment
// about the axis that turns out to be zero, makes up for the equation that depends on the others.
#pragma once

#include "fam/bordered_band.h"
#include "fam/options.h"
#include "fam/shooting.h"

#include "scene/equilibrium.h"
#include "scene/path.h"
#include "scene/span_facts.h"

namespace fam {

// The spans of a path's scene at any parameter, cut at the same places.
class PathLoads {
 public:
  explicit PathLoads(const scene::PathRequest& request);
  void set(double parameter, scene::Reused<scene::Span>& spans) const;

 private:
  scene::PathRequest request_;
  scene::SpanCutter cutter_;
};

// Arcs of each span, and the loads that segments are cut for: those between two parameters.
struct PathMesh {
  std::vector<int> arcs;
  double low = 0, high = 0;
  std::vector<ArcRange> segments;  // set_mesh() cuts them
};

// Of a segment: beside a fold fewer places to watch are too few. With 4 in its place two of 2092 campaign scenes end
// elsewhere, one of which the exact reference sees snap.
constexpr double path_segment_load_length = 3;

// A guess or a solution: the states at the segments' ends.
struct PathState {
  std::vector<SectionState<3>> nodes;
  double parameter = 0;
};

// The row across the path, and the phase's, where there is one.
struct PathBorder {
  struct Row {
    std::size_t node = 0;
    Vector3d turn = Vector3d::Zero();
    double parameter = 0;
  };
  Row path;
  std::optional<Row> phase;
};

// The rows of a segment's equations, without borders.
namespace path_rows {
constexpr int of_rotations = Shooting<3>::rotations, of_node = Shooting<3>::unknowns;
constexpr int first_row(std::size_t k) {
  return k > 0 ? of_node * static_cast<int>(k) - (of_node - of_rotations) : 0;
}
constexpr int row_count(std::size_t k) {
  return k > 0 ? of_node : of_rotations;
}
}  // namespace path_rows

class PathEquations {
 public:
  // Changes: of each node's rotation (rad, its own frame), force and moment (shooting's units), of the tip's rotation
  // alone, and of the parameter in its unit.
  using Change = Eigen::VectorXd;

  struct Settings {
    Law law = Law::automatic;  // chosen
    RodModel model = RodModel::kirchhoff;
    double newton_tolerance = tightest_newton_tolerance;
    double unit = 1;                 // of the parameter
    double lowest = 0, highest = 1;  // of it
  };
  PathEquations(const scene::PathRequest& request, const Settings& settings);
  PathEquations(const PathEquations&) = delete;  // views into its own lists
  PathEquations& operator=(const PathEquations&) = delete;

  void set_mesh(const PathMesh& mesh);
  const PathMesh& mesh() const { return mesh_; }
  // What the loads between two parameters can do at most.
  std::span<const scene::Span> bounds_between(double low, double high);
  // The state with this mesh of one with another, whose arcs were as many or fewer by whole numbers.
  PathState carried_over(const PathState& state, const PathMesh& from_mesh);

  const LoadedRod<3>& rod() const { return shooting_.rod(); }
  const std::vector<ArcRange>& segments() const { return shooting_.segments(); }
  double length_mm() const { return rod().way().to.back().end_mm; }
  std::span<const scene::Span> spans_at(double parameter);
  double newton_tolerance() const { return settings_.newton_tolerance; }
  // What keeps Newton's steps, tangents and null vectors in the subspace of a symmetry that the rod has so far.
  void hold(scene::Symmetry symmetry) { held_ = symmetry; }
  scene::Symmetry held() const { return held_; }

  PathState moved(const PathState& from, const Change& change, double factor = 1) const;
  // Row across a path with this tangent; the phase's of a state that is free to turn about its axis.
  PathBorder::Row row_across(const Change& tangent) const;
  PathBorder::Row phase_row(const PathState& state) const;

  // Newton's method from a guess, across the border. Empty: it did not converge. The loads are then the state's.
  struct Linear {
    Change tangent;                  // along the border's direction, of size 1
    scene::Determinant determinant;  // of derivatives and tangent: no matter which border
    double first_step_rad = 0;       // the largest turn in it
  };
  std::optional<Linear> correct(PathState& state, const PathBorder& border, double tolerance);
  // Of the derivatives at the state corrected last, which is a branch point: a change that they do not see, of those
  // that a turn of the clamp brings forth.
  Change null_change(const Vector3d& turn_of_clamp);

  // The mean square of the nodes' turns and the parameter's.
  double inner(const Change& a, const Change& b) const;
  Change zero_change() const { return Change::Zero(unknowns_ + 1); }
  Eigen::Index unknowns() const { return unknowns_; }
  Change projected(const Change& change) const;

  // Of the state corrected last: positions of the arcs' ends, how far they are from those with twice the arcs, and how
  // far an arc swings.
  std::vector<Vector3d> positions_mm(const PathState& state);
  struct Accuracy {
    double error_mm = 0, swing_rad = 0;
    Vector3d tip_position_B_mm = Vector3d::Zero();
  };
  Accuracy accuracy(const PathState& state, const Change& tangent);
  // Of each span at this state, whether its arcs swing farther than this or are among those that make the rod
  // inaccurate: twice as many would lead elsewhere.
  std::vector<bool> coarse_spans(const PathState& state, double allowed_swing_rad);
  // At the arcs' distal ends, without the point loads there; finer_times the arcs, for pictures.
  std::vector<SectionState<3>> states(const PathState& state);
  std::vector<Vector3d> centreline_mm(const PathState& state, int finer_times);
  // Stations, tip angle and tendons' shortening of the scene at the state's parameter.
  scene::Equilibrium equilibrium(const PathState& state, const scene::Scene& scene);
  void set_parameter(double parameter);
  long long arcs_marched() const { return arcs_marched_; }  // by all Newton steps so far
  bool tendon_collapsed() const { return rod().tendon_collapsed(); }

 private:
  double apart(const SectionState<3>& a, const SectionState<3>& b) const;  // in the equations' units
  double swing_rad(std::size_t span, std::span<const SectionState<3>> distal) const;
  bool evaluate(const PathState& state, const PathBorder& border, bool roughly);
  void add_border(const PathBorder& border);
  Change residual_at(const PathState& state, double parameter);
  Change by_parameter(const PathState& state);
  Change by_parameter_roughly(const PathState& state, const Change& residual);
  Change by_axial_moment(const PathState& state);
  bool residual(Change& result, bool& small) const;
  int row_of(int row) const;
  Change without_borders(const Eigen::VectorXd& solution) const;

  Settings settings_;
  PathLoads loads_;
  PathMesh mesh_;
  scene::Reused<scene::Span> spans_, low_, high_, bounds_, probe_;
  Shooting<3> shooting_{path_segment_load_length};
  LoadedRod<3> fine_;
  Eigen::Index unknowns_ = 0;
  scene::Symmetry held_ = scene::Symmetry::none;
  BorderedBand<5, 14, 2> system_;
  std::vector<int> border_rows_;  // where they stand in the system, in order
  int path_row_ = 0;
  bool odd_borders_ = false;
  Eigen::VectorXd right_;
  long long arcs_marched_ = 0;
};

}  // namespace fam
