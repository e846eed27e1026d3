#include "fam/path_stepper.h"

#include "fam/answer.h"
#include "fam/load_length.h"
#include "fam/rotation.h"
#include "fam/solution.h"
#include "fam/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace fam {
namespace {

using scene::Symmetry;

constexpr double tight_tolerance = 3e-21;  // of Newton's method where a point is located: its last step is below 1e-11
constexpr double watched_tolerance = 1e-15;   // a looser one lets a rod stray that all but turns about its axis freely
constexpr double held_to = 1e-9;              // a state lies in the subspace of a symmetry
constexpr double longest_path_swing_rad = 2;  // of an arc, where arcs are not given; chosen, not measured
constexpr double mesh_reach = 0.1;            // loads that segments are cut for, about the present one, in units
constexpr double mesh_share = 0.5;            // the same, of the parameter itself

// Three parameters tell what holds for all.
std::array<double, 3> probes(const scene::PathRequest& request) {
  return {request.from, request.to, request.from + 0.37 * (request.to - request.from)};
}

PathEquations::Settings settings_for(const scene::PathRequest& request, const Options& options, double tolerance_mm,
                                     const PathStepper::Settings& settings) {
  const double length_mm = scene::length_mm(request.scene);
  const bool has_tolerance = options.arcs == 0 || options.tolerance_mm > 0;
  PathEquations::Settings result;
  result.law = chosen(options.law);
  if (settings.is_watched) result.newton_tolerance = watched_tolerance;
  else if (has_tolerance)
    result.newton_tolerance = std::clamp(1e-3 * tolerance_mm / length_mm, tightest_newton_tolerance, 1e-6);
  result.unit = settings.unit;
  result.lowest = settings.lowest;
  result.highest = settings.highest;
  const scene::Scene first = scene::scene_at(request, request.from), last = scene::scene_at(request, request.to);
  scene::Reused<scene::Span> larger;
  set_larger(scene::spans_of(first), scene::spans_of(last), larger);
  result.model = choose_rod(larger, options.model, options.arcs == 0 ? tolerance_mm : 0).model;
  return result;
}

// As `fam solve` says it.
std::string why_none(const scene::Equilibrium& solved, const Found& found, const Problem& problem) {
  if (!solved.converged()) return std::string(scene::name(solved.status)) + ": " + solved.message;
  return std::string(scene::name(found.status)) + ": " +
         (found.status == scene::Status::tolerance_not_met
              ? tolerance_not_met(problem, *found.run, found.error_mm).message
              : found.run->engine.failure_message(found.status));
}

bool tells_no_direction(std::span<const scene::Span> spans) {
  return scene::needs_no_plane(spans) && scene::is_isotropic(spans);
}

}  // namespace

PathStepper::PathStepper(const scene::PathRequest& request, const Options& options, const Settings& settings)
    : request_(request),
      options_(options),
      settings_(settings),
      tolerance_mm_(fam::tolerance_mm(options, scene::length_mm(request.scene))),
      equations_(request, settings_for(request, options, tolerance_mm_, settings)) {
  set_symmetry(request);
}

void PathStepper::set_symmetry(const scene::PathRequest& request) {
  is_round_ = true;
  bool first = true;
  for (const double parameter : probes(request)) {
    const std::span<const scene::Span> spans = equations_.spans_at(parameter);
    const Symmetry symmetry = scene::symmetry_of(spans);
    symmetry_ = first ? symmetry : scene::common_symmetry(symmetry_, symmetry);
    is_round_ = is_round_ && tells_no_direction(spans);
    first = false;
  }
  const bool has_zero =
      request.parameter != scene::PathParameter::turn_rad && settings_.lowest <= 0 && settings_.highest >= 0;
  if (!is_round_ && has_zero && tells_no_direction(equations_.spans_at(0))) free_parameter_ = 0;
}

bool PathStepper::is_held_by(const PathState& state, Symmetry symmetry) const {
  const int axis = symmetry == Symmetry::axis ? 0 : symmetry == Symmetry::plane_xy ? 2 : 1;
  return symmetry != Symmetry::none &&
         std::all_of(state.nodes.begin(), state.nodes.end(), [&](const SectionState<3>& node) {
           return (node.rotation_SB.col(axis) - Vector3d::Unit(axis)).norm() < held_to;
         });
}

PathMesh PathStepper::mesh_about(double parameter) {
  const double reach = std::max(mesh_reach * settings_.unit, mesh_share * std::abs(parameter));
  PathMesh mesh;
  mesh.low = std::max(settings_.lowest, parameter - reach);
  mesh.high = std::min(settings_.highest, parameter + reach);
  const std::span<const scene::Span> bounds = equations_.bounds_between(mesh.low, mesh.high);
  if (options_.arcs > 0) mesh.arcs = scene::cells_per_span(bounds, options_.arcs);
  else set_first_arcs(bounds, false, mesh.arcs);
  return mesh;
}

std::optional<PathPlace> PathStepper::start(double parameter, bool upwards) {
  const scene::Scene scene = scene::scene_at(request_, parameter);
  Problem problem;
  problem.set(scene, options_);
  message_ = refusal(problem);
  if (!facts_of(problem.choice().law).coupled) message_ = "unsupported: the published law follows no paths";
  if (!message_.empty()) return std::nullopt;
  Run one, another;
  const Found found = solve_to_tolerance(problem, one, another);
  if (found.status != scene::Status::converged) {
    message_ = why_none(solve(scene, options_), found, problem);
    return std::nullopt;
  }
  Solution solution;
  solution.set(problem, *found.run);
  PathMesh mesh = mesh_about(parameter);
  for (;;) {
    if (std::accumulate(mesh.arcs.begin(), mesh.arcs.end(), 0LL) > max_arcs) break;
    equations_.set_mesh(mesh);
    equations_.set_parameter(parameter);
    PathState guess{{}, parameter};
    for (const ArcRange& segment : equations_.segments()) {
      const SpanArcs<3>& span = *std::find_if(equations_.rod().span_arcs().begin(), equations_.rod().span_arcs().end(),
                                              [&](const SpanArcs<3>& s) { return segment.end_arc <= s.end_arc; });
      const auto i = static_cast<std::size_t>(&span - equations_.rod().span_arcs().data());
      const scene::Span& place = equations_.rod().way().to[i];
      const double s_mm = segment.end_arc == span.end_arc
                              ? place.end_mm
                              : place.start_mm + (segment.end_arc - span.first_arc) * span.constants.length_mm;
      SectionState<3> state = solution.state(solution.place_at(s_mm));
      if (segment.end_arc == span.end_arc) {  // without the point loads there
        SectionWrench loads;
        span.add_point_loads(state.rotation_SB, loads);
        state.wrench = state.wrench + -1.0 * loads;
      }
      guess.nodes.push_back(state);
    }
    guess.nodes.back().wrench = {};
    equations_.hold(is_held_by(guess, symmetry_) ? symmetry_ : Symmetry::none);
    std::optional<PathPlace> place =
        judged(corrected(guess, {0, Vector3d::Zero(), upwards ? 1.0 : -1.0}, Newton::usual));
    if (place && (options_.arcs > 0 || is_accurate(*place))) return place;
    if (options_.arcs > 0) break;
    for (int& count : mesh.arcs) count *= 2;
  }
  message_ = "not_converged: Newton did not converge from the equilibrium found there";
  return std::nullopt;
}

std::optional<PathPlace> PathStepper::corrected(PathState guess, const PathBorder::Row& row, Newton newton) {
  PathPlace place;
  const auto is_bent = [&](const PathState& state) {
    return is_round_ ? equations_.held() != Symmetry::axis : !is_held_by(state, Symmetry::axis);
  };
  const bool may_turn = is_round_ || guess.parameter == free_parameter_;
  place.is_free = may_turn && is_bent(guess);
  PathBorder border{row, std::nullopt};
  if (place.is_free) border.phase = equations_.phase_row(guess);
  const double tolerance = newton == Newton::usual ? equations_.newton_tolerance() : tight_tolerance;
  const auto linear = equations_.correct(guess, border, tolerance);
  if (!linear) return std::nullopt;
  place.state = std::move(guess);
  place.is_free = place.is_free && is_bent(place.state);
  place.tangent = linear->tangent;
  place.determinant = linear->determinant;
  place.surprise_rad = linear->first_step_rad;
  if (is_round_ && !place.is_free) place.cross = cross_turn(equations_.rod(), equations_.segments(), place.state.nodes);
  return place;
}

std::optional<PathPlace> PathStepper::judged(std::optional<PathPlace> place) {
  if (!place || !judge(*place)) return std::nullopt;
  return place;
}

bool PathStepper::judge(PathPlace& place) {
  const LoadedRod<3>& rod = equations_.rod();
  if (scene::is_conservative(rod.way().to))
    place.index = stability(rod, equations_.segments(), place.state.nodes, place.is_free).conjugate_points;
  place.accuracy =
      equations_.accuracy(place.state, settings_.told_by_parameter ? place.tangent : equations_.zero_change());
  place.tip_position_B_mm = place.accuracy.tip_position_B_mm;
  return place.tip_position_B_mm.allFinite();
}

std::optional<PathPlace> PathStepper::step(const PathPlace& from, double length, const PathChange& curvature,
                                           Newton newton) {
  const PathChange change = length * (from.tangent + (length / 2) * curvature);
  return corrected(equations_.moved(from.state, change), equations_.row_across(from.tangent), newton);
}

std::optional<PathPlace> PathStepper::at(const PathPlace& near, double parameter, const PathChange& curvature) {
  const double slope = near.slope() * settings_.unit;
  if (slope == 0) return std::nullopt;
  const double straight = (parameter - near.state.parameter) / slope;
  const double bend = curvature[curvature.size() - 1] * settings_.unit / 2;
  const double length = straight / (1 + straight * bend / slope);
  PathState guess = equations_.moved(near.state, length * (near.tangent + (length / 2) * curvature));
  guess.parameter = parameter;
  auto place = judged(corrected(guess, {0, Vector3d::Zero(), slope > 0 ? 1.0 : -1.0}, Newton::tight));
  if (!place) return std::nullopt;
  place->state.parameter = parameter;
  if (!is_round_ && place->is_free) {  // how the path turns the rod, no equation tells there
    place->tangent = near.tangent + length * curvature;
    place->tangent /= std::sqrt(inner(place->tangent, place->tangent));
  }
  return place;
}

bool PathStepper::may_double() const {
  constexpr int most = 256;  // arcs to double; of the sixth order, more bring nothing but round-off
  return options_.arcs == 0 && equations_.rod().arc_count() <= most;
}

double PathStepper::parameter_tolerance(double parameter) const {
  constexpr double finest = 1e-10, least_share = 1e-2;  // of the range, near zero
  const double share = std::clamp(tolerance_mm_ / equations_.length_mm(), finest, settings_.critical_tolerance);
  return share * std::max(std::abs(parameter), least_share * settings_.unit);
}

bool PathStepper::is_accurate(const PathPlace& place) const {
  if (options_.arcs > 0) return true;
  return place.accuracy.error_mm <= tolerance_mm_ && place.accuracy.swing_rad <= longest_path_swing_rad;
}

bool PathStepper::is_within_mesh(const PathPlace& place) const {
  const PathMesh& mesh = equations_.mesh();
  const double p = place.state.parameter;
  return p >= mesh.low && p <= mesh.high;
}

bool PathStepper::is_small_change(double from, double to) {
  const scene::Scene a = scene::scene_at(request_, from), b = scene::scene_at(request_, to);
  const std::vector<scene::Span> before = scene::spans_of(a), after = scene::spans_of(b);
  std::vector<scene::Span> none = before;
  for (scene::Span& span : none) span.unload();
  return size_of_change(before, after) <= 2 + std::sqrt(size_of_change(none, before));
}

bool PathStepper::refine(PathPlace& place) {
  return refine(place, std::vector<bool>(equations_.mesh().arcs.size(), true));
}

bool PathStepper::refine_for(const PathPlace& next, PathPlace& place) {
  return refine(place, equations_.coarse_spans(next.state, longest_path_swing_rad));
}

bool PathStepper::refine(PathPlace& place, const std::vector<bool>& spans) {
  PathMesh mesh = equations_.mesh();
  for (std::size_t i = 0; i < spans.size(); ++i) mesh.arcs[i] *= spans[i] ? 2 : 1;
  if (std::accumulate(mesh.arcs.begin(), mesh.arcs.end(), 0LL) > max_arcs) return false;
  return change_mesh(place, mesh);
}

bool PathStepper::recentre(PathPlace& place) {
  PathMesh mesh = mesh_about(place.state.parameter);
  const std::vector<int>& now = equations_.mesh().arcs;
  for (std::size_t i = 0; i < now.size(); ++i) mesh.arcs[i] = now[i] * ((mesh.arcs[i] + now[i] - 1) / now[i]);
  if (options_.arcs > 0) mesh.arcs = now;
  return change_mesh(place, mesh);
}

// The tangent goes along as the difference to a state a little ahead.
bool PathStepper::change_mesh(PathPlace& place, const PathMesh& mesh) {
  constexpr double ahead = 1e-4;
  const PathMesh before = equations_.mesh();
  const PathState next = equations_.moved(place.state, place.tangent, ahead);
  equations_.set_mesh(mesh);
  PathState here = equations_.carried_over(place.state, before);
  const PathState there = equations_.carried_over(next, before);
  PathChange tangent = equations_.zero_change();
  for (std::size_t k = 0; k < here.nodes.size(); ++k) {
    const Matrix3d turn = here.nodes[k].rotation_SB * there.nodes[k].rotation_SB.transpose();
    tangent.segment<3>(static_cast<Eigen::Index>(9 * k)) = rotation_vector(turn) / ahead;
  }
  tangent[tangent.size() - 1] = place.slope();
  const auto found = corrected(here, equations_.row_across(tangent), Newton::usual);
  if (!found) return false;
  // Its tangent is that of Newton's last step, which may have come far; once more from where it is.
  auto again = judged(corrected(found->state, equations_.row_across(found->tangent), Newton::usual));
  if (!again) return false;
  place = std::move(*again);
  return true;
}

PathPlace PathStepper::restored(const SavedPlace& saved) {
  equations_.set_mesh(saved.mesh);
  equations_.hold(saved.held);
  return saved.place;
}

void PathStepper::reverse(PathPlace& place) const {
  place.tangent = -place.tangent;
  place.determinant.negative = !place.determinant.negative;  // the tangent is a row of that determinant
}

PathPlace PathStepper::fork(const PathPlace& place, int multiplicity) {
  PathPlace result = place;
  result.is_fork = true;
  PathState state = place.state;
  PathBorder border{equations_.row_across(place.tangent), std::nullopt};
  if (place.is_free) border.phase = equations_.phase_row(state);
  equations_.correct(state, border, equations_.newton_tolerance());
  const Symmetry held = equations_.held();
  const bool twofold = multiplicity == 2;
  PathChange change = equations_.null_change(twofold ? Vector3d(0, 0, 1) : Vector3d(0.37, 0.61, 1));
  change -= inner(change, place.tangent) * place.tangent;
  const auto shift_mm = [&](const PathChange& by) -> Vector3d {
    constexpr double little = 1e-4;
    return (equations_.positions_mm(equations_.moved(state, by, little)).back() -
            equations_.positions_mm(equations_.moved(state, by, -little)).back()) /
           (2 * little);
  };
  Vector3d shift = shift_mm(change);
  if (twofold && is_round_) {  // turned about the axis until it leads to +y
    const Matrix3d turn = Eigen::AngleAxisd(-std::atan2(shift[2], shift[1]), Vector3d::UnitX()).toRotationMatrix();
    for (Eigen::Index at = 0; at + 3 <= equations_.unknowns(); at += 3)
      change.segment<3>(at) = (turn * change.segment<3>(at)).eval();
    shift = shift_mm(change);
  }
  for (const Symmetry plane : {Symmetry::plane_xy, Symmetry::plane_xz, Symmetry::none}) {
    equations_.hold(held == Symmetry::axis ? plane : Symmetry::none);
    const PathChange kept = equations_.projected(change);
    if (inner(change - kept, change - kept) > 1e-12) continue;
    change = kept;
    break;
  }
  const double size_mm = shift.norm();
  const double turn_x = change[equations_.unknowns() - 3];
  const double towards = std::abs(shift[1]) > 1e-6 * size_mm   ? shift[1]
                         : std::abs(shift[2]) > 1e-6 * size_mm ? shift[2]
                                                               : turn_x;
  result.tangent = (towards < 0 ? -1 : 1) / std::sqrt(inner(change, change)) * change;
  return result;
}

}  // namespace fam
