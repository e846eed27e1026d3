#include "exact_reference/continuation.h"

#include "exact_reference/solution_vector.h"
#include "exact_reference/stability.h"

#include <algorithm>
#include <utility>

namespace exact_reference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_mesh_intervals = 20'000;

std::vector<double> places_of(const Mesh& mesh) {
  std::vector<double> places;
  for (const Interval& interval : mesh) places.push_back(interval.start);
  places.push_back(mesh.back().start + mesh.back().length);
  return places;
}

}  // namespace

Continuation::Continuation(ScaledRod rod, ParameterSetter set, double parameter_scale, double tolerance, Mesh mesh,
                           bool has_energy)
    : rod_(std::move(rod)),
      set_(std::move(set)),
      scale_(parameter_scale),
      tolerance_(tolerance),
      shooting_(rod_, std::move(mesh)),
      has_energy_(has_energy) {}

void Continuation::set(double parameter) {
  if (parameter == set_to_) return;
  load_factor_ = set_(rod_, parameter);
  set_to_ = parameter;
  shooting_.forget();
}

NodeStates Continuation::states(const VectorXd& x) {
  set(x[x.size() - 1]);
  NodeStates y = node_states_of(x);
  shooting_.integrate_positions(y, load_factor_);
  return y;
}

VectorXd Continuation::weighted(const VectorXd& a) const {
  VectorXd result(a.size());
  for (long i = 0; i + 1 < a.size(); i += core_size) {
    result.segment<core_size>(i) = weight_.cwiseProduct(a.segment<core_size>(i));
  }
  result.tail<1>() = a.tail<1>() / scale_;
  return result;
}

VectorXd Continuation::unweighted(const VectorXd& a) const {
  VectorXd result(a.size());
  for (long i = 0; i + 1 < a.size(); i += core_size) {
    result.segment<core_size>(i) = a.segment<core_size>(i).cwiseQuotient(weight_);
  }
  result.tail<1>() = a.tail<1>() * scale_;
  return result;
}

VectorXd Continuation::row_of(const VectorXd& direction) const {
  VectorXd row = weighted(direction);
  row.head(row.size() - 1) /= static_cast<double>(shooting_.mesh().size() + 1);
  return row;
}

double Continuation::largest_residual(const VectorXd& x) {
  set(x[x.size() - 1]);
  return shooting_.residual(node_states_of(x), load_factor_, weight_).lpNorm<Eigen::Infinity>();
}

double Continuation::inner(const VectorXd& a, const VectorXd& b) const {
  return row_of(a).dot(weighted(b));
}

double Continuation::distance(const VectorXd& a, const VectorXd& b) const {
  return std::sqrt(inner(a - b, a - b));
}

double Continuation::turn_to(const Solution& there) const {
  double turn = std::acos(std::clamp(inner(base_.tangent, there.tangent), -1.0, 1.0));
  const VectorXd change = there.x - base_.x;
  for (long i = 0; i + 1 < change.size(); i += core_size) turn = std::max(turn, 2 * change.segment<4>(i).norm());
  return turn;
}

bool Continuation::leads_to(const Solution& there) {
  // Chosen; of 3309 steps on some fifty paths the halfway residual of half is below 9e-8, of 99 % below 4e-6.
  constexpr double largest_turn_rad = 0.35, largest_halfway = 1e-5;
  if (!(turn_to(there) < largest_turn_rad)) return false;
  const double length = distance(there.x, base_.x);
  return largest_residual((base_.x + there.x) / 2 + length / 8 * (base_.tangent - there.tangent)) < largest_halfway;
}

bool Continuation::is_straight(const VectorXd& x) const {
  constexpr double straight = 1e-7;
  const VectorXd weighted_x = weighted(x);
  double off_axis = 0;
  for (long i = 0; i + 1 < x.size(); i += core_size) {
    for (const long pair : {2, 5, 8}) off_axis = std::max(off_axis, weighted_x.segment<2>(i + pair).norm());
  }
  return off_axis < straight;
}

// The derivative by the parameter over its scale, by differences of fourth order; exact where loads are linear in it.
VectorXd Continuation::parameter_column(const NodeStates& y, double parameter) {
  constexpr double step = 2e-4;
  const auto residual = [&](double steps) {
    set(parameter + steps * step * scale_);
    return shooting_.residual(y, load_factor_, weight_);
  };
  return (8 * (residual(1) - residual(-1)) - (residual(2) - residual(-2))) / (12 * step);
}

Continuation::Bordered Continuation::bordered(const VectorXd& x, const VectorXd& direction) {
  const long n = size(), k = turns_freely() ? 2 : 1;
  const double parameter = x[n];
  const NodeStates y = node_states_of(x);
  MatrixXd columns = MatrixXd::Zero(n + k, k), rows(k, n);
  columns.col(0).head(n) = parameter_column(y, parameter);
  const VectorXd row = row_of(direction);
  rows.row(0) = row.head(n);
  columns(n, 0) = row[n];
  if (turns_freely()) {
    columns.col(1).head(n) = free_column_;
    rows.row(1) = free_row_;
  }
  set(parameter);
  return {shooting_.newton_equations(y, load_factor_, weight_), columns, rows};
}

bool Continuation::factorise(const VectorXd& x, const VectorXd& direction) {
  Bordered all = bordered(x, direction);
  return all.columns.allFinite() && matrix_.factorise(all.band, all.columns, all.rows);
}

bool Continuation::correct(VectorXd& x, const VectorXd& origin, const VectorXd& direction, double s) {
  constexpr int most_iterations = 12, many_iterations = 5;
  constexpr double converged = 1e-13;
  const long n = size();
  int growths = 0;
  double last = HUGE_VAL;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    Bordered all = bordered(x, direction);
    if (!all.columns.allFinite() || !matrix_.factorise(all.band, all.columns, all.rows)) return false;
    VectorXd right = VectorXd::Zero(n + all.columns.cols());
    right.head(n) = Eigen::Map<const VectorXd>(all.band.vector(), n);
    right[n] = inner(direction, x - origin) - s;
    if (turns_freely()) right[n + 1] = free_row_.dot(weighted(x - origin).head(n));
    const VectorXd update = matrix_.solve(right);
    const double size_of_update = update.head(n + 1).lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size_of_update)) return false;
    x -= unweighted(update.head(n + 1));
    const double roundoff_range = iteration < many_iterations ? 1e-9 : 1e-6;
    if (size_of_update <= converged || (size_of_update < roundoff_range && size_of_update >= last / 2)) return true;
    growths = size_of_update > last ? growths + 1 : 0;
    if (growths == 2) return false;
    last = size_of_update;
  }
  return false;
}

bool Continuation::measure(Solution& at) {
  const long n = size();
  if (!factorise(at.x, base_.tangent)) return false;
  const VectorXd z = matrix_.solve(VectorXd::Unit(n + (turns_freely() ? 2 : 1), n));
  if (!z.allFinite()) return false;
  at.negative = matrix_.has_negative_determinant();
  at.tangent = unweighted(z.head(n + 1));
  at.tangent /= std::sqrt(inner(at.tangent, at.tangent));
  const NodeStates y = node_states_of(at.x);
  at.index.reset();
  at.negative_in_xy.reset();
  if (has_energy_) {
    at.index = falling_directions(shooting_, y, load_factor_, turns_freely());
  } else if (is_straight(at.x)) {
    at.negative_in_xy = shooting_.determinant(y, load_factor_, scene::Symmetry::plane_xy).negative;
  }
  return true;
}

std::optional<Solution> Continuation::at(double s, const VectorXd& guess) {
  Solution result;
  result.x = guess;
  if (!correct(result.x, base_.x, base_.tangent, s) || !measure(result)) return std::nullopt;
  return result;
}

std::optional<Solution> Continuation::at_parameter(double parameter, const Solution& near) {
  Solution result = near;
  const long n = size();
  const VectorXd direction = scale_ * VectorXd::Unit(n + 1, n);
  if (!correct(result.x, near.x, direction, (parameter - near.parameter()) / scale_)) return std::nullopt;
  result.x[n] = parameter;
  if (!measure(result)) return std::nullopt;
  return result;
}

bool Continuation::refine(Solution& at) {
  constexpr int most_rounds = 20;
  constexpr double volume_change = 1e-6;
  const double local_tolerance = std::max(tolerance_ / 20, 1e-14);
  for (int round = 0; round < most_rounds; ++round) {
    NodeStates y = states(at.x);
    weight_ = shooting_.weights(y);
    at.tangent /= std::sqrt(inner(at.tangent, at.tangent));
    const std::vector<double> places = places_of(shooting_.mesh());
    if (!shooting_.refine(y, load_factor_, local_tolerance, volume_change, most_mesh_intervals)) return true;
    at.x = solution_of(y, at.parameter());
    at.tangent = interpolated(at.tangent, places, places_of(shooting_.mesh()));
    at.tangent /= std::sqrt(inner(at.tangent, at.tangent));
    if (turns_freely()) {
      free_row_ = row_of(turned_about_axis(at.x)).head(size());
      free_column_ = any_vector(size(), 1);
    }
    const VectorXd origin = at.x;
    if (!correct(at.x, origin, at.tangent, 0)) return false;
  }
  return true;
}

bool Continuation::start(const NodeStates& y, double parameter, double direction) {
  const long n = size();
  Solution at;
  at.x = solution_of(y, parameter);
  at.tangent = direction * VectorXd::Unit(n + 1, n);
  weight_ = shooting_.weights(y);
  const VectorXd origin = at.x;
  if (!correct(at.x, origin, scale_ * at.tangent, 0)) return false;
  // Refined along its own tangent: beside a fold there may be none at this very value on the finer mesh.
  base_ = std::move(at);
  if (!measure(base_) || !advance(base_)) return false;
  const std::optional<Solution> exact = at_parameter(parameter, base_);
  if (exact && distance(exact->x, base_.x) < 1e-3) base_ = *exact;
  return measure(base_);
}

void Continuation::start_branch(const VectorXd& x, const VectorXd& direction, const VectorXd* free_turn) {
  base_ = {};
  base_.x = x;
  weight_ = shooting_.weights(states(x));
  base_.tangent = direction / std::sqrt(inner(direction, direction));
  hold_turn();
  if (free_turn == nullptr) return;
  free_row_ = row_of(*free_turn).head(size()).normalized();
  free_column_ = any_vector(size(), 1);
}

bool Continuation::advance(Solution next) {
  const std::size_t intervals = shooting_.mesh().size();
  if (!refine(next) || (turns_freely() && !set_free_turn(next))) return false;
  base_ = std::move(next);
  // A refined mesh has another determinant, other borders may have another sign.
  return (shooting_.mesh().size() == intervals && !turns_freely()) || measure(base_);
}

}  // namespace exact_reference
