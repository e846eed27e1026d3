#include "fam/solver.h"

#include "fam/answer.h"
#include "fam/response.h"
#include "fam/solution.h"
#include "scene/load_visitor.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace fam {
namespace {

using Eigen::Vector3d;
using scene::Status;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const scene::Pose no_pose{Matrix3d::Constant(nan), Vector3d::Constant(nan)};
const scene::Wrench no_wrench{Vector3d::Constant(nan), Vector3d::Constant(nan)};

// A problem and its solution.
struct Attempt {
  Problem problem;
  Run run;
};

const char* message_of(Status status) {
  switch (status) {
    case Status::converged: return "";
    case Status::tolerance_not_met: return "the tolerance takes more arcs than are reserved";
    case Status::limit_point: return "the loads meet a fold on their way, where the rod would snap";
    case Status::load_step_too_small: return "the load step fell below its smallest: branches meet, or a fold";
    case Status::work_limit: return "the limit of load steps and arcs marched was used up";
    case Status::arc_not_converged: return "an arc is too long for its law; more arcs make each one easier";
    case Status::tendon_collapsed: return "a tendon's path has no length somewhere: |v + u x r| = 0";
    case Status::not_finite: return "a pose or wrench is not finite";
    case Status::unsupported: return "the law cannot solve this scene";
    case Status::not_converged: break;
  }
  return "Newton's method did not converge";
}

// The wrench without the point loads at the span's end.
SectionState<3> before_point_loads(SectionState<3> state, const scene::Span& span) {
  const Matrix3d& R_SB = state.rotation_SB;
  state.wrench.force_N -= span.follower_load_S.force_N + R_SB * span.fixed_load_B.force_N;
  state.wrench.moment_Nmm -= span.follower_load_S.moment_Nmm + R_SB * span.fixed_load_B.moment_Nmm +
                             scene::moment_of_arms<double>(R_SB * span.fixed_force_arms_BS_Nmm);
  return state;
}

// A value that the scene format refuses, as it does: on a copy, so that the scene stays as it is.
template <class Change>
[[noreturn]] void refuse(scene::Scene copy, Change&& change) {
  change(copy);
  scene::validate(copy);
  throw scene::SceneError("scene: a value is refused");
}

std::string name_of(std::size_t load) {
  return "scene: loads[" + std::to_string(load) + "]";
}

// The load of this kind, whose value is good.
template <class Kind>
Kind& kind_of(scene::Scene& scene, std::size_t load) {
  if (load >= scene.loads.size())
    throw scene::SceneError(name_of(load) + ": there are " + std::to_string(scene.loads.size()) + " loads");
  const char* const wanted = scene::kind_name(Kind{});
  if (std::string_view(scene::kind_name(scene.loads[load])) != wanted)
    throw scene::SceneError(name_of(load) + ".kind = " + scene::kind_name(scene.loads[load]) + ": must be " + wanted);
  return std::get<Kind>(scene.loads[load]);
}

bool is_a_moment(const scene::Load& load) {
  return std::string_view(scene::kind_name(load)) == scene::kind_name(scene::Moment{});
}

template <class Kind, class Value>
void set_value(scene::Scene& scene, std::size_t load, Value Kind::*field, const Value& value, bool is_good) {
  Kind& kind = kind_of<Kind>(scene, load);
  if (!is_good) refuse(scene, [&](scene::Scene& copy) { kind_of<Kind>(copy, load).*field = value; });
  kind.*field = value;
}

}  // namespace

struct Solver::Impl {
  scene::Scene scene;
  Options options;
  int reserved_arcs = 0;
  std::array<Attempt, 2> attempts;
  Attempt* solved = nullptr;  // the solution found last
  Solution solution;          // of it
  scene::Pose tip = no_pose;
  std::array<Run, 2> spare;
  std::vector<int> arcs;
  scene::CellShares shares;
  struct {
    bool known = false;
    std::vector<double> s_mm;
    std::vector<scene::Pose> poses;
    std::vector<scene::Wrench> wrenches_B;
  } ends;  // of the arcs
  Response response;
  struct {
    bool known = false;
    std::vector<SectionPose> poses;
    std::vector<SectionWrench> distal_wrenches_S;
  } solved_states;  // that the response is asked about
  std::optional<double> error_mm;
  std::optional<std::optional<bool>> stable;

  Impl(const scene::Scene& scene, const Options& options);
  void reserve();
  Attempt& next() { return attempts[solved == &attempts[0] ? 1 : 0]; }
  Outcome solve(Start start);
  Status solve_with_arcs(Attempt& attempt, bool on);
  void choose_arcs(const Problem& problem);
  void refine(Attempt& attempt);
  void accept(Attempt& attempt);
  void place_ends();
  Response* prepared_response();
  double estimate_mm();
  bool is_on_rod(double s_mm) const { return solved && s_mm >= 0 && s_mm <= solved->problem.length_mm(); }
};

// What a load's arm, place and number of tendons may come to: spans end wherever a load begins or ends, now or before.
Solver::Impl::Impl(const scene::Scene& wanted, const Options& wanted_options) : scene(wanted), options(wanted_options) {
  attempts[0].problem.set(scene, options);
}

void Solver::Impl::reserve() {
  Room room{static_cast<std::size_t>(options.reserved_arcs), scene.sections.size(), 0};
  for (const scene::Load& load : scene.loads) {
    room.spans += 2;
    if (scene::tendon_of(load)) ++room.tendons;
  }
  room.arcs = std::max(room.arcs, 2 * room.spans);
  reserved_arcs = std::max(static_cast<int>(room.arcs), 2 * std::min(options.arcs, max_arcs));
  const Law law = attempts[0].problem.choice().law;
  for (Attempt& attempt : attempts) {
    attempt.problem.reserve(scene, room);
    attempt.problem.set(scene, options);
    attempt.run.reserve(room, law);
  }
  for (Run& run : spare) run.reserve(room, law);
  solution.reserve(room);
  response.reserve(room.arcs, room.spans, room.tendons);
  solved_states.poses.reserve(room.arcs + 1);
  solved_states.distal_wrenches_S.reserve(room.arcs);
  arcs.reserve(room.spans);
  shares.share.reserve(room.spans);
  shares.order.reserve(room.spans);
  ends.s_mm.reserve(room.arcs + 1);
  ends.poses.reserve(room.arcs + 1);
  ends.wrenches_B.reserve(room.arcs + 1);
  if (options.arcs <= options.reserved_arcs) return;  // else what they take now
  choose_arcs(attempts[0].problem);
  for (Attempt& attempt : attempts) attempt.run.set(attempt.problem, arcs);
}

void Solver::Impl::choose_arcs(const Problem& problem) {
  if (options.arcs > 0) {
    scene::share_cells(problem.spans(), options.arcs, arcs, shares);
    return;
  }
  set_first_arcs(problem.way().bounds, problem.choice().plane.has_value(), arcs,
                 arcs_factor(problem.choice().law, problem.tolerance_mm() / problem.length_mm()));
}

Status Solver::Impl::solve_with_arcs(Attempt& attempt, bool on) {
  Run& run = attempt.run;
  run.set(attempt.problem, arcs);
  if (!on) {
    run.status = run.engine.run();
  } else {
    std::size_t span = 0;
    int first_arc = 0;
    run.status = run.engine.run_on([&](int arc) {
      while (arc >= first_arc + arcs[span]) first_arc += arcs[span++];
      const scene::Span& before = attempt.problem.spans_before()[span];
      const bool at_end = arc + 1 == first_arc + arcs[span];
      const double s_mm =
          at_end ? before.end_mm : before.start_mm + (arc + 1 - first_arc) * (before.length_mm() / arcs[span]);
      const SectionState<3> state = solution.state(solution.place_at(s_mm));
      return at_end ? before_point_loads(state, before) : state;
    });
  }
  if (run.converged()) run.status = verdict(run.engine, attempt.problem.choice().law, run.extent(attempt.problem));
  return run.status;
}

// Where the arcs are too long, or a load is not reached with them, twice as many are tried, until two fail at the same
// load.
Solver::Outcome Solver::Impl::solve(Start start) {
  Attempt& attempt = next();
  const bool on = start == Start::last_solution && solved;
  if (on) attempt.problem.set(scene, options, solved->problem);
  else attempt.problem.set(scene, options);
  choose_arcs(attempt.problem);
  const Engine& engine = attempt.run.engine;
  Status last = Status::tolerance_not_met;
  double last_load = -1;
  for (;; last_load = engine.load_factor()) {
    if (std::accumulate(arcs.begin(), arcs.end(), 0LL) > reserved_arcs) return {last, 0, 0, message_of(last)};
    last = solve_with_arcs(attempt, on);
    if (last == Status::converged) break;
    const bool reached_the_same = std::abs(engine.load_factor() - last_load) <= same_load * last_load;
    if (options.arcs > 0 || (!engine.is_march() && reached_the_same))
      return {last, engine.load_steps(), engine.newton_steps(), message_of(last)};
    for (int& count : arcs) count *= 2;
  }
  if (options.arcs == 0) refine(attempt);
  accept(attempt);
  return {last, engine.load_steps(), engine.newton_steps(), message_of(last)};
}

// The solved arcs turn and swing as far as the a priori bounds allow arcs to turn at most, or there are more of them.
void Solver::Impl::refine(Attempt& attempt) {
  const Problem& problem = attempt.problem;
  const double allowed_rad =
      first_turn_rad / arcs_factor(problem.choice().law, problem.tolerance_mm() / problem.length_mm());
  const double times = std::ceil(attempt.run.extent(problem).swing_rad / allowed_rad);
  if (!(times > 1) || !(times * attempt.run.arc_count() <= reserved_arcs)) return;
  spare[0].solve(problem, attempt.run.arcs, static_cast<int>(times), &attempt.run);
  if (spare[0].converged()) std::swap(attempt.run, spare[0]);
}

void Solver::Impl::accept(Attempt& attempt) {
  solved = &attempt;
  solution.set(attempt.problem, attempt.run);
  tip = solution.pose({solution.arc_count() - 1, 1});
  ends.known = false;
  solved_states.known = false;
  error_mm.reset();
  stable.reset();
}

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

// Null: no solution, or of a law without slopes.
Response* Solver::Impl::prepared_response() {
  if (!solved || !facts_of(solved->problem.choice().law).coupled) return nullptr;
  if (solved_states.known) return &response;
  auto& [known, poses, wrenches] = solved_states;
  poses.assign(1, SectionPose{});
  wrenches.clear();
  for (int arc = 0; arc < solution.arc_count(); ++arc) {
    const scene::Pose pose = solution.pose({arc, 1});
    poses.push_back({pose.rotation_BS, pose.position_B_mm});
    wrenches.push_back(solution.state({arc, 1}).wrench);
  }
  const Problem& problem = solved->problem;
  response.set({&problem.scene(), problem.scene_spans(), solved->run.arcs, poses, wrenches, problem.choice().law,
                problem.choice().rod.model});
  known = true;
  return &response;
}

// As solve() estimates: with a fixed number of arcs by the law's order, else with the first run's safety.
double Solver::Impl::estimate_mm() {
  if (solved->run.arc_count() > reserved_arcs / 2) return std::numeric_limits<double>::infinity();
  const double by_doubling_mm = estimate_by_doubling_mm(solved->problem, solved->run, spare[0]);
  return options.arcs > 0 ? by_doubling_mm : coarse_safety * by_doubling_mm;
}

Solver::Solver(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;
Solver::~Solver() = default;

std::variant<Solver, Refusal> Solver::make(const scene::Scene& scene, const Options& options) {
  scene::validate(scene);
  auto impl = std::make_unique<Impl>(scene, options);
  std::string why_not = refusal(impl->attempts[0].problem);
  if (!why_not.empty()) return Refusal{Status::unsupported, std::move(why_not)};
  impl->reserve();
  return Solver(std::move(impl));
}

const scene::Scene& Solver::scene() const {
  return impl_->scene;
}

void Solver::set_force_N(std::size_t load, const Vector3d& force_N) {
  set_value(impl_->scene, load, &scene::Force::value_N, force_N, force_N.allFinite());
}
void Solver::set_moment_Nmm(std::size_t load, const Vector3d& moment_Nmm) {
  set_value(impl_->scene, load, &scene::Moment::value_Nmm, moment_Nmm, moment_Nmm.allFinite());
}
void Solver::set_distributed_N_per_mm(std::size_t load, const Vector3d& force_N_per_mm) {
  set_value(impl_->scene, load, &scene::DistributedForce::value_N_per_mm, force_N_per_mm, force_N_per_mm.allFinite());
}
void Solver::set_acceleration_m_per_s2(std::size_t load, const Vector3d& acceleration_m_per_s2) {
  set_value(impl_->scene, load, &scene::Gravity::acceleration_m_per_s2, acceleration_m_per_s2,
            acceleration_m_per_s2.allFinite());
}
void Solver::set_tension_N(std::size_t load, double tension_N) {
  set_value(impl_->scene, load, &scene::Tendon::tension_N, tension_N, std::isfinite(tension_N) && tension_N >= 0);
}
void Solver::set_at_mm(std::size_t load, double s_mm) {
  const double length_mm = scene::length_mm(impl_->scene), hair_mm = length_mm * scene::same_place_relative;
  const bool is_good = s_mm > hair_mm && s_mm <= length_mm + hair_mm;
  const bool is_moment = load < impl_->scene.loads.size() && is_a_moment(impl_->scene.loads[load]);
  if (is_moment) set_value(impl_->scene, load, &scene::Moment::at_mm, s_mm, is_good);
  else set_value(impl_->scene, load, &scene::Force::at_mm, s_mm, is_good);
}
void Solver::set_rest_curvature_per_mm(std::size_t section, const Vector3d& rest_curvature_per_mm) {
  std::vector<scene::Section>& sections = impl_->scene.sections;
  if (section >= sections.size())
    throw scene::SceneError("scene: rod.sections[" + std::to_string(section) + "]: there are " +
                            std::to_string(sections.size()) + " sections");
  if (!rest_curvature_per_mm.allFinite())
    refuse(impl_->scene,
           [&](scene::Scene& copy) { copy.sections[section].rest_curvature_per_mm = rest_curvature_per_mm; });
  sections[section].rest_curvature_per_mm = rest_curvature_per_mm;
}

Solver::Outcome Solver::solve(Start start) noexcept {
  return impl_->solve(start);
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
  if (!impl_->stable) impl_->stable = is_stable(problem, run, impl_->spare[0], impl_->spare[1], impl_->reserved_arcs);
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
