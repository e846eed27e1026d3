#include "exact_reference/shooting.h"

#include "exact_reference/band_system.h"

#include <algorithm>
#include <cmath>

namespace exact_reference {
namespace {

// Rows: 4 clamp conditions q = (1,0,0,0); 10 continuity conditions an interval; 6 conditions N = M = 0 beyond the tip's
// loads. The rows of interval i, 4 + 10 i and on, hold the columns 10 i to 10 i + 19.
constexpr int clamp_rows = 4;
constexpr int upper_band = 15;
constexpr int lower_band = 13;

}  // namespace

Shooting::Shooting(const ScaledRod& rod, int minimum) : rod_(rod) {
  constexpr double turn_per_interval_rad = 0.5;
  for (int k = 0; k < static_cast<int>(rod.spans.size()); ++k) {
    const ScaledSpan& span = rod.spans[k];
    const double per_length = std::max<double>(minimum, span.rest_curvature_S.norm() / turn_per_interval_rad);
    const int count = std::max(1, static_cast<int>(std::ceil(per_length * span.length() - 1e-9)));
    for (int i = 0; i < count; ++i) {
      mesh_.push_back({k, span.start + span.length() * i / count, span.length() / count, i + 1 == count});
    }
  }
}

Shooting::~Shooting() = default;

RodEquations Shooting::equations(std::size_t i, double load_factor) const {
  return RodEquations(rod_.spans[mesh_[i].span], load_factor);
}

State Shooting::start_state(const NodeStates& y, double load_factor, std::size_t i) const {
  if (i == 0 || !mesh_[i - 1].ends_span) return y[i];
  return equations(i - 1, load_factor).beyond_point_loads(y[i]);
}

NodeStates Shooting::unloaded() const {
  NodeStates y(mesh_.size() + 1, State::Zero());
  y[0][0] = 1;
  for (std::size_t i = 0; i < mesh_.size(); ++i) y[i + 1] = runge_kutta_step(equations(i, 0), y[i], mesh_[i].length);
  return y;
}

void Shooting::integrate_positions(NodeStates& y, double load_factor) const {
  y[0].tail<3>().setZero();
  for (std::size_t i = 0; i < mesh_.size(); ++i) {
    const State start = start_state(y, load_factor, i);
    y[i + 1].tail<3>() = runge_kutta_step(equations(i, load_factor), start, mesh_[i].length).tail<3>();
  }
}

Core Shooting::weights(const NodeStates& y) const {
  double force = 0, moment = 0;
  for (const State& state : y) {
    force = std::max(force, state.segment<3>(4).norm());
    moment = std::max(moment, state.segment<3>(7).norm());
  }
  Core weight = Core::Ones();
  weight.segment<3>(4).setConstant(1 / (1 + force));
  weight.segment<3>(7).setConstant(1 / (1 + moment));
  return weight;
}

std::vector<Core> Shooting::residual(const NodeStates& y, double load_factor) const {
  const std::size_t n = mesh_.size();
  std::vector<Core> r(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const State end = runge_kutta_step(equations(i, load_factor), start_state(y, load_factor, i), mesh_[i].length);
    r[i] = (end - y[i + 1]).head<core_size>();
  }
  r[n] = start_state(y, load_factor, n).head<core_size>();  // rows 4 to 9 are the conditions at the tip
  r[n].head<4>() = y[0].head<4>() - Eigen::Vector4d::Unit(0);
  return r;
}

// Matrix and residual, unknowns and equations multiplied by `weight`. The residual goes to the system's vector.
void Shooting::assemble(const NodeStates& y, double load_factor, const Core& weight) {
  const long n = static_cast<long>(mesh_.size());
  if (!band_) band_ = std::make_unique<BandSystem>(core_size * (n + 1), upper_band, lower_band);
  band_->set_zero();
  double* r = band_->vector();
  for (int k = 0; k < clamp_rows; ++k) {
    band_->entry(k, k) = 1;
    r[k] = y[0][k] - (k == 0);
  }
  CoreMatrix sensitivity;
  for (long i = 0; i < n; ++i) {
    const State start = start_state(y, load_factor, i);
    const State end = runge_kutta_step(equations(i, load_factor), start, mesh_[i].length, sensitivity);
    if (i > 0 && mesh_[i - 1].ends_span) {
      sensitivity *= equations(i - 1, load_factor).beyond_point_loads_jacobian(y[i]);
    }
    sensitivity = weight.asDiagonal() * sensitivity * weight.cwiseInverse().asDiagonal();
    const long row = clamp_rows + core_size * i, column = core_size * i;
    for (int a = 0; a < core_size; ++a) {
      for (int b = 0; b < core_size; ++b) band_->entry(row + a, column + b) = sensitivity(a, b);
      band_->entry(row + a, column + core_size + a) = -1;
      r[row + a] = weight[a] * (end[a] - y[i + 1][a]);
    }
  }
  const RodEquations last = equations(n - 1, load_factor);
  const State beyond = last.beyond_point_loads(y[n]);
  const CoreMatrix loads = last.beyond_point_loads_jacobian(y[n]);
  const long row = clamp_rows + core_size * n, column = core_size * n;
  for (int a = 4; a < core_size; ++a) {
    for (int b = 0; b < core_size; ++b) band_->entry(row + a - 4, column + b) = weight[a] * loads(a, b) / weight[b];
    r[row + a - 4] = weight[a] * beyond[a];
  }
}

Convergence Shooting::newton(NodeStates& y, double load_factor, double tolerance, int max_iterations) {
  constexpr double roundoff_range = 1e-9;
  Convergence result;
  int growths = 0;
  for (double last = HUGE_VAL; result.iterations < max_iterations; last = result.last_update) {
    ++result.iterations;
    const Core weight = weights(y);
    assemble(y, load_factor, weight);
    if (!band_->factorise() || !band_->solve()) return result;
    const double* update = band_->vector();
    result.last_update = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      const Eigen::Map<const Core> step(update + core_size * k);
      y[k].head<core_size>() -= step.cwiseQuotient(weight);
      if (!step.allFinite()) return result;
      result.last_update = std::max(result.last_update, step.lpNorm<Eigen::Infinity>());
    }
    if (result.last_update <= tolerance || (result.last_update < roundoff_range && result.last_update >= last / 2)) {
      result.converged = true;
      return result;
    }
    growths = result.last_update > last ? growths + 1 : 0;
    if (growths == 2) return result;
  }
  return result;
}

std::vector<Core> Shooting::tangent(const NodeStates& y, double load_factor) {
  constexpr double step = 1e-4;  // the residual is almost linear in the load factor
  const std::vector<Core> above = residual(y, load_factor + step), below = residual(y, load_factor - step);
  const Core weight = weights(y);
  assemble(y, load_factor, weight);
  std::vector<Core> result(y.size(), Core::Zero());
  if (!band_->factorise()) return result;
  double* x = band_->vector();
  std::fill(x, x + clamp_rows, 0.0);
  for (std::size_t k = 0; k < y.size(); ++k) {
    const Core slope = weight.cwiseProduct(below[k] - above[k]) / (2 * step);
    const bool tip = k + 1 == y.size();
    std::copy(slope.data() + (tip ? 4 : 0), slope.data() + core_size, x + clamp_rows + core_size * k);
  }
  if (!band_->solve()) return result;
  for (std::size_t k = 0; k < y.size(); ++k) {
    result[k] = Eigen::Map<const Core>(x + core_size * k).cwiseQuotient(weight);
  }
  return result;
}

Determinant Shooting::determinant() const {
  return band_->determinant();
}

double Shooting::local_error(const NodeStates& y, double load_factor, const Core& weight, std::size_t i) const {
  const RodEquations rod = equations(i, load_factor);
  const double h = mesh_[i].length;
  const State start = start_state(y, load_factor, i);
  const State difference =
      runge_kutta_step(rod, start, h) - runge_kutta_step(rod, runge_kutta_step(rod, start, h / 2), h / 2);
  return std::max(difference.head<core_size>().cwiseProduct(weight).lpNorm<Eigen::Infinity>(),
                  difference.tail<3>().lpNorm<Eigen::Infinity>());
}

bool Shooting::refine(NodeStates& y, double load_factor, double tolerance, int max_intervals) {
  constexpr double most_parts = 8;
  const Core weight = weights(y);
  std::vector<int> parts(mesh_.size());
  long total = 0;
  for (std::size_t i = 0; i < mesh_.size(); ++i) {
    const double error = local_error(y, load_factor, weight, i);
    const double wanted =
        std::isfinite(error) ? std::pow(error / tolerance, 1.0 / (runge_kutta_order + 1)) : most_parts;
    parts[i] = wanted <= 1 ? 1 : static_cast<int>(std::ceil(std::clamp(wanted, 2.0, most_parts)));
    total += parts[i];
  }
  if (total == static_cast<long>(mesh_.size()) || total > max_intervals) return false;
  split(y, load_factor, parts);
  return true;
}

void Shooting::halve(NodeStates& y, double load_factor) {
  split(y, load_factor, std::vector<int>(mesh_.size(), 2));
}

void Shooting::split(NodeStates& y, double load_factor, const std::vector<int>& parts) {
  Mesh mesh;
  NodeStates states{y[0]};
  for (std::size_t i = 0; i < mesh_.size(); ++i) {
    Interval part = mesh_[i];
    part.length /= parts[i];
    const RodEquations rod = equations(i, load_factor);
    State state = start_state(y, load_factor, i);
    for (int k = 0; k < parts[i]; ++k) {
      const bool last = k + 1 == parts[i];
      part.start = mesh_[i].start + k * part.length;
      part.ends_span = last && mesh_[i].ends_span;
      mesh.push_back(part);
      if (!last) state = runge_kutta_step(rod, state, part.length);
      states.push_back(last ? y[i + 1] : state);
    }
  }
  mesh_ = std::move(mesh);
  y = std::move(states);
  band_.reset();
}

}  // namespace exact_reference
