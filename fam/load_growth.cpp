// How a boundary value problem's load grows from zero, and which steps keep to the branch.
#include "fam/boundary_value.h"
#include "fam/rotation.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace fam {

// Where the last two loads point: rotations along their relative turn, wrenches along their difference.
template <int D>
std::vector<typename BasicBoundaryValue<D>::template State<double>> BasicBoundaryValue<D>::predict(
    double factor) const {
  std::vector<State<double>> guess = nodes_;
  if (load_steps_ == 0) return guess;
  const double ahead = (factor - factor_) / (factor_ - previous_factor_);
  for (std::size_t k = 0; k < guess.size(); ++k) {
    // R_B,new = R_B,now exp(turn): base axes in the section turn back.
    const Turn<double, D> turn =
        rotation_vector(Rotation(previous_[k].rotation_SB * nodes_[k].rotation_SB.transpose()));
    guess[k].rotation_SB = turned(nodes_[k].rotation_SB, Turn<double, D>(ahead * turn));
    guess[k].wrench.force_N += ahead * (nodes_[k].wrench.force_N - previous_[k].wrench.force_N);
    guess[k].wrench.moment_Nmm += ahead * (nodes_[k].wrench.moment_Nmm - previous_[k].wrench.moment_Nmm);
  }
  return guess;
}

// Not on to where the determinant vanishes by the line through the last two.
template <int D>
double BasicBoundaryValue<D>::longest_step(const BranchWatch& watch) const {
  if (!watch.determinant || watch.before.factor == watch.last.factor) return 1;
  const double fall =
      std::expm1(watch.before.log_size - watch.last.log_size) / (watch.last.factor - watch.before.factor);
  return fall > 0 ? 0.8 / fall : 1;
}

// One load step, taken or undone. Returns the surprise, the largest rotation that was not predicted, in units of what
// is allowed; empty if refused.
template <int D>
std::optional<double> BasicBoundaryValue<D>::try_step(double to, BranchWatch& watch) {
  const double from = factor_;
  const std::vector<State<double>> start = nodes_;
  const std::vector<State<double>> guess = predict(to);
  nodes_ = guess;
  set_load(to);
  bool accepted = newton(to < 1 ? std::max(newton_tolerance_, load_step_tolerance) : newton_tolerance_);
  double turn = 0;
  double surprise = 0;
  for (std::size_t k = 0; accepted && k < nodes_.size(); ++k) {
    turn = std::max(turn, rotation_vector(Rotation(nodes_[k].rotation_SB * start[k].rotation_SB.transpose())).norm());
    surprise =
        std::max(surprise, rotation_vector(Rotation(nodes_[k].rotation_SB * guess[k].rotation_SB.transpose())).norm());
  }
  surprise /= load_steps_ == 0 ? largest_turn_rad / 2 : largest_surprise_rad;
  accepted = accepted && turn <= largest_turn_rad && surprise <= 1;
  if (accepted && stays_on_branch(to - from, watch)) {
    previous_ = start;
    previous_factor_ = from;
    ++load_steps_;
    return surprise;
  }
  nodes_ = start;
  set_load(from);
  return std::nullopt;
}

// Judges the solution that a step of this length has led to, and remembers it if it is on the branch.
template <int D>
bool BasicBoundaryValue<D>::stays_on_branch(double step, BranchWatch& watch) {
  Orientation now = orientation(false);
  // Secants mend the derivatives of one segment well enough as long as the determinant does not fall.
  const double size = (now.negative == watch.last.negative ? 1 : -1) * std::exp(now.log_size - watch.last.log_size);
  if (!(size > 0.8)) now = orientation(true);
  if (watch.determinant && now.negative != watch.last.negative) return false;
  const bool falls = watch.stability && stability().conjugate_points > 0;
  if (falls && !(watch.may_fall && step <= smallest_bifurcation_step)) return false;
  watch.stability = watch.stability && !falls;
  watch.before = watch.last;
  watch.last = now;
  return true;
}

// Whether load steps this short, or the work done, are the end of it; failure_ and message_ say so.
template <int D>
bool BasicBoundaryValue<D>::gives_up(double step) {
  const long long marched = static_cast<long long>(newton_steps_) * arc_count();
  const bool exhausted =
      newton_steps_ > most_newton_steps ||
      marched > std::max<long long>(most_arcs_marched, static_cast<long long>(growth_passes) * arc_count());
  const double smallest = smallest_load_step * std::max(factor_, first_step_);
  if (!exhausted && step >= smallest) return false;
  failure_ = tendon_collapsed_ ? scene::Status::tendon_collapsed
             : exhausted       ? scene::Status::work_limit
                               : scene::Status::load_step_too_small;
  std::ostringstream text;
  if (exhausted) text << "work limit: " << newton_steps_ << " Newton steps and only ";
  else text << "the load step fell below " << smallest << " at ";
  text << 100 * factor_ << " % of the load" << (exhausted ? " reached" : "");
  message_ = text.str();
  return true;
}

template <int D>
bool BasicBoundaryValue<D>::grow_load() {
  if (one_equilibrium() && solve_at_once()) return true;
  start_unloaded();
  load_steps_ = 0;
  if (!newton(newton_tolerance_)) {
    failure_ = scene::Status::not_converged;
    message_ = "Newton did not converge at no load";
    return false;
  }
  const scene::Symmetry symmetry = scene::symmetry_of(spans_);
  BranchWatch watch{symmetry != scene::Symmetry::axis,
                    scene::is_conservative(spans_),
                    symmetry != scene::Symmetry::none,
                    orientation(false),
                    {}};
  watch.before = watch.last;
  first_step_ = 1 / std::max(1.0, total_growth_ * total_growth_ + total_turn_rad_);
  double step = first_step_;
  while (factor_ < 1) {
    step = std::min(step, longest_step(watch));
    if (gives_up(step)) return false;
    const double from = factor_;
    const double to = 1 - from <= 1.001 * step ? 1 : from + step;
    if (const std::optional<double> surprise = try_step(to, watch)) {
      step *= *surprise < 0.25 ? 2 : 1.2;
    } else {
      step = (to - from) / 2;
    }
  }
  return true;
}

template bool BasicBoundaryValue<2>::grow_load();
template bool BasicBoundaryValue<3>::grow_load();

}  // namespace fam
