#include "exact_reference/shooting.h"

#include "exact_reference/band_system.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace exact_reference {
namespace {

constexpr int clamp_rows = 4;
constexpr double most_parts = 8;  // of an interval that is split

// Of an interval whose error is this many times too large.
double parts_for(double excess) {
  return std::isfinite(excess) ? std::pow(excess, 1.0 / (runge_kutta_order + 1)) : most_parts;
}

// The components of a node's core that a system has: all, or those in a plane.
constexpr std::array all_components{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
constexpr std::array components_in_xy{0, 3, 4, 5, 9};
constexpr std::array components_in_xz{0, 2, 4, 6, 8};

// Rows, of m components: clamp conditions q = (1,0,0,0) (c of them: clamp_rows, in a plane half as many); m continuity
// conditions an interval; m - c conditions N = M = 0 beyond the tip's loads. The rows of interval i, c + m i and on,
// hold the columns m i to m i + 2 m - 1.
std::unique_ptr<BandSystem> band_system(std::span<const int> components, std::size_t intervals) {
  const long m = static_cast<long>(components.size()), c = m == core_size ? clamp_rows : clamp_rows / 2;
  return std::make_unique<BandSystem>(m * static_cast<long>(intervals + 1), 2 * m - 1 - c, c + m - 1);
}

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

Shooting::Shooting(const ScaledRod& rod, Mesh mesh) : rod_(rod), mesh_(std::move(mesh)) {}

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

Eigen::VectorXd Shooting::residual(const NodeStates& y, double load_factor, const Core& weight) const {
  const long n = static_cast<long>(mesh_.size());
  Eigen::VectorXd r(core_size * (n + 1));
  r.head<clamp_rows>() = y[0].head<clamp_rows>() - Eigen::Vector4d::Unit(0);
  for (long i = 0; i < n; ++i) {
    const State end = runge_kutta_step(equations(i, load_factor), start_state(y, load_factor, i), mesh_[i].length);
    r.segment<core_size>(clamp_rows + core_size * i) = (end - y[i + 1]).head<core_size>().cwiseProduct(weight);
  }
  r.tail<6>() = start_state(y, load_factor, n).segment<6>(4).cwiseProduct(weight.tail<6>());
  return r;
}

const Shooting::Linearised& Shooting::linearised(const NodeStates& y, double load_factor) const {
  const auto same = [](const State& a, const State& b) { return a.head<core_size>() == b.head<core_size>(); };
  if (linearised_.load_factor == load_factor && std::ranges::equal(y, linearised_.y, same)) return linearised_;
  const std::size_t n = mesh_.size();
  work_ += static_cast<double>(n);
  linearised_.y = y;
  linearised_.load_factor = load_factor;
  linearised_.ends.resize(n);
  linearised_.sensitivities.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    linearised_.ends[i] = runge_kutta_step(equations(i, load_factor), start_state(y, load_factor, i), mesh_[i].length,
                                           linearised_.sensitivities[i]);
  }
  return linearised_;
}

// Matrix and residual, unknowns and equations multiplied by `weight`. The residual goes to the system's vector.
void Shooting::assemble(BandSystem& band, std::span<const int> components, const NodeStates& y, double load_factor,
                        const Core& weight, std::vector<double>* volume_changes) const {
  const long n = static_cast<long>(mesh_.size()), m = static_cast<long>(components.size());
  const Linearised& linear = linearised(y, load_factor);
  band.set_zero();
  double* r = band.vector();
  long row = 0;
  for (; components[row] < 4; ++row) {
    band.entry(row, row) = 1;
    r[row] = y[0][components[row]] - (row == 0);
  }
  CoreMatrix sensitivity;
  for (long i = 0; i < n; ++i) {
    const State& end = linear.ends[i];
    sensitivity = linear.sensitivities[i];
    if (volume_changes != nullptr) (*volume_changes)[i] = std::abs(std::abs(sensitivity.determinant()) - 1);
    if (i > 0 && mesh_[i - 1].ends_span) {
      sensitivity *= equations(i - 1, load_factor).beyond_point_loads_jacobian(y[i]);
    }
    sensitivity = weight.asDiagonal() * sensitivity * weight.cwiseInverse().asDiagonal();
    const long column = m * i;
    for (long a = 0; a < m; ++a, ++row) {
      const int component = components[a];
      for (long b = 0; b < m; ++b) band.entry(row, column + b) = sensitivity(component, components[b]);
      band.entry(row, column + m + a) = -1;
      r[row] = weight[component] * (end[component] - y[i + 1][component]);
    }
  }
  const RodEquations last = equations(n - 1, load_factor);
  const State beyond = last.beyond_point_loads(y[n]);
  const CoreMatrix loads = last.beyond_point_loads_jacobian(y[n]);
  for (const int a : components) {
    if (a < 4) continue;
    for (long b = 0; b < m; ++b) {
      band.entry(row, m * n + b) = weight[a] * loads(a, components[b]) / weight[components[b]];
    }
    r[row++] = weight[a] * beyond[a];
  }
}

// A step's end that is not a number, from states that are.
bool Shooting::tendon_collapses(const NodeStates& y, double load_factor) const {
  if (!rod_.has_tendon()) return false;
  for (std::size_t i = 0; i < mesh_.size(); ++i) {
    const State start = start_state(y, load_factor, i);
    if (!start.allFinite()) return false;
    if (!runge_kutta_step(equations(i, load_factor), start, mesh_[i].length).allFinite()) return true;
  }
  return false;
}

Convergence Shooting::newton(NodeStates& y, double load_factor, double tolerance, int max_iterations) {
  constexpr int many_iterations = 5;
  Convergence result;
  int growths = 0;
  for (double last = HUGE_VAL; result.iterations < max_iterations; last = result.last_update) {
    ++result.iterations;
    const Core weight = weights(y);
    const NodeStates before = y;
    newton_equations(y, load_factor, weight);
    if (!band_->factorise() || !band_->solve()) {
      result.tendon_collapsed = tendon_collapses(y, load_factor);
      return result;
    }
    const double* update = band_->vector();
    result.last_update = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      const Eigen::Map<const Core> step(update + core_size * k);
      y[k].head<core_size>() -= step.cwiseQuotient(weight);
      if (!step.allFinite()) {
        result.tendon_collapsed = tendon_collapses(before, load_factor);
        return result;
      }
      result.last_update = std::max(result.last_update, step.lpNorm<Eigen::Infinity>());
    }
    const double roundoff_range = result.iterations < many_iterations ? 1e-9 : 1e-6;
    if (result.last_update <= tolerance || (result.last_update < roundoff_range && result.last_update >= last / 2)) {
      result.converged = true;
      return result;
    }
    growths = result.last_update > last ? growths + 1 : 0;
    if (growths == 2) return result;
  }
  return result;
}

BandSystem& Shooting::newton_equations(const NodeStates& y, double load_factor, const Core& weight) {
  if (!band_) band_ = band_system(all_components, mesh_.size());
  volume_changes_.resize(mesh_.size());
  assemble(*band_, all_components, y, load_factor, weight, &volume_changes_);
  return *band_;
}

std::vector<Core> Shooting::tangent(const NodeStates& y, double load_factor) {
  constexpr double step = 1e-4;  // the residual is almost linear in the load factor
  const Core weight = weights(y);
  const Eigen::VectorXd below = residual(y, load_factor - step, weight);  // above, a tendon may collapse
  newton_equations(y, load_factor, weight);
  std::vector<Core> result(y.size(), Core::Zero());
  if (!band_->factorise()) return result;
  double* x = band_->vector();
  Eigen::Map<Eigen::VectorXd> here(x, below.size());
  here = (below - here) / step;
  if (!band_->solve()) return result;
  for (std::size_t k = 0; k < y.size(); ++k) {
    result[k] = Eigen::Map<const Core>(x + core_size * k).cwiseQuotient(weight);
  }
  return result;
}

scene::Determinant Shooting::determinant(const NodeStates& y, double load_factor) const {
  return determinant(y, load_factor, rod_.symmetry);
}

scene::Determinant Shooting::determinant(const NodeStates& y, double load_factor, scene::Symmetry plane) const {
  std::span<const int> components = all_components;
  if (plane == scene::Symmetry::plane_xy) components = components_in_xy;
  if (plane == scene::Symmetry::plane_xz) components = components_in_xz;
  const std::unique_ptr<BandSystem> band = band_system(components, mesh_.size());
  assemble(*band, components, y, load_factor, weights(y));
  band->factorise();
  return band->determinant();
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

bool Shooting::refine(NodeStates& y, double load_factor, double tolerance, double most_volume_change,
                      int max_intervals) {
  const Core weight = weights(y);
  std::vector<int> parts(mesh_.size());
  long total = 0;
  for (std::size_t i = 0; i < mesh_.size(); ++i) {
    const double error = local_error(y, load_factor, weight, i);
    double wanted = parts_for(error / tolerance);
    if (volume_changes_.size() == mesh_.size())
      wanted = std::max(wanted, parts_for(volume_changes_[i] / most_volume_change));
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
  volume_changes_.clear();
  linearised_ = {};
}

}  // namespace exact_reference
