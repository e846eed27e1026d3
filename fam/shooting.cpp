#include "fam/shooting.h"

#include "fam/load_length.h"
#include "fam/rotation.h"
#include "scene/span_facts.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fam {
namespace {

// sine_vector(M [turn]) by the turn.
Matrix3d sine_slope(const Matrix3d& M) {
  return 0.5 * (M.trace() * Matrix3d::Identity() - M.transpose());
}
Eigen::Matrix<double, 1, 1> sine_slope(const Eigen::Matrix2d& M) {
  return Eigen::Matrix<double, 1, 1>(0.5 * M.trace());
}

template <int N>
void march_counted(const LoadedRod<3>& rod, ArcRange arcs, SectionState<3>& state, Fields<3, N>& fields,
                   ConjugatePoints* points) {
  if (!points) return march_varied(rod, arcs, state, fields);
  points->start(state);
  march_varied(rod, arcs, state, fields, [points](const auto& at, const auto& f) { points->after_arc(at, f); });
}
template <int N>
void march_counted(const LoadedRod<2>& rod, ArcRange arcs, SectionState<2>& state, Fields<2, N>& fields,
                   ConjugatePoints*) {
  march_varied(rod, arcs, state, fields);
}

// Below it no other branch is meant. With 1e-4 in its place random scene 99989 ends in work_limit.
constexpr double least_straying_rad = 0.02;

}  // namespace

template <int D>
void MarchedArcs<D>::reserve(std::size_t count) {
  arcs.reserve(count);
  motions.reserve(count);
  distal_wrenches_S.reserve(count);
}

template <int D>
void MarchedArcs<D>::resize(std::size_t count) {
  arcs.resize(count);
  motions.resize(count);
  distal_wrenches_S.resize(count);
}

template <int D>
void Shooting<D>::set(const LoadWay& way, std::span<const int> arcs_per_span, Law law, RodModel model,
                      double newton_tolerance, const Shooting* fewer) {
  rod_.set(way, arcs_per_span, law, model);
  newton_tolerance_ = newton_tolerance;
  has_own_derivatives_ = false;
  length_mm_ = way.to.back().end_mm;
  least_stiffness_Nmm2_ = std::numeric_limits<double>::infinity();
  for (const scene::Span& span : way.to)
    least_stiffness_Nmm2_ = std::min(least_stiffness_Nmm2_, least_stiffness_Nmm2(span));
  if (fewer) take_segments(*fewer);
  else cut_into_segments();
  marched_.resize(static_cast<std::size_t>(rod_.arc_count()));
  moments_are_known_ = scene::moments_are_known(way.to);
  if (!fewer && has_few_arcs()) reserve_few_arcs();
}

template <int D>
void Shooting<D>::reserve(const Room& room) {
  rod_.reserve(room);
  segments_.reserve(room.arcs);
  nodes_.reserve(room.arcs);
  marched_.reserve(room.arcs);
  softness_.reserve(room.arcs);
  system_.reserve(unknowns * room.arcs);
  few_counts_.reserve(room.spans);
  const std::size_t few = std::max(room.arcs / 4, room.spans);
  if (few == room.arcs) return;
  if (!few_arcs_) few_arcs_ = std::make_unique<Shooting>();
  few_arcs_->reserve({few, room.spans, room.tendons});
}

template <int D>
bool Shooting<D>::has_few_arcs() const {
  return one_equilibrium() && rod_.arc_count() >= 2 * static_cast<int>(rod_.way().to.size());
}

// So that solve_at_once() takes none.
template <int D>
void Shooting<D>::reserve_few_arcs() {
  const std::size_t spans = rod_.way().to.size(), tendons = most_tendons(rod_.way().to);
  if (!few_arcs_) few_arcs_ = std::make_unique<Shooting>();
  few_arcs_->reserve({static_cast<std::size_t>(rod_.arc_count()) / 4 + spans, spans, tendons});
  few_counts_.reserve(spans);
}

template <int D>
void Shooting<D>::forget_work() {
  newton_steps_ = 0;
  rod_.forget_collapse();
}

template <int D>
void Shooting<D>::set_residual(std::size_t k, const Node& arrived, SegmentEquations& equations) const {
  const Node target = k > 0 ? nodes_[k - 1] : Node{Rotation::Identity(), {}};
  auto& residual = equations.residual;
  equations.mismatch = arrived.rotation_SB * target.rotation_SB.transpose();
  equations.mismatch_is_small = is_small<D>(equations.mismatch);
  residual.template head<rotations>() = sine_vector<double>(equations.mismatch);
  residual.template segment<D>(rotations) = (arrived.wrench.force_N - target.wrench.force_N) / force_unit();
  residual.template tail<rotations>() = (arrived.wrench.moment_Nmm - target.wrench.moment_Nmm) / moment_unit();
}

// Residual and derivatives of segment k with respect to the N unknowns of its node: the tip's rotations, or all.
template <int D>
template <int N>
void Shooting<D>::evaluate_segment(std::size_t k, SegmentEquations& equations, ConjugatePoints* points) const {
  SectionState<D> state = nodes_[k];
  Fields<D, N> fields;
  fields.turn = fields.turn.Identity();
  fields.force_N.setZero();
  fields.moment_Nmm.setZero();
  if constexpr (N == unknowns) {
    fields.force_N.template middleCols<D>(rotations).diagonal().setConstant(force_unit());
    fields.moment_Nmm.template rightCols<rotations>().diagonal().setConstant(moment_unit());
  }
  march_counted(rod_, segments_[k], state, fields, points);
  if constexpr (D == 3) {
    if (points) points->end(fields, force_unit(), moment_unit());
  }
  set_residual(k, state, equations);
  auto& [residual, mismatch, arrival, mismatch_slope, mismatch_is_small] = equations;
  mismatch_slope = sine_slope(mismatch);
  const Eigen::Matrix<double, rotations, rotations> by_turn = -sine_slope(Rotation(mismatch.transpose()));
  arrival.template topLeftCorner<rotations, N>() = by_turn.lazyProduct(fields.turn);
  arrival.template block<D, N>(rotations, 0) = fields.force_N / force_unit();
  arrival.template bottomLeftCorner<rotations, N>() = fields.moment_Nmm / moment_unit();
}

template <int D>
double Shooting<D>::largest_turn_rad(const Eigen::Ref<const Eigen::VectorXd>& step) const {
  double largest = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    largest = std::max(largest, step.segment<rotations>(static_cast<Eigen::Index>(unknowns * k)).norm());
  }
  return largest;
}

template <int D>
void Shooting<D>::apply(const Eigen::Ref<const Eigen::VectorXd>& step, double largest_turn) {
  const double shorten = largest_turn > largest_newton_turn_rad ? largest_newton_turn_rad / largest_turn : 1;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(unknowns * k);
    nodes_[k].rotation_SB = turned(nodes_[k].rotation_SB, Angular<double, D>(shorten * step.segment<rotations>(at)));
    if (k + 1 == nodes_.size()) break;
    nodes_[k].wrench.force_N += shorten * force_unit() * step.segment<D>(at + rotations);
    nodes_[k].wrench.moment_Nmm += shorten * moment_unit() * step.segment<rotations>(at + rotations + D);
  }
}

template <int D>
bool Shooting<D>::ends_measured(double size, double turn_rad, double tolerance) {
  if (!(size <= tolerance)) return false;
  expected_turn_rad_ = turn_rad;
  return marched_is_of_nodes_ = true;
}

template <int D>
void Shooting<D>::march_all() {
  if (marched_is_of_nodes_) return;
  for (std::size_t k = segments_.size(); k-- > 0;) {
    Node state = nodes_[k];
    march_remembered(k, state);
  }
  marched_is_of_nodes_ = true;
}

template <int D>
double Shooting<D>::bending_rad() const {
  double sum = 0;
  for (std::size_t i = 0; i < rod_.span_arcs().size(); ++i) {
    const SpanArcs<D>& span = rod_.span_arcs()[i];
    const Angular<double, D> rest = span.constants.length_mm * angular_part<D>(rod_.way().to[i].rest_curvature_per_mm);
    for (int arc = span.first_arc; arc < span.end_arc; ++arc)
      sum += (marched_.arcs[static_cast<std::size_t>(arc)].screw.rotation - rest).norm();
  }
  return sum;
}

bool Contraction::is_lost(const OnTheWay& way, double turn_rad, bool fresh) {
  const bool falls = turn_rad <= std::max(last_turn_rad_ / 2, least_straying_rad);
  const bool strays = fresh && last_was_fresh_ && !falls && !way.near_critical;
  last_turn_rad_ = turn_rad;
  last_was_fresh_ = fresh;
  return strays || turn_rad > way.hopeless_turn_rad;
}

// One segment: the tip's rotation, on the stack. Derivatives are fresh while the steps are long, and after that mended
// by Broyden's secant update. slope_ holds them between calls, `keep_slope` says whether it does at the start.
template <int D>
bool Shooting<D>::newton_one_segment(bool keep_slope, double tolerance, const OnTheWay* way, double first_shrinkage,
                                     double least_shrinkage) {
  SegmentEquations equations;
  Angular<double, D> step = Angular<double, D>::Zero();
  Angular<double, D> last_residual = step;
  Contraction contraction;
  double last = std::numeric_limits<double>::infinity();
  double last_log = keep_slope ? determinant().log_size : std::numeric_limits<double>::quiet_NaN();
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    ++newton_steps_;
    Angular<double, D> residual;
    if (keep_slope) {
      Node state = nodes_[0];
      march_remembered(0, state);
      residual = sine_vector<double>(state.rotation_SB);
      equations.mismatch_is_small = is_small<D>(state.rotation_SB);
      if (std::isfinite(last)) slope_ += (residual - last_residual - slope_ * step) * step.transpose() / (last * last);
    } else {
      ConjugatePoints points;
      int* conjugate_points = points_wanted(way);
      evaluate_segment<rotations>(0, equations, conjugate_points ? &points : nullptr);
      if (conjugate_points) *conjugate_points = points.count();
      residual = equations.residual.template head<rotations>();
      slope_ = equations.arrival.template topLeftCorner<rotations, rotations>();
      has_own_derivatives_ = true;
    }
    last_residual = residual;
    step = -slope_.inverse() * residual;
    const double size = step.norm();
    if (!std::isfinite(size) || (way && contraction.is_lost(*way, size, !keep_slope))) return false;
    if (size > largest_newton_turn_rad) step *= largest_newton_turn_rad / size;
    const scene::Determinant now = determinant();
    const bool tells = !(std::abs(now.log_size - last_log) > most_log_change);
    last_log = now.log_size;
    // What a small turn of the tip makes of the clamp's, by which the rod lies off: 240 times as much under couples.
    const double at_clamp = std::max(1.0, residual.norm() / size);
    if (keep_slope && std::isfinite(last) && tells && ends_measured(at_clamp * size, at_clamp * size, tolerance))
      return equations.mismatch_is_small;
    nodes_[0].rotation_SB = turned(nodes_[0].rotation_SB, step);
    // The next step would be smaller by what this one was, or squared after fresh derivatives.
    const double shrinkage = std::isfinite(last) ? std::clamp(size / last, least_shrinkage, 0.1) : first_shrinkage;
    const double next = at_clamp * (keep_slope ? size * shrinkage : newton_curvature * size * size);
    expected_turn_rad_ = next;
    if (tells && next <= tolerance) return equations.mismatch_is_small;
    const bool may_keep = keep_slope || !way || !(way->near_critical || scene::has_fallen(way->start, now));
    keep_slope = tells && may_keep && slopes_last(keep_slope, size, last);
    last = size;
  }
  return false;
}

// Writes segment k into the system. Columns: node k at k times `unknowns`; the tip's, the last, has its rotations
// alone. Rows: the clamp's rotations, then all for each segment k > 0.
template <int D>
void Shooting<D>::assemble(int k, const SegmentEquations& equations) {
  const bool tip = k + 1 == static_cast<int>(segments_.size());
  const int column = unknowns * k;
  const int before = column - unknowns;
  const int row = k > 0 ? column - rotations - D : 0;
  for (int i = 0; i < (k > 0 ? unknowns : rotations); ++i) {
    for (int j = 0; j < (tip ? rotations : unknowns); ++j) system_(row + i, column + j) = equations.arrival(i, j);
    if (k == 0) continue;
    if (i >= rotations) system_(row + i, before + i) = -1;
    for (int j = 0; i < rotations && j < rotations; ++j) {
      system_(row + i, before + j) = equations.mismatch_slope(i, j);
    }
  }
}

template <int D>
void Shooting<D>::set_right(std::size_t k, const SegmentEquations& equations) {
  const auto row = static_cast<Eigen::Index>(k > 0 ? unknowns * k - rotations - D : 0);
  const auto rows = k > 0 ? unknowns : rotations;
  system_.right().segment(row, rows) = -equations.residual.head(rows);
}

template <int D>
bool Shooting<D>::evaluate_system(bool keep_factors, bool& mismatches_are_small, int* conjugate_points) {
  SegmentEquations equations;
  ConjugatePoints points;
  mismatches_are_small = true;
  if (!keep_factors) {
    system_.set_zero();
    has_own_derivatives_ = true;
  }
  for (std::size_t k = segments_.size(); k-- > 0;) {
    if (keep_factors) {
      Node state = nodes_[k];
      march_remembered(k, state);
      set_residual(k, state, equations);
    } else {
      ConjugatePoints* wanted = conjugate_points ? &points : nullptr;
      if (k + 1 == segments_.size()) evaluate_segment<rotations>(k, equations, wanted);
      else evaluate_segment<unknowns>(k, equations, wanted);
      assemble(static_cast<int>(k), equations);
    }
    mismatches_are_small = mismatches_are_small && equations.mismatch_is_small;
    set_right(k, equations);
  }
  if (conjugate_points && !keep_factors) *conjugate_points = points.count();
  return system_.right().allFinite() && (keep_factors || system_.factorise());
}

// All segments together. Where no solution is near, steps with fresh derivatives halve at best and then jump; on the
// way two of them that do not fall by half are the end. Where rotations are as good as asked for, it is round-off.
// Beside a critical point a step along the motion that costs next to nothing changes the derivatives by orders of
// magnitude: a step's size tells how far the solution is only where the last ones' determinant was about the same.
template <int D>
bool Shooting<D>::newton_segments(bool keep_factors, double tolerance, const OnTheWay* way) {
  bool kept_last = keep_factors;
  double last_log = keep_factors ? system_.log_determinant() : std::numeric_limits<double>::quiet_NaN();
  Contraction contraction;
  int stalled = 0;
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    ++newton_steps_;
    bool small;
    if (!evaluate_system(keep_factors, small, points_wanted(way))) return false;
    system_.substitute();
    if (!system_.right().allFinite()) return false;
    const double turn_rad = largest_turn_rad(system_.right()), size = system_.right().cwiseAbs().maxCoeff();
    if (way && contraction.is_lost(*way, turn_rad, !keep_factors)) return false;
    const bool tells = !(std::abs(system_.log_determinant() - last_log) > most_log_change);
    last_log = system_.log_determinant();
    if (keep_factors && std::isfinite(last) && tells && ends_measured(size, turn_rad, tolerance)) return small;
    apply(system_.right(), turn_rad);
    const bool stalls = !keep_factors && size > 0.5 * last;
    const double shrinkage = std::isfinite(last) ? size / last : 0.1;
    const double expected_share = keep_factors ? shrinkage : newton_curvature * size;
    expected_turn_rad_ = turn_rad * (stalls ? 1 : expected_share);
    if (stalls && turn_rad <= tolerance) return small;
    if (way && stalls && !kept_last && ++stalled == most_stalled_steps) return false;
    kept_last = keep_factors;
    if (tells && size * expected_share <= tolerance) return small;
    const bool may_keep = keep_factors || (way && !way->near_critical && !scene::has_fallen(way->start, determinant()));
    keep_factors = tells && may_keep && slopes_last(keep_factors, size, last);
    last = size;
  }
  return false;
}

template <int D>
void Shooting<D>::set_load_tangent(double difference, std::vector<Fields<D, 1>>& tangent) {
  const double factor = rod_.load_factor();
  rod_.set_load(factor + difference);
  const auto over = [difference](const auto& step, double unit) { return (unit / difference * step).eval(); };
  tangent.back().force_N.setZero();
  tangent.back().moment_Nmm.setZero();
  if (segments_.size() == 1) {
    const SegmentEquations missed = equations(0, false);
    tangent[0].turn = over(-slope_.inverse() * missed.residual.template head<rotations>(), 1);
  } else {
    for (std::size_t k = 0; k < segments_.size(); ++k) set_right(k, equations(k, false));
    system_.substitute();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const auto step = system_.right().tail(system_.size() - static_cast<Eigen::Index>(unknowns * k));
      tangent[k].turn = over(step.template head<rotations>(), 1);
      if (k + 1 == nodes_.size()) break;
      tangent[k].force_N = over(step.template segment<D>(rotations), force_unit());
      tangent[k].moment_Nmm = over(step.template segment<rotations>(rotations + D), moment_unit());
    }
  }
  rod_.set_load(factor);
}

template <int D>
bool Shooting<D>::newton(double tolerance, const OnTheWay* way, bool keep_derivatives) {
  return segments_.size() == 1 ? newton_one_segment(keep_derivatives, tolerance, way)
                               : newton_segments(keep_derivatives, tolerance, way);
}

// Of a taut rod the determinant is cosh(int sqrt(n_x / EI) ds) for each plane of bending.
template <int D>
double Shooting<D>::log_growth() const {
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    sum += softness_[k] * std::sqrt(std::max(0.0, nodes_[k].wrench.force_N[0]));
  }
  return sum;
}

template <int D>
scene::Determinant Shooting<D>::determinant() const {
  if (segments_.size() > 1) return {system_.log_determinant(), system_.determinant_is_negative(), log_growth()};
  const double determinant = slope_.determinant();
  return {std::log(std::abs(determinant)), determinant < 0};
}

template <int D>
scene::Determinant Shooting<D>::exact_determinant() {
  SegmentEquations equations;
  bool small;
  if (segments_.size() > 1) {
    evaluate_system(false, small);
  } else {
    evaluate_segment<rotations>(0, equations);
    slope_ = equations.arrival.template topLeftCorner<rotations, rotations>();
    has_own_derivatives_ = true;
  }
  return determinant();
}

template <int D>
typename Shooting<D>::SegmentEquations Shooting<D>::equations(std::size_t k, bool with_slopes) const {
  if (!with_slopes) {
    Node state = nodes_[k];
    rod_.march(segments_[k], state);
    return residual(k, state);
  }
  SegmentEquations result;
  if (k + 1 == segments_.size()) evaluate_segment<rotations>(k, result);
  else evaluate_segment<unknowns>(k, result);
  return result;
}

template struct MarchedArcs<2>;
template struct MarchedArcs<3>;
template class Shooting<2>;
template class Shooting<3>;

}  // namespace fam
