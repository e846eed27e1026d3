#include "fam/solver.h"

#include <limits>

namespace fam {
// Provisional: stands in until the kept solver is here.
struct Solver::Impl {
  scene::Scene scene;
  Options options;
  scene::Equilibrium last;
  std::vector<double> s_mm;
  std::vector<scene::Pose> poses;
  std::vector<scene::Wrench> wrenches;
};
Solver::Solver(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;
Solver::~Solver() = default;

std::variant<Solver, Refusal> Solver::make(const scene::Scene& scene, const Options& options) {
  scene::validate(scene);
  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  impl->options = options;
  return Solver(std::move(impl));
}
namespace {
template <class Kind>
Kind& as_kind(scene::Scene& scene, std::size_t load) {
  if (load >= scene.loads.size()) throw scene::SceneError("scene: loads[" + std::to_string(load) + "]: there is none");
  if (!std::holds_alternative<Kind>(scene.loads[load])) throw scene::SceneError("scene: loads[" + std::to_string(load) + "]: another kind");
  return std::get<Kind>(scene.loads[load]);
}
const double nan = std::numeric_limits<double>::quiet_NaN();
}
#define SET(name, Kind, field, Type)                       \
  void Solver::name(std::size_t load, Type value) {        \
    scene::Scene copy = impl_->scene;                      \
    as_kind<scene::Kind>(copy, load).field = value;        \
    scene::validate(copy);                                 \
    impl_->scene = copy;                                   \
  }
SET(set_force_N, Force, value_N, const Eigen::Vector3d&)
SET(set_moment_Nmm, Moment, value_Nmm, const Eigen::Vector3d&)
SET(set_distributed_N_per_mm, DistributedForce, value_N_per_mm, const Eigen::Vector3d&)
SET(set_acceleration_m_per_s2, Gravity, acceleration_m_per_s2, const Eigen::Vector3d&)
SET(set_tension_N, Tendon, tension_N, double)
void Solver::set_at_mm(std::size_t load, double s_mm) { as_kind<scene::Force>(impl_->scene, load).at_mm = s_mm; }
void Solver::set_rest_curvature_per_mm(std::size_t section, const Eigen::Vector3d& u) {
  impl_->scene.sections.at(section).rest_curvature_per_mm = u;
}
const scene::Scene& Solver::scene() const { return impl_->scene; }
Solver::Outcome Solver::solve(Start) noexcept {
  scene::Equilibrium now = fam::solve(impl_->scene, impl_->options);
  if (!now.converged()) return {now.status, 0, 0, "failed"};
  impl_->last = now;
  impl_->s_mm.clear(), impl_->poses.clear(), impl_->wrenches.clear();
  for (const auto& s : now.stations) {
    impl_->s_mm.push_back(s.s_mm);
    impl_->poses.push_back(s.X_BS);
    impl_->wrenches.push_back({s.force_B_N, s.moment_B_Nmm});
  }
  return {now.status, 1, 1, ""};
}
bool Solver::solved() const noexcept { return !impl_->s_mm.empty(); }
const scene::Pose& Solver::tip() const { return impl_->poses.back(); }
scene::Wrench Solver::base_wrench_B() const { return impl_->wrenches.front(); }
std::span<const double> Solver::s_mm() const { return impl_->s_mm; }
std::span<const scene::Pose> Solver::poses() const { return impl_->poses; }
std::span<const scene::Wrench> Solver::wrenches_B() const { return impl_->wrenches; }
scene::Pose Solver::pose_at(double) const noexcept { return tip(); }
scene::Wrench Solver::wrench_at(double) const noexcept { return base_wrench_B(); }
double Solver::error_estimate_mm() { return impl_->last.error_estimate_mm; }
std::optional<bool> Solver::stable() const { return impl_->last.stable; }
#define DERIVATIVE(Type, name, ...) \
  Solver::Type Solver::name(__VA_ARGS__) const noexcept { return Type::Constant(nan); }
DERIVATIVE(Matrix6, compliance, double)
DERIVATIVE(Matrix63, by_load, std::size_t, double)
DERIVATIVE(Matrix63, by_rest_curvature, std::size_t, double)
DERIVATIVE(Matrix63, by_stiffness, std::size_t, double)
DERIVATIVE(Vector6, by_place, std::size_t, double)
DERIVATIVE(Matrix6, strain_compliance, double)
DERIVATIVE(Matrix63, strain_by_load, std::size_t, double)
DERIVATIVE(Matrix63, strain_by_rest_curvature, std::size_t, double)
DERIVATIVE(Matrix63, strain_by_stiffness, std::size_t, double)
DERIVATIVE(Vector6, strain_by_place, std::size_t, double)
DERIVATIVE(Matrix6, wrench_compliance, double)
DERIVATIVE(Matrix63, wrench_by_load, std::size_t, double)
DERIVATIVE(Matrix63, wrench_by_rest_curvature, std::size_t, double)
DERIVATIVE(Matrix63, wrench_by_stiffness, std::size_t, double)
DERIVATIVE(Vector6, wrench_by_place, std::size_t, double)
void Solver::jacobian(std::span<const double>, std::span<const Parameter>, Eigen::Ref<Eigen::MatrixXd> result) const noexcept {
  result.setConstant(nan);
}
}  // namespace fam
