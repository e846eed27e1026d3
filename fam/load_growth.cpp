#include "fam/load_growth.h"

#include "fam/load_length.h"
#include "fam/rotation.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace fam {
namespace {

// Of a segment end in a step; the turn is chosen, not measured. With surprises of 0.05 rad none of 20 000 strips and
// heavy rods is led astray, with 0.07 one strip to its mirrored branch, with 0.1 two. Where no critical point is near
// larger ones do: of 45 000 random scenes none ends elsewhere with 0.2, nor with no limit but that of a Newton step.
// But of 596 rods under strong couples of fixed forces off the centreline 12 do so without one, with these 7.
constexpr double largest_turn_rad = 0.5, largest_smooth_turn_rad = 1;
constexpr double largest_surprise_rad = 0.05, largest_smooth_surprise_rad = 0.1;
// Of the largest turn of a step: the surprise, or else the branch is another one. A strip pushed aside by 1e-5 of its
// load was led to the side that it does not buckle to in steps of 0.77 and 0.99; with 0.8 it still is, with 0.6 and 0.4
// not. With 0.3 5 of those 596 rods end elsewhere, but rods of survivors_branch_test.cpp take more load steps than they
// may. Below the least it is Newton's.
constexpr double most_unled_share = 0.6, least_unled_rad = 1e-4;
// Of the surprise allowed: a Newton step beyond ends the attempt. With 1 a rod of survivors_branch_test.cpp takes three
// load steps more, since the steps after the first may turn back.
constexpr double hopeless_turns = 2;
// Of the bending in rad, times the share of what leaves one equilibrium: of 158 078 columns, strips, arches, rods under
// couples and random scenes drawn for it 17 496 end so beside their rest shape, and none elsewhere than grown loads
// lead, nor couples with 30, but one with 50. And of an arc's swing: more than pi hides conjugate points, with 3 none
// of 111 078 of those ends elsewhere, with 6 12 of 40 000 strips.
constexpr double most_bent_share = 8, most_swing_rad = 2.1;
// Of the tip under the moment that the march from the clamp misses there: of 270 random scenes beyond Newton leads
// nowhere in 234.
constexpr double most_guess_error_rad = 0.1;
constexpr double smallest_load_step = 1e-12;  // over the load reached: a column pushed aside by 1e-12 EI/L^2 needs it
constexpr double smallest_bifurcation_step = 1e-5;  // of the load; chosen, not measured
constexpr double load_step_tolerance = 1e-6;        // of Newton on the way to the full load, where the last is tighter
constexpr double limit_point_determinant = 1e-2;    // of that at the start of the way; chosen, not measured
constexpr double tangent_difference = 1e-3;         // of loads, over the step; chosen, not measured
// In the plane, of the largest turn of a step: what the mean of the tangents may miss of it. Of 1189 rods under strong
// couples 10 end elsewhere without a limit, with 0.2 two, with 0.1 none, nor of 2785 drawn afterwards, of which 25 do
// without. All of these are planar; with 1e-6 N across, and so in space, none ends elsewhere. In space 0.1 lets random
// scene 99989, a coil, end in work_limit. Below the least it is what load_step_tolerance makes of a tangent.
constexpr double most_missed_share = 0.1, least_missed_rad = load_step_tolerance / tangent_difference;
// Of the change of the loads that leads to where the determinant can vanish. Of 1078 strips, arches, couples, columns
// and rods of any kind, led from one set of loads to another in 60 or 300 steps, all end as with derivatives taken
// anew.
constexpr double most_stale_share = 0.1;
constexpr int most_passes = 100;  // of the rod's arcs, within the work limit; chosen, not measured

// The shape that the last march met, its arcs short enough to show conjugate points.
template <int D>
bool is_hardly_bent(const Shooting<D>& shooting) {
  if (!(shooting.bending_rad() * shooting.bounds().unique_share_in_space <= most_bent_share)) return false;
  const LoadedRod<D>& rod = shooting.rod();
  return largest_swing_in_space_rad(rod.way().to, rod.arcs_per_span(),
                                    std::span<const BasicArc<D>>(shooting.marched().arcs)) <= most_swing_rad;
}

// The size of the change of the loads that leads to where the determinant can vanish, for all that one load tells; a
// taut rod slackens first.
double size_to_zero(const scene::Determinant& start) {
  return std::min(1.0, std::exp(start.log_size)) * (1 + start.log_growth * start.log_growth / 4);
}

// R_B,b = R_B,a exp(turn): base axes in the section turn back.
template <int D>
Angular<double, D> turn_from(const SectionState<D>& a, const SectionState<D>& b) {
  return rotation_vector(Eigen::Matrix<double, D, D>(a.rotation_SB * b.rotation_SB.transpose()));
}

}  // namespace

template <int D>
void LoadGrowth<D>::set(const Shooting<D>& shooting) {
  for (Nodes* nodes : {&start_, &guess_, &previous_, &earlier_}) nodes->resize(shooting.nodes().size());
  for (Tangent* tangent : {&tangent_, &next_tangent_}) tangent->resize(shooting.nodes().size());
  is_paused_ = false;
  way_.watches_stability = scene::is_conservative(shooting.rod().way().bounds);
  if (!way_.watches_stability) return;
  judge_.reserve({shooting.nodes().size(), shooting.rod().way().to.size(), most_tendons(shooting.rod().way().to)});
  judge_.set(shooting.rod());
}

template <int D>
void LoadGrowth<D>::reserve(const Room& room) {
  for (Nodes* nodes : {&start_, &guess_, &previous_, &earlier_}) nodes->reserve(room.arcs);
  for (Tangent* tangent : {&tangent_, &next_tangent_}) tangent->reserve(room.arcs);
  judge_.reserve(room);
}

// In the plane where the tangent points, and then the parabola through the last load with it. In space where the
// start's tangent points, then the parabola with it, from there on that through the last three loads. Near a critical
// point the line through two loads.
template <int D>
typename LoadGrowth<D>::Shares LoadGrowth<D>::predicted_shares(double factor) const {
  const double ahead = factor - way_.load_factor;
  const double last = way_.load_factor - way_.previous_factor, two = way_.load_factor - way_.earlier_factor;
  if (way_.load_steps == 0) return {0, 0, ahead};
  if (way_.near_critical) return {ahead / last, 0, 0};
  if (D == 2) return {-(ahead / last) * (ahead / last), 0, ahead * (1 + ahead / last)};
  if (way_.load_steps == 1) return {(factor / last) * (factor / last) - 1, 0, -factor * ahead / last};
  return {ahead * (ahead + two) / (last * (two - last)), -ahead * (ahead + last) / (two * (two - last)), 0};
}

// Turns add up as vectors in the present sections' axes.
template <int D>
void LoadGrowth<D>::predict(const Shooting<D>& shooting, const Shares& shares) {
  const Nodes& now = shooting.nodes();
  guess_ = now;
  for (std::size_t k = 0; k < now.size(); ++k) {
    BasicWrench<double, D>& wrench = guess_[k].wrench;  // no structured binding: Clang 14's closures do not take one
    Angular<double, D> turn = shares.tangent * tangent_[k].turn;
    wrench = wrench + shares.tangent * BasicWrench<double, D>{tangent_[k].force_N, tangent_[k].moment_Nmm};
    const auto add_change = [&](const SectionState<D>& earlier, double times) {
      if (times == 0) return;
      turn += times * turn_from(earlier, now[k]);
      wrench = wrench + times * now[k].wrench + -times * earlier.wrench;
    };
    add_change(previous_[k], shares.previous);
    add_change(earlier_[k], shares.earlier);
    guess_[k].rotation_SB = turned(now[k].rotation_SB, turn);
  }
}

// On a branch the change over a step is its length times the mean of the tangents at its ends, but for the third power
// of its length (the trapezoidal rule); between two branches it is not.
template <int D>
bool LoadGrowth<D>::follows_tangents(Shooting<D>& shooting, double step, double turn_rad) {
  shooting.set_load_tangent(-tangent_difference * step, next_tangent_);
  const double limit_rad = std::max(most_missed_share * turn_rad, least_missed_rad);
  for (std::size_t k = 0; k < start_.size(); ++k) {
    const Angular<double, D> along = step / 2 * (tangent_[k].turn + next_tangent_[k].turn);
    if (!((turn_from(start_[k], shooting.nodes()[k]) - along).norm() <= limit_rad)) return false;
  }
  return true;
}

// One load step, taken or undone; empty if refused.
template <int D>
std::optional<typename LoadGrowth<D>::StepSize> LoadGrowth<D>::try_step(Shooting<D>& shooting, double to) {
  start_ = shooting.nodes();
  predict(shooting, predicted_shares(to));
  shooting.set_nodes(guess_);
  shooting.set_load(to);
  const double tolerance = shooting.newton_tolerance();
  const double hopeful_rad = way_.near_critical ? largest_surprise_rad : largest_smooth_surprise_rad;
  conjugate_points_ = 0;
  const OnTheWay way{way_.start, hopeless_turns * hopeful_rad, way_.near_critical,
                     way_.watches_stability ? &conjugate_points_ : nullptr};
  bool accepted = shooting.newton(to < 1 ? std::max(tolerance, load_step_tolerance) : tolerance, &way,
                                  std::exchange(way_.keeps_derivatives, false));
  double turn = 0, surprise = 0;
  for (std::size_t k = 0; accepted && k < start_.size(); ++k) {
    turn = std::max(turn, turn_from(start_[k], shooting.nodes()[k]).norm());
    surprise = std::max(surprise, turn_from(guess_[k], shooting.nodes()[k]).norm());
  }
  const bool smooth = !nears_critical(shooting.determinant());
  const double step = to - way_.load_factor, turn_rad = turn;
  const double unled = surprise / std::max(most_unled_share * turn, least_unled_rad);
  turn /= smooth ? largest_smooth_turn_rad : largest_turn_rad;
  surprise /= smooth ? largest_smooth_surprise_rad : largest_surprise_rad;
  accepted = accepted && unled <= 1 && turn <= 1 && surprise <= 1;
  // Beside a critical point the tangent changes too much for a mean.
  if (D == 2) accepted = accepted && (follows_tangents(shooting, step, turn_rad) || !smooth);
  is_paused_ = accepted && !(smooth && way_.was_smooth) && swings_too_far(shooting, turn_rad);
  accepted = accepted && !is_paused_;
  if (accepted && stays_on_branch(shooting, step)) {
    std::swap(earlier_, previous_);
    way_.earlier_factor = way_.previous_factor;
    previous_ = start_;
    way_.previous_factor = way_.load_factor;
    way_.load_factor = to;
    if (D == 2) std::swap(tangent_, next_tangent_);
    ++way_.load_steps;
    return StepSize{turn, surprise, unled};
  }
  shooting.set_nodes(start_);
  shooting.set_load(way_.load_factor);
  return std::nullopt;
}

// Judges the solution that a step of this length has led to, and remembers it if it is on the branch.
template <int D>
bool LoadGrowth<D>::stays_on_branch(Shooting<D>& shooting, double step) {
  scene::Determinant now = shooting.determinant();
  // The derivatives that Newton left do as long as the determinant does not fall. Beside a critical point those of the
  // way there would let it rise and fall by turns: 1.4 times the work over 20 scenes that buckle.
  const scene::Determinant& last = way_.branch.last();
  const double size = (now.negative == last.negative ? 1 : -1) * std::exp(now.log_size - last.log_size);
  if (way_.near_critical || !(size > 0.8)) now = shooting.exact_determinant();
  if (way_.watches_determinant && way_.branch.has_left(now)) return false;
  // Between determinants that have not fallen there is no conjugate point to be passed; in the plane it would be one of
  // motions out of it, which the determinant does not know.
  const bool near = D == 2 || !way_.watches_determinant || nears_critical(now) || conjugate_points_ > 0;
  const bool falls = way_.watches_stability && near && is_unstable(shooting);
  if (falls && !(way_.may_fall && step <= smallest_bifurcation_step)) return false;
  way_.watches_stability = way_.watches_stability && !falls;
  way_.branch.keep(shooting.rod().load_factor(), now);
  way_.near_critical = scene::has_fallen(way_.start, now);
  way_.was_smooth = way_.was_smooth && !way_.near_critical;
  return true;
}

// Whether load steps this short, or the work done, are the end of it.
template <int D>
bool LoadGrowth<D>::gives_up(const Shooting<D>& shooting, double step) {
  const long long arcs = shooting.rod().arc_count();
  const bool exhausted = shooting.newton_steps() > most_newton_steps_ ||
                         shooting.newton_steps() * arcs > std::max(most_arcs_marched, most_passes * arcs);
  const double smallest = smallest_load_step * std::max(way_.load_factor, way_.first_step);
  if (!exhausted && !nears_fold() && step >= smallest) return false;
  end_.status = shooting.rod().tendon_collapsed() ? scene::Status::tendon_collapsed
                : exhausted                       ? scene::Status::work_limit
                                                  : scene::Status::load_step_too_small;
  end_.smallest_step = nears_fold() ? 0 : smallest;
  end_.newton_steps = exhausted ? shooting.newton_steps() : 0;
  return true;
}

template <int D>
std::string LoadGrowth<D>::message() const {
  if (end_.status == scene::Status::arc_not_converged)
    return "the arcs are too long for the turns of the rod, or these too many for round-off";
  if (end_.status == scene::Status::not_converged) return "Newton did not converge at the loads it starts from";
  std::ostringstream text;
  if (end_.newton_steps > 0) text << "work limit: " << end_.newton_steps << " Newton steps and only ";
  else if (end_.smallest_step > 0) text << "the load step fell below " << end_.smallest_step << " at ";
  else text << "the loads near a fold at ";
  text << 100 * way_.load_factor << " % of the load" << (end_.newton_steps > 0 ? " reached" : "");
  return text.str();
}

template <int D>
void LoadGrowth<D>::start_watch(const Shooting<D>& shooting, bool stable) {
  const LoadWay& way = shooting.rod().way();
  const scene::Symmetry symmetry = scene::common_symmetry(scene::symmetry_of(way.from), scene::symmetry_of(way.to));
  way_.watches_determinant = symmetry != scene::Symmetry::axis;
  way_.watches_stability = scene::is_conservative(way.bounds) && (stable || !is_unstable(shooting));
  way_.may_fall = symmetry != scene::Symmetry::none;
  way_.branch = {};
  way_.branch.keep(0, shooting.determinant());
  way_.start = way_.branch.last();
  way_.near_critical = false;
}

template <int D>
void LoadGrowth<D>::forget_way() {
  end_ = {};
  is_paused_ = false;
  way_.swing_limit_rad = std::numeric_limits<double>::infinity();
  way_.load_steps = 1;
  way_.keeps_derivatives = false;
  way_.size_since_derivatives = std::numeric_limits<double>::infinity();
  way_.was_smooth = true;
  way_.watches_determinant = false;
}

template <int D>
scene::Status LoadGrowth<D>::run(Shooting<D>& shooting, double swing_limit_rad) {
  if (run_at_once(shooting)) return scene::Status::converged;
  if (shooting.moments_are_known()) return end_.status;
  way_.swing_limit_rad = way_.swing_rad = swing_limit_rad;
  way_.load_steps = 0;
  shooting.start_unloaded();
  if (!shooting.newton(shooting.newton_tolerance())) return end_.status = scene::Status::not_converged;
  start_watch(shooting, true);
  const LoadBounds& bounds = shooting.bounds();
  return grow(shooting, bounds.load_length * bounds.load_length + bounds.turn_rad);
}

template <int D>
bool LoadGrowth<D>::run_at_once(Shooting<D>& shooting) {
  forget_way();
  if (shooting.moments_are_known()) return solve_known_moments(shooting) == scene::Status::converged;
  // On its axis a rod is straight under all loads, and what is left to tell is whether it stays there.
  const bool is_known =
      shooting.one_equilibrium() || scene::symmetry_of(shooting.rod().way().to) == scene::Symmetry::axis;
  return (is_known && shooting.solve_at_once()) || (way_.watches_stability && ends_beside_rest(shooting));
}

// There is no other equilibrium, so that none has to be grown to. Arcs as short as the law takes lead so near that
// Newton converges.
template <int D>
scene::Status LoadGrowth<D>::solve_known_moments(Shooting<D>& shooting) {
  way_.load_factor = 1;
  const bool solved = shooting.solve_known_moments();
  return end_.status = solved ? scene::Status::converged : scene::Status::arc_not_converged;
}

// Between a rest shape and one that is hardly bent the second variation is all but linear in the loads, so that one
// that is positive at both ends is so all the way: the branch reaches the other end, and is alone there. It is for
// loads with an energy: with limits of 3 and 1 in the place of those above 3 of 26 809 strips under following loads end
// elsewhere, their determinants at the end no sign of it.
template <int D>
bool LoadGrowth<D>::ends_beside_rest(Shooting<D>& shooting) {
  const double missed_share = shooting.start_from_clamp();
  if (!(missed_share * shooting.bending_rad() <= most_guess_error_rad) || !is_hardly_bent(shooting)) return false;
  int conjugate_points = 1;
  const OnTheWay way{shooting.determinant_at_rest(), leading_turn_rad, false, &conjugate_points};
  if (!shooting.newton(shooting.newton_tolerance(), &way)) return false;
  shooting.march_all();
  if (!is_hardly_bent(shooting)) return false;
  // Newton's derivatives are those of a shape a step away: too near for what is far from zero to change its sign.
  const bool smooth = !scene::has_fallen(way.start, shooting.determinant());
  if (!(smooth && conjugate_points == 0) && is_unstable(shooting)) return false;
  way_.was_smooth = smooth;
  way_.start = way.start;
  way_.watches_determinant = true;
  return true;
}

// A fold is foretold, or where steps lead nowhere and the determinant has all but vanished.
template <int D>
scene::Status LoadGrowth<D>::run_on(Shooting<D>& shooting, const Last& last, const Angular<double, D>& tip_turn_B) {
  forget_way();
  if (shooting.moments_are_known()) return solve_known_moments(shooting);
  start_ = shooting.nodes();
  const LoadWay& way = shooting.rod().way();
  const double size = size_of_change(way.from, way.to);
  if (last.shooting)
    way_.size_since_derivatives =
        size + (last.shooting->has_own_derivatives() ? 0 : last.growth->way_.size_since_derivatives);
  if (shooting.one_equilibrium() && shooting.solve_near(last.shooting, tip_turn_B)) return scene::Status::converged;
  shooting.set_nodes(start_);
  shooting.set_load(0);
  way_.load_steps = 0;
  end_.status = grow_from(shooting, last, size);
  const bool has_vanished =
      way_.watches_determinant && scene::log_fall(way_.start, way_.branch.last()) > -std::log(limit_point_determinant);
  const bool fold = end_.status == scene::Status::load_step_too_small && (has_vanished || nears_fold());
  return end_.status = fold ? scene::Status::limit_point : end_.status;
}

// The derivatives at the last solution serve while the loads have changed by little since they were taken.
template <int D>
scene::Status LoadGrowth<D>::grow_from(Shooting<D>& shooting, const Last& last, double size) {
  way_.keeps_derivatives =
      last.shooting && way_.size_since_derivatives <= most_stale_share * size_to_zero(last.shooting->determinant()) &&
      shooting.take_derivatives(*last.shooting);
  if (!way_.keeps_derivatives && !shooting.newton(shooting.newton_tolerance())) return scene::Status::not_converged;
  start_watch(shooting, last.stable);
  return grow(shooting, size);
}

// The parabola's surprise grows with the third power of the step, that of the line is noise where branches are near;
// the turn as the step, and so does the line's surprise over it: coils of many turns, and columns beyond their critical
// load, met these limits, and a longer step was refused every second time.
template <int D>
double LoadGrowth<D>::growth_after(const StepSize& size) const {
  const double by_turn = std::max(0.9 / size.turn, 1.0);
  const double by_unled = std::max(0.8 / size.unled, 1.0);
  if (way_.near_critical) return std::min({size.surprise < 0.25 ? 2 : 1.2, by_turn, by_unled});
  return std::min(std::clamp(0.8 / std::cbrt(size.surprise), 1.2, 3.0), by_turn);
}

template <int D>
scene::Status LoadGrowth<D>::grow(Shooting<D>& shooting, double size) {
  way_.load_factor = way_.previous_factor = 0;
  scene::Determinant start = way_.branch.last();
  if (!way_.watches_determinant) start.log_size = 0;
  const double most = size_to_zero(start);
  way_.next_step = way_.first_step = most / std::max(most, size);
  // Over the whole step where another solve has left the nodes as far from the solution as it may: a small difference
  // makes much of that.
  shooting.set_load_tangent((way_.keeps_derivatives ? 1 : tangent_difference) * way_.first_step, tangent_);
  return grow_on(shooting);
}

template <int D>
scene::Status LoadGrowth<D>::grow_on(Shooting<D>& shooting) {
  while (way_.load_factor < 1) {
    double& step = way_.next_step;
    if (way_.watches_determinant) {
      step = std::min(step, way_.branch.longest_step(way_.load_factor));
      step = std::min(step, way_.branch.longest_bent_step(way_.load_factor));
    }
    if (gives_up(shooting, step)) return end_.status;
    const double from = way_.load_factor;
    const double to = 1 - from <= 1.001 * step ? 1 : from + step;
    if (const std::optional<StepSize> taken = try_step(shooting, to)) step *= growth_after(*taken);
    else if (is_paused_) return end_.status = scene::Status::not_converged;
    else step = (to - from) / 2;
  }
  return scene::Status::converged;
}

// No arc swings farther than it did by more than the nodes turn, as a rule: a march for every step takes up to 7 % of
// the work.
template <int D>
bool LoadGrowth<D>::swings_too_far(Shooting<D>& shooting, double turn_rad) {
  way_.swing_rad += turn_rad;
  if (way_.swing_rad <= way_.swing_limit_rad) return false;
  shooting.march_all();
  const LoadedRod<D>& rod = shooting.rod();
  way_.swing_rad = largest_swing_rad<D>(rod.way().to, rod.arcs_per_span(), shooting.marched().arcs);
  return !(way_.swing_rad <= way_.swing_limit_rad);
}

template <int D>
scene::Status LoadGrowth<D>::go_on(Shooting<D>& shooting, const LoadGrowth& fewer_arcs) {
  previous_ = fewer_arcs.previous_;
  earlier_ = fewer_arcs.earlier_;
  tangent_ = fewer_arcs.tangent_;
  way_ = fewer_arcs.way_;
  way_.swing_rad = way_.swing_limit_rad / 2;  // twice the arcs
  end_ = {};
  is_paused_ = false;
  return grow_on(shooting);
}

template class LoadGrowth<2>;
template class LoadGrowth<3>;

}  // namespace fam
