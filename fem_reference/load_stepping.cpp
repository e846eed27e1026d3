#include "fem_reference/load_stepping.h"

#include "fem_reference/state_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace fem_reference {

namespace {

enum class Outcome {
  converged,
  turned_too_far,
  surprised,
  lost_stability,
  left_branch,
  stalled,
  singular,
  tendon_collapsed,
  not_finite
};

const char* reason(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged: return "converged";
    case Outcome::turned_too_far: return "a node turns too far in one step";
    case Outcome::surprised: return "a node turns far from where the last step pointed";
    case Outcome::lost_stability: return "the equilibrium is unstable";
    case Outcome::left_branch: return "the tangent's determinant belongs to another branch";
    case Outcome::stalled: return "Newton's iteration does not converge";
    case Outcome::singular: return "the tangent is singular";
    case Outcome::tendon_collapsed: return "a tendon's path has no length somewhere, |v + u x r| -> 0";
    case Outcome::not_finite: return "a value is not finite";
  }
  return "";
}

struct Attempt {
  Outcome outcome = Outcome::stalled;
  int iterations = 0;
  double rotation_rad = 0;  // largest of any node since the start of the step
  double surprise_rad = 0;  // and since the predictor
  Residual residual;
};

// Newton's iteration at one load factor; `state` holds the predictor and then the result, whose tangent is assembled if
// it is judged.
Attempt iterate(BeamSystem& system, const BeamState& start, BeamState& state, double load_factor, bool is_judged,
                const SteppingOptions& options) {
  Attempt attempt;
  BeamIncrement increment;
  // Not of the forces: where the rod hardly stretches or shears they follow from the strains with little accuracy, and
  // the residual bounds them.
  double last_increment = 0, to_come = INFINITY;
  while (true) {
    const bool without_tangent = !is_judged && to_come <= options.tolerance;
    attempt.residual = without_tangent ? system.residual(state, load_factor) : system.assemble(state, load_factor);
    attempt.rotation_rad = largest_rotation(start, state);
    if (!attempt.residual.finite() || !all_finite(state)) {
      attempt.outcome = Outcome::not_finite;
      return attempt;
    }
    const bool converged = is_converged(to_come, attempt.residual, largest_entry(state.force_S), options.tolerance);
    // Before convergence the bound is wider: an iterate may overshoot and come back.
    if (attempt.rotation_rad > (converged ? 1.0 : 1.5) * options.largest_rotation_rad) {
      attempt.outcome = Outcome::turned_too_far;
      return attempt;
    }
    if (converged || attempt.iterations == options.max_newton_iterations) {
      attempt.outcome = converged ? Outcome::converged : Outcome::stalled;
      return attempt;
    }
    if (without_tangent) system.assemble(state, load_factor);
    if (!system.newton_increment(increment)) {
      attempt.outcome = Outcome::singular;
      return attempt;
    }
    ++attempt.iterations;
    advance(state, increment);
    const double this_increment =
        std::max(largest_entry(increment.displacement_B), largest_entry(increment.rotation_S));
    to_come = next_increment(last_increment, this_increment);
    last_increment = this_increment;
  }
}

// Where a step lands on a branch beside the one it began on, the surprise is as large as the whole motion.
double largest_surprise_rad(const Attempt& attempt, const SteppingOptions& options) {
  constexpr double round_off = 1e-8;
  return std::min(std::max(0.5 * attempt.rotation_rad, round_off), options.largest_rotation_rad / 12);
}

// The next step is to turn the rod a little less than is allowed, and is at most twice the last.
double grown(double step, const Attempt& attempt, const SteppingOptions& options) {
  const double to_limit = 0.8 * options.largest_rotation_rad / std::max(attempt.rotation_rad, 1e-12);
  // The surprise grows like the square of the step.
  const double to_surprise =
      std::sqrt(0.5 * largest_surprise_rad(attempt, options) / std::max(attempt.surprise_rad, 1e-12));
  return step * std::clamp(std::min(to_limit, to_surprise), 0.5, 2.0);
}

double shrunk(double step, const Attempt& attempt, const SteppingOptions& options) {
  if (attempt.outcome != Outcome::turned_too_far) return 0.5 * step;
  return step * std::clamp(0.8 * options.largest_rotation_rad / attempt.rotation_rad, 0.1, 0.5);
}

// Of a scene whose last load step, too small to go on, ended so.
scene::Status status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::not_finite: return scene::Status::not_finite;
    case Outcome::tendon_collapsed: return scene::Status::tendon_collapsed;
    default: return scene::Status::load_step_too_small;
  }
}

std::string failure_message(double load_factor, double step, const Attempt& attempt) {
  char text[250];
  std::snprintf(text, sizeof text,
                "load factor %.6g of 1 reached; a further step of %.2g fails after %d iterations: %s", load_factor,
                step, attempt.iterations, reason(attempt.outcome));
  return text;
}

// Sum of all loads but the tendons', times the largest compliance.
double load_size(const BeamModel& model) {
  double size = 0, compliance = 0;
  for (const NodalLoad& load : model.loads) {
    for (const scene::Wrench* wrench : {&load.follower_S, &load.fixed_B}) {
      size += wrench->force_N.norm() + wrench->moment_Nmm.norm();
    }
    size += load.fixed_force_arms_BS.norm();
  }
  for (const ElementData& element : model.elements) {
    size += element.length * (element.follower_force_S.norm() + element.fixed_force_B.norm());
    compliance = std::max(compliance, 1 / element.moment_stiffness.minCoeff());
  }
  return size * compliance;
}

class Stepping {
 public:
  Stepping(const BeamModel& model, const SteppingOptions& options)
      : model_(model),
        options_(options),
        watches_determinant_(!model.all_loads_follow && model.symmetry != scene::Symmetry::axis),
        system_(model),
        state_(rest_state(model)),
        step_(options.initial_load_step) {
    for (const ElementData& element : model.elements) curved_ = curved_ || !element.rest_curvature.isZero(0);
  }

  SteppingResult run() {
    if (tendon_collapses(model_, state_, state_)) {
      last_.outcome = Outcome::tendon_collapsed;
      return failed(scene::Status::tendon_collapsed, 0);
    }
    // The interpolation of a curved rest shape is not exactly stress-free.
    if (curved_ && !try_step(0)) return failed(scene::Status::not_converged, 0);
    if (watches_determinant_) start_watch();
    while (load_factor_ < 1) {
      if (tried_ == options_.max_load_steps) return failed(scene::Status::work_limit, step_);
      step_ = std::min(step_, branch_.longest_step(load_factor_));
      if (step_ < options_.smallest_load_step) {
        last_.outcome = Outcome::left_branch;
        return failed(scene::Status::load_step_too_small, step_);
      }
      // No sliver is left for a last step.
      const double target = load_factor_ + 1.001 * step_ >= 1 ? 1 : load_factor_ + step_;
      const double step = target - load_factor_;
      if (try_step(target)) {
        if (const auto element = turned_over(model_, state_)) return too_coarse(*element);
        step_ = grown(step, last_, options_);
        continue;
      }
      step_ = shrunk(step, last_, options_);
      if (step_ < options_.smallest_load_step) return failed(status_of(last_.outcome), step);
    }
    result_.status = scene::Status::converged;
    result_.state = std::move(state_);
    return std::move(result_);
  }

 private:
  bool try_step(double target) {
    ++tried_;
    BeamState trial = state_;
    const double step = target - load_factor_;
    // Secant predictor: the last accepted step goes on.
    if (last_step_ > 0) advance(trial, last_increment_, step / last_step_);
    const BeamState guess = trial;
    last_ = iterate(system_, state_, trial, target, watches_determinant_ || model_.conservative, options_);
    result_.newton_iterations += last_.iterations;
    if (tendon_collapses(model_, state_, trial)) last_.outcome = Outcome::tendon_collapsed;
    if (last_.outcome != Outcome::converged) return false;
    if (last_step_ > 0) last_.surprise_rad = largest_rotation(guess, trial);
    else if (step > 0 && last_.rotation_rad > 0.5 * options_.largest_rotation_rad) last_.surprise_rad = INFINITY;
    // The last step may point too much astray for any but a short one, after which the next has a better guess.
    const bool is_short = step < last_step_ / 16;
    if (last_.surprise_rad > (is_short ? options_.largest_rotation_rad / 12 : largest_surprise_rad(last_, options_))) {
      last_.outcome = Outcome::surprised;
      return false;
    }
    if (!stays_on_branch(target)) return false;
    if (step > 0) {
      ++result_.load_steps;
      last_increment_ = difference(state_, trial);
      last_step_ = step;
    }
    state_ = std::move(trial);
    load_factor_ = target;
    return true;
  }

  // The first step is below all that could buckle the rod, and has two determinants to go by: at no load and a little
  // above.
  void start_watch() {
    step_ = std::min(step_, 1 / std::max(load_size(model_), 1.0));
    for (const double load_factor : {0.0, 0.01 * step_}) {
      BeamState trial = state_;
      last_ = iterate(system_, state_, trial, load_factor, true, options_);
      const std::optional<scene::Determinant> determinant = system_.determinant();
      if (last_.outcome == Outcome::converged && determinant) branch_.keep(load_factor, *determinant);
    }
  }

  // Judges the equilibrium assembled last, and remembers it if it is on the branch.
  bool stays_on_branch(double load_factor) {
    const std::optional<scene::Determinant> determinant =
        watches_determinant_ ? system_.determinant() : std::optional<scene::Determinant>(scene::Determinant{});
    if (!determinant || branch_.has_left(*determinant)) {
      last_.outcome = determinant ? Outcome::left_branch : Outcome::singular;
      return false;
    }
    const std::optional<bool> stable = model_.conservative ? system_.is_stable() : std::nullopt;
    const bool may_fall =
        model_.symmetry != scene::Symmetry::none && load_factor - load_factor_ <= options_.smallest_bifurcation_step;
    if (stable == false && result_.stable != false && !may_fall) {
      last_.outcome = Outcome::lost_stability;
      return false;
    }
    result_.stable = stable;
    branch_.keep(load_factor, *determinant);
    return true;
  }

  SteppingResult failed(scene::Status status, double step) {
    result_.status = status;
    result_.message = failure_message(load_factor_, step, last_);
    return std::move(result_);
  }

  SteppingResult too_coarse(std::size_t element) {
    result_.status = scene::Status::not_converged;
    result_.message = "load factor " + std::to_string(load_factor_) + " of 1 reached: element " +
                      std::to_string(element) + " turns by pi or more: the mesh is too coarse";
    return std::move(result_);
  }

  const BeamModel& model_;
  const SteppingOptions& options_;
  const bool watches_determinant_;
  BeamSystem system_;
  BeamState state_;
  bool curved_ = false;
  double load_factor_ = 0;
  double step_;
  int tried_ = 0;
  Attempt last_;
  BeamIncrement last_increment_;
  double last_step_ = 0;
  scene::BranchWatch branch_;
  SteppingResult result_;
};

}  // namespace

SteppingOptions stepping_options(const Options& options) {
  return {.initial_load_step = options.initial_load_step,
          .smallest_load_step = options.smallest_load_step,
          .max_load_steps = options.max_load_steps,
          .max_newton_iterations = options.max_newton_iterations,
          .largest_rotation_rad = options.largest_rotation_rad,
          .tolerance = options.tolerance};
}

double next_increment(double last, double now) {
  return now < last ? now * (now / last) : now;
}

bool is_converged(double largest_increment, const Residual& residual, double largest_force, double tolerance) {
  return largest_increment <= tolerance && residual.largest() <= tolerance * std::max(1.0, largest_force);
}

SteppingResult step_to_full_load(const BeamModel& model, const SteppingOptions& options) {
  return Stepping(model, options).run();
}

}  // namespace fem_reference
