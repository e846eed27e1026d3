#include "fam/solver_impl.h"

#include "scene/load_visitor.h"
#include "scene/span_facts.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace fam {
namespace {

using scene::Status;

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

// In the units of its derivatives (Response::by_load).
Vector3d value_of(const scene::Load& load) {
  return scene::visit_load(
      load, [](const scene::Force& force) { return force.value_N; },
      [](const scene::Moment& moment) { return moment.value_Nmm; },
      [](const scene::DistributedForce& force) { return force.value_N_per_mm; },
      [](const scene::Gravity& gravity) { return gravity.acceleration_m_per_s2; },
      [](const scene::Tendon& tendon) { return Vector3d(tendon.tension_N, 0, 0); });
}

}  // namespace

// What a load's arm, place and number of tendons may come to: spans end wherever a load begins or ends, now or before.
Solver::Impl::Impl(const scene::Scene& wanted, const Options& wanted_options)
    : scene(wanted), options(wanted_options), model_asked_for(wanted_options.model) {
  choose_model();
  attempts[0].problem.set(scene, options);
}

// Shear and stretch are not left out where derivatives tell them: under no load they move no tip, and yet give way.
void Solver::Impl::choose_model() {
  const double length_mm = scene::length_mm(scene);
  options.model = model_asked_for;
  if (model_asked_for != RodModel::automatic || !facts_of(chosen(options.law)).coupled) return;
  if (compliance_left_out(scene) > left_out_share * tolerance_mm(options, length_mm) / length_mm)
    options.model = RodModel::reissner;
}

void Solver::Impl::reserve() {
  const int asked_for = 2 * options.arcs;  // the estimate's finer run included
  most_arcs = std::max(most_unreserved_arcs, asked_for);
  if (options.reserved_arcs == 0) return;
  Room room{static_cast<std::size_t>(options.reserved_arcs), scene.sections.size(), 0};
  for (const scene::Load& load : scene.loads) {
    room.spans += 2;
    if (scene::tendon_of(load)) ++room.tendons;
  }
  room.arcs = std::max(room.arcs, 2 * room.spans);
  most_arcs = std::max(static_cast<int>(room.arcs), asked_for);
  const Law law = attempts[0].problem.choice().law;
  for (Attempt& attempt : attempts) {
    attempt.problem.reserve(scene, room);
    attempt.problem.set(scene, options);
    attempt.run.reserve(room, law);
  }
  for (Run& run : spare) run.reserve(room, law);
  solution.reserve(room);
  finer.reserve(room);
  solved_states.arcs.reserve(room.spans);
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
  // An arc stretched v times bends by sqrt(v F / EI) h.
  const bool stretches = problem.choice().rod.model == RodModel::reissner;
  const double stretch = stretches ? 1 + linear_strain_bound(problem.way().bounds) : 1;
  const double factor = arcs_factor(problem.choice().law, problem.tolerance_mm() / problem.length_mm());
  set_first_arcs(problem.way().bounds, problem.choice().plane.has_value(), arcs, std::sqrt(stretch) * factor);
}

// By how much, to first order, loads have turned the tip since the last solution, where its derivatives are at hand.
Vector3d Solver::Impl::expected_tip_turn_B() {
  Vector3d turn_B = Vector3d::Zero();
  if (!solved_states.known || solved_states.arcs.empty()) return turn_B;
  const scene::Scene& before = solved->problem.scene();
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const Vector3d change = value_of(scene.loads[i]) - value_of(before.loads[i]);
    if (change.isZero(0)) continue;
    turn_B += response.by_load(i, solved->problem.length_mm(), Response::What::pose).bottomRows<3>() * change;
  }
  return turn_B;
}

Status Solver::Impl::solve_with_arcs(Attempt& attempt, bool on, int newton_steps_at_most) {
  Run& run = attempt.run;
  run.set(attempt.problem, arcs);
  run.engine.limit_newton_steps(newton_steps_at_most);
  if (!on) {
    run.status = run.engine.run();
  } else {
    std::size_t span = 0;
    int first_arc = 0;
    const bool turns_at_once = !run.engine.is_march() && run.engine.has_one_solution();
    const Vector3d tip_turn_B = turns_at_once ? expected_tip_turn_B() : Vector3d(Vector3d::Zero());
    run.status = run.engine.run_on(&solved->run.engine, tip_turn_B, [&](int arc) {
      while (arc >= first_arc + arcs[span]) first_arc += arcs[span++];
      const scene::Span& before = attempt.problem.spans_before()[span];
      const bool at_end = arc + 1 == first_arc + arcs[span];
      const double s_mm =
          at_end ? before.end_mm : before.start_mm + (arc + 1 - first_arc) * (before.length_mm() / arcs[span]);
      const SectionState<3> state = solution.state(solution.place_at(s_mm));
      return at_end ? before_point_loads(state, before) : state;
    });
  }
  if (!run.converged()) return run.status;
  extent = run.extent(attempt.problem);
  return run.status = verdict(run.engine, attempt.problem.choice().law, extent);
}

// Where the arcs are too long or lead elsewhere than more of them, or a load is not reached with them, twice as many
// are tried, until two fail at the same load or the Newton steps are used up.
Solver::Outcome Solver::Impl::solve(Start start, int newton_steps_at_most) {
  Attempt& attempt = next();
  has_previous = false;
  bool on = start == Start::last_solution && solved;
  if (on) {
    attempt.problem.set(scene, options, solved->problem);
    on = !scene::moments_are_known(attempt.problem.way().to);  // one equilibrium, which is solved for at once
  }
  if (!on) attempt.problem.set(scene, options);
  choose_arcs(attempt.problem);
  const Engine& engine = attempt.run.engine;
  Status last = Status::tolerance_not_met;
  double last_load = -1;
  int steps_left = newton_steps_at_most;
  for (;; last_load = engine.load_factor()) {
    if (std::accumulate(arcs.begin(), arcs.end(), 0LL) > most_arcs) return {last, 0, 0, message_of(last)};
    last = solve_with_arcs(attempt, on, steps_left);
    const bool used_up = engine.newton_steps() > steps_left;
    steps_left -= engine.newton_steps();
    if (last == Status::converged && options.arcs == 0) last = refine(attempt);
    if (last == Status::converged || last == Status::tolerance_not_met) break;
    const double load = engine.load_factor();  // 0 or 1: not the load is at fault, but the arcs are too long
    const bool stopped_again =
        !engine.is_march() && load > 0 && load < 1 && std::abs(load - last_load) <= same_load * last_load;
    if (options.arcs > 0 || stopped_again || used_up)
      return {last, engine.load_steps(), engine.newton_steps(), message_of(last)};
    for (int& count : arcs) count *= 2;
    if (last == Status::arc_not_converged) last = Status::tolerance_not_met;  // if these are more than are reserved
  }
  if (last == Status::converged) accept(attempt);
  return {last, engine.load_steps(), engine.newton_steps(), message_of(last)};
}

// The solved arcs turn and swing as far as the a priori bounds allow arcs to turn at most, or there are more of them.
// arc_not_converged: more of them do not lead to the same shape.
Status Solver::Impl::refine(Attempt& attempt) {
  const Problem& problem = attempt.problem;
  const double allowed_rad = allowed_swing_rad(problem.choice().law, problem.tolerance_mm() / problem.length_mm());
  const double times = std::ceil(extent.swing_rad / allowed_rad);
  if (!(times > 1)) return Status::converged;
  if (!(times * attempt.run.arc_count() <= most_arcs)) return Status::tolerance_not_met;
  spare[0].solve(problem, attempt.run.arcs, static_cast<int>(times), &attempt.run);
  if (!spare[0].converged()) return Status::arc_not_converged;
  std::swap(attempt.run, spare[0]);
  return Status::converged;
}

void Solver::Impl::accept(Attempt& attempt) {
  has_previous = solved;
  solved = &attempt;
  solution.set(attempt.problem, attempt.run);
  tip = solution.pose({solution.arc_count() - 1, 1});
  ends.known = false;
  solved_states.known = false;
  error_mm.reset();
  stable.reset();
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

Solver::Outcome Solver::solve(Start start, int newton_steps_at_most) noexcept {
  return impl_->solve(start, newton_steps_at_most);
}

bool Solver::go_back() noexcept {
  if (impl_->has_previous) impl_->accept(impl_->next());
  return impl_->has_previous;
}

}  // namespace fam
