// What a Solver tells of its last solution: poses and wrenches, estimate, stability, derivatives.
#include "fam/answer.h"
#include "fam/load_length.h"
#include "fam/solver_impl.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void Solver::Impl::place_ends() {
  if (ends.known || !solved) return;
  ends.s_mm.assign(1, 0);
  ends.poses.assign(1, solution.pose({0, 0}));
  ends.wrenches_B.assign(1, solution.own_wrench_B({0, 0}));
  for (int arc = 0; arc < solution.arc_count(); ++arc) {
    ends.s_mm.push_back(solution.arc_end_mm(arc));
    ends.poses.push_back(solution.pose({arc, 1}));
    ends.wrenches_B.push_back(solution.own_wrench_B({arc, 1}));
  }
  ends.known = true;
}

void Solver::Impl::take_states(const Solution& from, std::span<const int> arcs_per_span) {
  auto& [known, arcs_taken, poses, wrenches] = solved_states;
  arcs_taken.assign(arcs_per_span.begin(), arcs_per_span.end());
  poses.assign(1, SectionPose{});
  wrenches.clear();
  for (int arc = 0; arc < from.arc_count(); ++arc) {
    const scene::Pose pose = from.pose({arc, 1});
    poses.push_back({pose.rotation_BS, pose.position_B_mm});
    wrenches.push_back(from.state({arc, 1}, pose).wrench);
  }
}

// The largest of an arc, in space and with the rod's own GJ, whatever it was solved as.
double Solver::Impl::swing_of_changes_rad() const {
  double largest = 0;
  std::size_t arc = 0;
  for (std::size_t i = 0; i < solved_states.arcs.size(); ++i) {
    const scene::Span& span = solved->problem.scene_spans()[i];
    const int count = solved_states.arcs[i];
    for (int k = 0; k < count; ++k, ++arc) {
      const double rate_per_mm = swing_rate_per_mm(span, solved_states.distal_wrenches_S[arc].moment_Nmm);
      largest = std::max(largest, rate_per_mm * span.length_mm() / count);
    }
  }
  return largest;
}

// A circle is exact with a single arc, its changes out of the plane are not: then the states of a finer run. False:
// that takes more arcs than are reserved, or fails.
bool Solver::Impl::take_states_for_changes() {
  const auto& [problem, run] = *solved;
  take_states(solution, run.arcs);
  if (options.arcs > 0) return true;
  const double allowed_rad = allowed_swing_rad(problem.choice().law, problem.tolerance_mm() / problem.length_mm());
  const double times = std::ceil(swing_of_changes_rad() / allowed_rad);
  if (!(times > 1)) return true;
  if (!(times * run.arc_count() <= most_arcs)) return false;
  spare[0].solve(problem, run.arcs, static_cast<int>(times), &run);
  if (!spare[0].converged()) return false;
  finer.set(problem, spare[0]);
  take_states(finer, spare[0].arcs);
  return true;
}

// Null: no solution, of a law without slopes, or with more arcs than are reserved.
Response* Solver::Impl::prepared_response() {
  if (!solved || !facts_of(solved->problem.choice().law).coupled) return nullptr;
  if (solved_states.known) return solved_states.arcs.empty() ? nullptr : &response;
  solved_states.known = true;
  if (!take_states_for_changes()) {
    solved_states.arcs.clear();
    return nullptr;
  }
  const Problem& problem = solved->problem;
  const Choice& choice = problem.choice();
  response.set({&problem.scene(), problem.scene_spans(), problem.section_of_span(), solved_states.arcs,
                solved_states.poses, solved_states.distal_wrenches_S, choice.law, choice.rod.model,
                choice.plane ? std::optional(choice.rotation_BP) : std::nullopt});
  return &response;
}

// As solve() estimates: with a fixed number of arcs by the law's order, else with the first run's safety.
double Solver::Impl::estimate_mm() {
  if (solved->run.arc_count() > most_arcs / 2) return std::numeric_limits<double>::infinity();
  const double by_doubling_mm = estimate_by_doubling_mm(solved->problem, solved->run, spare[0]);
  return options.arcs > 0 ? by_doubling_mm : coarse_safety * by_doubling_mm;
}

bool Solver::solved() const noexcept {
  return impl_->solved;
}
const scene::Pose& Solver::tip() const {
  return impl_->tip;
}
scene::Wrench Solver::base_wrench_B() const {
  return impl_->solved ? impl_->solution.own_wrench_B({0, 0}) : no_wrench;
}
std::span<const double> Solver::s_mm() const {
  impl_->place_ends();
  return impl_->ends.s_mm;
}
std::span<const scene::Pose> Solver::poses() const {
  impl_->place_ends();
  return impl_->ends.poses;
}
std::span<const scene::Wrench> Solver::wrenches_B() const {
  impl_->place_ends();
  return impl_->ends.wrenches_B;
}

scene::Pose Solver::pose_at(double s_mm) const noexcept {
  return impl_->is_on_rod(s_mm) ? impl_->solution.pose(impl_->solution.place_at(s_mm)) : no_pose;
}
scene::Wrench Solver::wrench_at(double s_mm) const noexcept {
  return impl_->is_on_rod(s_mm) ? impl_->solution.own_wrench_B(impl_->solution.place_at(s_mm)) : no_wrench;
}

double Solver::error_estimate_mm() {
  if (!impl_->solved) return nan;
  if (!impl_->error_mm) impl_->error_mm = impl_->estimate_mm();
  return *impl_->error_mm;
}

std::optional<bool> Solver::stable() const {
  if (!impl_->solved) return std::nullopt;
  const auto& [problem, run] = *impl_->solved;
  if (!impl_->stable) {
    impl_->stable = is_stable(problem, run, nullptr, impl_->spare[0], impl_->spare[1], impl_->most_arcs);
  }
  return *impl_->stable;
}

// Of a solution; NaN without one.
template <class Answer, class Ask>
Answer Solver::asked(Ask&& ask) const noexcept {
  Response* response = impl_->prepared_response();
  if (!response) return Answer::Constant(nan);
  return ask(*response);
}

#define FAM_DERIVATIVES(prefix, what)                                                                   \
  Solver::Matrix6 Solver::prefix##compliance(double s_mm) const noexcept {                              \
    return asked<Matrix6>([=](Response& r) { return r.compliance(s_mm, what); });                       \
  }                                                                                                     \
  Solver::Matrix63 Solver::prefix##by_load(std::size_t load, double s_mm) const noexcept {              \
    return asked<Matrix63>([=](Response& r) { return r.by_load(load, s_mm, what); });                   \
  }                                                                                                     \
  Solver::Matrix63 Solver::prefix##by_rest_curvature(std::size_t section, double s_mm) const noexcept { \
    return asked<Matrix63>([=](Response& r) { return r.by_rest_curvature(section, s_mm, what); });      \
  }                                                                                                     \
  Solver::Matrix63 Solver::prefix##by_stiffness(std::size_t section, double s_mm) const noexcept {      \
    return asked<Matrix63>([=](Response& r) { return r.by_stiffness(section, s_mm, what); });           \
  }                                                                                                     \
  Solver::Vector6 Solver::prefix##by_place(std::size_t load, double s_mm) const noexcept {              \
    return asked<Vector6>([=](Response& r) { return Vector6(r.by_place(load, s_mm, what).col(0)); });   \
  }
FAM_DERIVATIVES(, Response::What::pose)
FAM_DERIVATIVES(strain_, Response::What::strain)
FAM_DERIVATIVES(wrench_, Response::What::wrench)
#undef FAM_DERIVATIVES

void Solver::jacobian(std::span<const double> s_mm, std::span<const Parameter> parameters,
                      Eigen::Ref<Eigen::MatrixXd> result) const noexcept {
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& parameter = parameters[k];
    for (std::size_t i = 0; i < s_mm.size(); ++i) {
      result.block<6, 1>(static_cast<Eigen::Index>(6 * i), static_cast<Eigen::Index>(k)) = by(parameter, s_mm[i]);
    }
  }
}

Solver::Vector6 Solver::by(const Parameter& parameter, double s_mm) const noexcept {
  using enum Parameter::Kind;
  const int component = parameter.component;
  if (component < 0 || component > 2) return Vector6::Constant(nan);
  switch (parameter.kind) {
    case load: return by_load(parameter.index, s_mm).col(component);
    case rest_curvature: return by_rest_curvature(parameter.index, s_mm).col(component);
    case stiffness: return by_stiffness(parameter.index, s_mm).col(component);
    case place: break;
  }
  return component == 0 ? by_place(parameter.index, s_mm) : Vector6::Constant(nan);
}

}  // namespace fam
