#include "fam/path_equations.h"

#include "fam/problem.h"
#include "fam/rotation.h"
#include "fam/skew.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

using path_rows::first_row;
using path_rows::row_count;
using scene::Span;
using scene::Symmetry;

constexpr int rotations = path_rows::of_rotations, per_node = path_rows::of_node;
// Of the parameter's unit, in the difference quotient by it: its error is the square of it. Chosen, not measured.
constexpr double parameter_difference = 1e-5;
// Of Newton's method, from which on a one-sided difference does: then its error, 5e-6, is below the tolerance times the
// last step, and no fold moves by it, where the equations are singular whatever the parameter does.
constexpr double rough_tolerance = 1e-9;
constexpr int most_path_newton_steps = 8;

// The rows of a border stand behind those of the segment whose node they hold.
int row_behind(std::size_t node) {
  return per_node * static_cast<int>(node) + rotations;
}

// What a symmetry leaves of a turn (which is as a moment) and of a force.
Vector3d kept_turn(Symmetry symmetry, const Vector3d& v) {
  switch (symmetry) {
    case Symmetry::none: break;
    case Symmetry::plane_xy: return {0, 0, v[2]};
    case Symmetry::plane_xz: return {0, v[1], 0};
    case Symmetry::axis: return {v[0], 0, 0};
  }
  return v;
}
Vector3d kept_force(Symmetry symmetry, const Vector3d& v) {
  switch (symmetry) {
    case Symmetry::none: break;
    case Symmetry::plane_xy: return {v[0], v[1], 0};
    case Symmetry::plane_xz: return {v[0], 0, v[2]};
    case Symmetry::axis: return {v[0], 0, 0};
  }
  return v;
}

}  // namespace

PathLoads::PathLoads(const scene::PathRequest& request) : request_(request) {
  const scene::Scene* const scenes[] = {&request_.scene};
  cutter_.cut(scenes);
}

void PathLoads::set(double parameter, scene::Reused<Span>& spans) const {
  cutter_.fill(scene::scene_at(request_, parameter), spans);
}

PathEquations::PathEquations(const scene::PathRequest& request, const Settings& settings)
    : settings_(settings), loads_(request) {}

std::span<const Span> PathEquations::bounds_between(double low, double high) {
  loads_.set(low, low_);
  loads_.set(high, high_);
  set_larger(low_, high_, probe_);
  return probe_;
}

std::span<const Span> PathEquations::spans_at(double parameter) {
  loads_.set(parameter, probe_);
  return probe_;
}

void PathEquations::set_mesh(const PathMesh& mesh) {
  mesh_ = mesh;
  bounds_.assign(bounds_between(mesh.low, mesh.high));
  spans_.assign(bounds_);  // the rod learns from them what loads there may be
  const LoadWay way{spans_, spans_, bounds_};
  shooting_.set(way, mesh.arcs, settings_.law, settings_.model, settings_.newton_tolerance);
  std::vector<int> twice = mesh.arcs;
  for (int& count : twice) count *= 2;
  fine_.set(way, twice, settings_.law, settings_.model);
  mesh_.segments = shooting_.segments();
  unknowns_ = static_cast<Eigen::Index>(per_node * (mesh_.segments.size() - 1) + rotations);
}

void PathEquations::set_parameter(double parameter) {
  loads_.set(parameter, spans_);
  shooting_.set_load(1);
}

PathState PathEquations::moved(const PathState& from, const Change& change, double factor) const {
  PathState to = from;
  for (std::size_t k = 0; k < to.nodes.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(per_node * k);
    SectionState<3>& node = to.nodes[k];
    node.rotation_SB = turned(node.rotation_SB, Vector3d(factor * change.segment<3>(at)));
    if (k + 1 == to.nodes.size()) break;
    node.wrench.force_N += factor * shooting_.force_unit() * change.segment<3>(at + 3);
    node.wrench.moment_Nmm += factor * shooting_.moment_unit() * change.segment<3>(at + 6);
  }
  to.parameter += factor * settings_.unit * change[unknowns_];
  return to;
}

PathEquations::Change PathEquations::projected(const Change& change) const {
  Change result = change;
  if (held_ == Symmetry::none) return result;
  for (Eigen::Index at = 0; at < unknowns_; at += per_node) {
    result.segment<3>(at) = kept_turn(held_, change.segment<3>(at));
    if (at + per_node > unknowns_) break;
    result.segment<3>(at + 3) = kept_force(held_, change.segment<3>(at + 3));
    result.segment<3>(at + 6) = kept_turn(held_, change.segment<3>(at + 6));
  }
  return result;
}

double PathEquations::inner(const Change& a, const Change& b) const {
  double sum = 0;
  for (Eigen::Index at = 0; at < unknowns_; at += per_node) sum += a.segment<3>(at).dot(b.segment<3>(at));
  return sum / static_cast<double>(mesh_.segments.size()) + a[unknowns_] * b[unknowns_];
}

PathBorder::Row PathEquations::row_across(const Change& tangent) const {
  PathBorder::Row row{0, Vector3d::Zero(), tangent[unknowns_]};
  for (std::size_t k = 0; k < mesh_.segments.size(); ++k) {
    const Vector3d turn = tangent.segment<3>(static_cast<Eigen::Index>(per_node * k));
    if (turn.squaredNorm() > row.turn.squaredNorm()) row.node = k, row.turn = turn;
  }
  return row;
}

// The turn of a section when the rod turns about its axis and each section turns back about its own.
static Vector3d free_turn(const SectionState<3>& node) {
  return node.rotation_SB.col(0) - Vector3d::UnitX();
}

PathBorder::Row PathEquations::phase_row(const PathState& state) const {
  PathBorder::Row row;
  double sum = 0;
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const Vector3d turn = free_turn(state.nodes[k]);
    sum += turn.squaredNorm();
    if (turn.squaredNorm() > row.turn.squaredNorm()) row.node = k, row.turn = turn;
  }
  if (sum > 0) row.turn /= std::sqrt(sum / static_cast<double>(state.nodes.size()));
  return row;
}

int PathEquations::row_of(int row) const {
  for (const int border : border_rows_) {
    if (row >= border) ++row;
  }
  return row;
}

bool PathEquations::residual(Change& result, bool& small) const {
  result.resize(unknowns_ + 1);
  result[unknowns_] = 0;
  small = true;
  for (std::size_t k = 0; k < mesh_.segments.size(); ++k) {
    const auto equations = shooting_.equations(k, false);
    result.segment(first_row(k), row_count(k)) = equations.residual.head(row_count(k));
    small = small && equations.mismatch_is_small;
  }
  return result.allFinite();
}

PathEquations::Change PathEquations::residual_at(const PathState& state, double parameter) {
  shooting_.set_nodes(state.nodes);
  set_parameter(parameter);
  Change result;
  bool small;
  residual(result, small);
  return result;
}

// Of the equations, by the parameter in its unit; on one side where there is no other.
PathEquations::Change PathEquations::by_parameter(const PathState& state) {
  const double h = parameter_difference * settings_.unit, p = state.parameter;
  const double low = settings_.lowest, high = settings_.highest;
  const auto at = [&](double parameter) { return residual_at(state, parameter); };
  if (p - h < low || p + h > high) {
    const double s = p - h < low ? h : -h;
    return (4 * at(p + s) - at(p + 2 * s) - 3 * at(p)) * (settings_.unit / (2 * s));
  }
  return (at(p + h) - at(p - h)) * (settings_.unit / (2 * h));
}

// The same to first order, from the residual at the state.
PathEquations::Change PathEquations::by_parameter_roughly(const PathState& state, const Change& residual) {
  const double h = parameter_difference * settings_.unit * (state.parameter < settings_.highest ? 1 : -1);
  return (residual_at(state, state.parameter + h) - residual) * (settings_.unit / h);
}

// Of the tip's segment, by a moment about the base's x axis on the tip.
PathEquations::Change PathEquations::by_axial_moment(const PathState& state) {
  constexpr double difference = 1e-4;
  const std::size_t tip = mesh_.segments.size() - 1;
  const auto before = shooting_.equations(tip, false).residual;
  PathState pushed = state;
  pushed.nodes.back().wrench.moment_Nmm +=
      difference * shooting_.moment_unit() * pushed.nodes.back().rotation_SB.col(0);
  shooting_.set_nodes(pushed.nodes);
  const auto after = shooting_.equations(tip, false).residual;
  shooting_.set_nodes(state.nodes);
  Change result = zero_change();
  result.segment(first_row(tip), row_count(tip)) = (after - before).head(row_count(tip)) / difference;
  return result;
}

// An empty system with the border's rows in it.
void PathEquations::add_border(const PathBorder& border) {
  const int columns = static_cast<int>(unknowns_);
  int path = row_behind(border.path.node);
  int exchanges = columns - path;  // of rows, to bring the border's to the end
  border_rows_.clear();
  if (border.phase) {
    int phase = row_behind(border.phase->node);
    exchanges += columns - phase;
    if (phase < path) ++path, ++exchanges;
    else ++phase;
    border_rows_ = {std::min(path, phase), std::max(path, phase)};
    system_.resize(columns, 2);
  } else {
    border_rows_ = {path};
    system_.resize(columns, 1);
  }
  path_row_ = path;
  odd_borders_ = exchanges % 2 != 0;
  system_.set_zero();
  const auto write = [&](int row, const PathBorder::Row& values) {
    for (int i = 0; i < rotations; ++i) system_(row, per_node * static_cast<int>(values.node) + i) = values.turn[i];
    system_(row, columns) = values.parameter;
  };
  write(path, border.path);
  for (const int row : border_rows_) {
    if (row != path) write(row, *border.phase);
  }
}

// Matrix and right-hand side at a state; false: not finite. roughly: of the parameter's column.
bool PathEquations::evaluate(const PathState& state, const PathBorder& border, bool roughly) {
  set_parameter(state.parameter);
  shooting_.set_nodes(state.nodes);
  add_border(border);
  const int columns = static_cast<int>(unknowns_);
  right_ = Eigen::VectorXd::Zero(system_.size());
  const Change axial = border.phase ? by_axial_moment(state) : Change();
  Change residual = zero_change();
  bool finite = true;
  for (std::size_t k = 0; k < mesh_.segments.size(); ++k) {
    const auto equations = shooting_.equations(k, true);
    const bool is_tip = k + 1 == mesh_.segments.size();
    const int column = per_node * static_cast<int>(k);
    residual.segment(first_row(k), row_count(k)) = equations.residual.head(row_count(k));
    for (int i = 0; i < row_count(k); ++i) {
      const int row = row_of(first_row(k) + i);
      for (int j = 0; j < (is_tip ? rotations : per_node); ++j) system_(row, column + j) = equations.arrival(i, j);
      if (border.phase) system_(row, columns + 1) = axial[first_row(k) + i];
      right_[row] = -equations.residual[i];
      if (k == 0) continue;
      if (i >= rotations) system_(row, column - per_node + i) = -1;
      for (int j = 0; i < rotations && j < rotations; ++j)
        system_(row, column - per_node + j) = equations.mismatch_slope(i, j);
    }
    finite = finite && equations.mismatch_is_small;
  }
  const Change by = roughly ? by_parameter_roughly(state, residual) : by_parameter(state);
  for (int row = 0; row < columns; ++row) system_(row_of(row), columns) = by[row];
  return finite && right_.allFinite() && system_.factorise();
}

PathEquations::Change PathEquations::without_borders(const Eigen::VectorXd& solution) const {
  return solution.head(unknowns_ + 1);
}

std::optional<PathEquations::Linear> PathEquations::correct(PathState& state, const PathBorder& border,
                                                            double tolerance) {
  Linear result;
  double last = std::numeric_limits<double>::infinity();
  shooting_.forget_work();
  for (int iteration = 0; iteration < most_path_newton_steps; ++iteration) {
    arcs_marched_ += rod().arc_count();
    if (!evaluate(state, border, tolerance >= rough_tolerance)) return std::nullopt;
    system_.substitute(right_);
    const Change step = projected(without_borders(right_));
    double turn = 0;
    for (Eigen::Index at = 0; at < unknowns_; at += per_node) turn = std::max(turn, step.segment<3>(at).norm());
    const double size = step.cwiseAbs().maxCoeff();
    if (!std::isfinite(size) || turn > largest_newton_turn_rad) return std::nullopt;
    if (iteration == 0) result.first_step_rad = turn;
    state = moved(state, step);
    const bool stagnates = iteration > 2 && size > 0.5 * last && size < 1e-6;
    if (newton_curvature * size * size <= tolerance || stagnates) {
      right_ = Eigen::VectorXd::Zero(system_.size());
      right_[path_row_] = 1;
      system_.substitute(right_);
      result.tangent = projected(without_borders(right_));
      const double length = std::sqrt(inner(result.tangent, result.tangent));
      if (!std::isfinite(length) || !(length > 0)) return std::nullopt;
      result.tangent /= length;
      scene::Determinant& determinant = result.determinant;
      determinant.log_size = system_.log_determinant() + std::log(length);
      if (border.phase) determinant.log_size -= std::log(border.phase->turn.squaredNorm());
      determinant.negative = system_.determinant_is_negative() != odd_borders_;
      set_parameter(state.parameter);
      shooting_.set_nodes(state.nodes);
      determinant.log_growth = shooting_.log_growth();
      return result;
    }
    last = size;
  }
  return std::nullopt;
}

// Inverse iteration: what a segment's end does is asked of the segment's equations.
PathEquations::Change PathEquations::null_change(const Vector3d& turn_of_clamp) {
  Change change = zero_change();
  change.head<3>() = turn_of_clamp;
  for (int iteration = 0; iteration < 3; ++iteration) {
    right_ = Eigen::VectorXd::Zero(system_.size());
    for (std::size_t k = 0; k < mesh_.segments.size(); ++k) {
      const int known = std::min<int>(row_count(k), static_cast<int>(unknowns_) - per_node * static_cast<int>(k));
      for (int i = 0; i < known; ++i) {
        right_[row_of(first_row(k) + i)] = change[per_node * static_cast<Eigen::Index>(k) + i];
      }
    }
    system_.substitute(right_);
    change = without_borders(right_);
    change /= std::sqrt(inner(change, change));
  }
  return change;
}

}  // namespace fam
