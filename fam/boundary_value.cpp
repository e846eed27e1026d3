#include "fam/boundary_value.h"

#include "fam/dual.h"
#include "fam/rotation.h"
#include "fam/span_stiffness.h"
#include "scene/span_facts.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace fam {
namespace {

// The larger of 1/EA and 1/kGA, per N.
double compliance(const scene::Span& span) {
  const double axial = span.stiffness.axial_N ? 1 / *span.stiffness.axial_N : 0;
  return span.stiffness.shear_N ? std::max(axial, 1 / span.stiffness.shear_N->minCoeff()) : axial;
}

// The step of a law with every call inlined: twice as fast, but for many derivatives minutes to compile.
template <class Section, class T, int D>
FAM_FLATTEN BasicMotion<T, D> flat_step(Law law, const Section& section, const ArcForces<T, D>* distributed,
                                        BasicWrench<T, D>& wrench, BasicScrew<T, D>& screw) {
  return law_step(law, section, distributed, wrench, screw);
}

}  // namespace

template <int D>
BasicBoundaryValue<D>::BasicBoundaryValue(std::span<const scene::Span> spans, std::span<const int> arcs_per_span,
                                          Law law, RodModel model, double newton_tolerance)
    : spans_(spans.begin(), spans.end()),
      arcs_per_span_(arcs_per_span.begin(), arcs_per_span.end()),
      law_(law),
      model_(model),
      newton_tolerance_(newton_tolerance),
      length_mm_(spans.back().end_mm),
      bending_Nmm2_(least_stiffness_Nmm2(spans.front())) {
  int first_arc = 0;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    bending_Nmm2_ = std::min(bending_Nmm2_, least_stiffness_Nmm2(spans_[i]));
    span_arcs_.emplace_back(spans_[i], model, first_arc, arcs_per_span[i]);
    first_arc += arcs_per_span[i];
  }
  arcs_.resize(static_cast<std::size_t>(first_arc));
  motions_.resize(arcs_.size());
  poses_.resize(arcs_.size() + 1);
  distal_wrenches_S_.resize(arcs_.size());
  cut_into_segments();
  if (!one_equilibrium() || arc_count() < 4 * static_cast<int>(spans_.size())) return;
  std::vector<int> few = arcs_per_span_;
  for (int& count : few) count = std::max(1, count / 4);
  coarse_ = std::make_unique<BasicBoundaryValue>(spans_, few, law_, model_, 1e-3);
}

template <int D>
bool BasicBoundaryValue<D>::one_equilibrium() const {
  return total_growth_ * total_growth_ <= unique_load && total_turn_rad_ <= largest_total_turn_rad &&
         strain_ <= largest_strain;
}

template <int D>
void BasicBoundaryValue<D>::cut_into_segments() {
  double force = 0;
  double moment = 0;
  double since_cut = 0;
  const bool planar = scene::plane_direction(spans_).has_value();
  int end_arc = arc_count();
  for (std::size_t i = spans_.size(); i-- > 0;) {
    const scene::Span& span = spans_[i];
    force += span.follower_load_S.force_N.norm() + span.fixed_load_B.force_N.norm();
    moment += load_moment_Nmm(span);
    const scene::Wrench tendons = straight_tendons(span);
    const double per_mm = span.follower_force_S_N_per_mm.norm() + span.fixed_force_B_N_per_mm.norm();
    const double h = span.length_mm() / arcs_per_span_[i];
    for (int arc = span_arcs_[i].end_arc; arc-- > span_arcs_[i].first_arc;) {
      force += per_mm * h;
      const double stiffness = planar ? span.stiffness.bending_Nmm2.minCoeff() : least_stiffness_Nmm2(span);
      const double growth = h * (std::sqrt(force / stiffness) + (D == 3 ? moment * moment_growth_per_Nmm2(span) : 0));
      total_growth_ += growth;
      total_turn_rad_ += h * moment / least_stiffness_Nmm2(span);
      if (D == 3) {  // in the plane bent rods are as good as straight ones
        total_turn_rad_ +=
            h * (span.rest_curvature_per_mm.norm() + tendons.moment_Nmm.norm() / least_stiffness_Nmm2(span));
      }
      if (model_ == RodModel::reissner)
        strain_ = std::max(strain_, (force + tendons.force_N.norm()) * compliance(span));
      if (since_cut > 0 && since_cut + growth > segment_growth) {
        segments_.push_back({arc + 1, end_arc});
        end_arc = arc + 1;
        since_cut = 0;
      }
      since_cut += growth;
    }
  }
  segments_.push_back({0, end_arc});
  std::reverse(segments_.begin(), segments_.end());
  nodes_.resize(segments_.size());
  previous_.resize(segments_.size());
}

template <int D>
void BasicBoundaryValue<D>::set_load(double factor) {
  factor_ = factor;
  for (std::size_t i = 0; i < spans_.size(); ++i) span_arcs_[i].set_load(spans_[i], model_, factor);
}

// March over arcs end_arc-1 .. first_arc; after_arc(index, screw, motion, state) sees each proximal end, and its member
// meet(index, state), if it has one, each distal end.
template <int D>
template <bool with_shear, class T, class After>
void BasicBoundaryValue<D>::march_law(int first_arc, int end_arc, State<T>& state, After&& after_arc) const {
  auto span = std::upper_bound(span_arcs_.begin(), span_arcs_.end(), end_arc - 1,
                               [](int arc, const SpanArcs<D>& s) { return arc < s.first_arc; });
  while (end_arc > first_arc) {
    --span;
    if (end_arc == span->end_arc) span->add_point_loads(state.rotation_SB, state.wrench);
    const ElasticSection<with_shear, T, D> section(span->constants);
    for (int arc = end_arc; arc-- > std::max(first_arc, span->first_arc);) {
      BasicScrew<T, D> screw;
      BasicMotion<T, D> motion;
      ArcForces<T, D> forces;
      if (span->distributed) forces = span->forces(state.rotation_SB);
      const ArcForces<T, D>* distributed = span->distributed ? &forces : nullptr;
      if constexpr (requires { after_arc.meet(arc, state); }) after_arc.meet(arc, state);
      if (!span->constants.is_elastic()) {
        motion = tendon_step<with_shear>(law_, span->constants, distributed, state.wrench, screw, tendon_collapsed_);
      } else if constexpr (sizeof(T) <= sizeof(Dual<3>)) {
        motion = flat_step(law_, section, distributed, state.wrench, screw);
      } else {
        motion = law_step(law_, section, distributed, state.wrench, screw);
      }
      for (int axis = 0; axis < D; ++axis) {
        state.rotation_SB.col(axis) = motion.rotate(Vector<T, D>(state.rotation_SB.col(axis)));
      }
      after_arc(arc, screw, motion, state);
    }
    end_arc = std::max(first_arc, span->first_arc);
  }
}

template <int D>
template <class T, class After>
void BasicBoundaryValue<D>::march(int first_arc, int end_arc, State<T>& state, After&& after_arc) const {
  if (model_ == RodModel::reissner) march_law<true>(first_arc, end_arc, state, after_arc);
  else march_law<false>(first_arc, end_arc, state, after_arc);
}

// The rest shape: march without load from a tip turned so that the clamp has R = I.
template <int D>
void BasicBoundaryValue<D>::start_unloaded() {
  set_load(0);
  State<double> tip{Rotation::Identity(), {}};
  const auto nothing = [](int, const auto&, const auto&, const auto&) {};
  State<double> clamp = tip;
  march(0, arc_count(), clamp, nothing);
  tip.rotation_SB = clamp.rotation_SB.transpose();
  for (std::size_t k = segments_.size(); k-- > 0;) {
    nodes_[k] = tip;
    march(segments_[k].first_arc, segments_[k].end_arc, tip, nothing);
  }
}

// Residual and derivatives of segment k with respect to the N unknowns of its node: 3 at the tip, 9 elsewhere.
template <int D>
template <int N>
void BasicBoundaryValue<D>::evaluate_segment(std::size_t k, SegmentEquations& equations) const {
  using Number = Dual<N>;
  const double force_unit = bending_Nmm2_ / (length_mm_ * length_mm_);
  const double moment_unit = bending_Nmm2_ / length_mm_;
  const State<double>& node = nodes_[k];
  State<Number> state{node.rotation_SB.template cast<Number>(),
                      {node.wrench.force_N.template cast<Number>(), node.wrench.moment_Nmm.template cast<Number>()}};
  for (int i = 0; i < turns; ++i) {
    for (int axis = 0; axis < D; ++axis) {  // turning the section by e_i turns the base axes in it by -e_i
      const Vector<double, D> slope =
          -cross(Turn<double, D>(Turn<double, D>::Unit(i)), Vector<double, D>(node.rotation_SB.col(axis)));
      for (int row = 0; row < D; ++row) state.rotation_SB(row, axis).slope[i] = slope[row];
    }
  }
  if constexpr (N == unknowns) {
    for (int i = 0; i < D; ++i) state.wrench.force_N[i].slope[turns + i] = force_unit;
    for (int i = 0; i < turns; ++i) state.wrench.moment_Nmm[i].slope[turns + D + i] = moment_unit;
  }
  march(segments_[k].first_arc, segments_[k].end_arc, state, [](int, const auto&, const auto&, const auto&) {});

  const Rotation target_SB = k > 0 ? nodes_[k - 1].rotation_SB : Rotation::Identity();
  const Eigen::Matrix<Number, D, D> mismatch = state.rotation_SB * target_SB.transpose().template cast<Number>();
  Eigen::Matrix<Number, unknowns, 1> residual;
  residual << sine_vector(mismatch), state.wrench.force_N, state.wrench.moment_Nmm;
  if (k > 0) {
    residual.template segment<D>(turns) -= nodes_[k - 1].wrench.force_N.template cast<Number>();
    residual.template tail<turns>() -= nodes_[k - 1].wrench.moment_Nmm.template cast<Number>();
  }
  Rotation values;
  for (int i = 0; i < D * D; ++i) values(i) = mismatch(i).value;
  equations.mismatch_is_small = is_small<D>(values);
  if constexpr (D == 3) equations.mismatch_slope = 0.5 * (values.trace() * Rotation::Identity() - values.transpose());
  else equations.mismatch_slope(0, 0) = 0.5 * values.trace();
  for (int i = 0; i < unknowns; ++i) {
    const double unit = i < turns ? 1 : i < turns + D ? force_unit : moment_unit;
    equations.residual[i] = residual[i].value / unit;
    equations.arrival.row(i).template head<N>() = residual[i].slope.matrix().transpose() / unit;
  }
}

// Moves the nodes; the largest change of an unknown.
template <int D>
double BasicBoundaryValue<D>::apply(const Eigen::VectorXd& step) {
  const double force_unit = bending_Nmm2_ / (length_mm_ * length_mm_);
  const double moment_unit = bending_Nmm2_ / length_mm_;
  double largest_turn = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    largest_turn = std::max(largest_turn, step.segment<turns>(static_cast<Eigen::Index>(unknowns * k)).norm());
  }
  const double shorten = largest_turn > largest_turn_rad ? largest_turn_rad / largest_turn : 1;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(unknowns * k);
    nodes_[k].rotation_SB = turned(nodes_[k].rotation_SB, Turn<double, D>(shorten * step.segment<turns>(at)));
    if (k + 1 == nodes_.size()) break;
    nodes_[k].wrench.force_N += shorten * force_unit * step.segment<D>(at + turns);
    nodes_[k].wrench.moment_Nmm += shorten * moment_unit * step.segment<turns>(at + turns + D);
  }
  return step.cwiseAbs().maxCoeff();
}

// One segment: the tip's turn, on the stack. Derivatives are fresh while the steps are long, and after that mended by
// Broyden's secant update. slope_ holds them between calls, `fresh_slope` says whether it does at the start.
template <int D>
bool BasicBoundaryValue<D>::newton_one_segment(bool fresh_slope, double tolerance) {
  SegmentEquations equations;
  Turn<double, D> step = Turn<double, D>::Zero();
  Turn<double, D> last_residual = step;
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    ++newton_steps_;
    Turn<double, D> residual;
    if (fresh_slope) {
      State<double> state = nodes_[0];
      march(0, arc_count(), state, [](int, const auto&, const auto&, const auto&) {});
      residual = sine_vector<double>(state.rotation_SB);
      equations.mismatch_is_small = is_small<D>(state.rotation_SB);
      if (std::isfinite(last)) slope_ += (residual - last_residual - slope_ * step) * step.transpose() / (last * last);
    } else {
      evaluate_segment<turns>(0, equations);
      residual = equations.residual.template head<turns>();
      slope_ = equations.arrival.template topLeftCorner<turns, turns>();
    }
    last_residual = residual;
    step = -slope_.inverse() * residual;
    const double size = step.norm();
    if (!std::isfinite(size)) return false;
    if (size > largest_turn_rad) step *= largest_turn_rad / size;
    nodes_[0].rotation_SB = turned(nodes_[0].rotation_SB, step);
    // The next step would be smaller by what this one was, or squared after fresh derivatives.
    const double shrinkage = std::isfinite(last) ? std::min(size / last, 0.1) : 0.1;
    const double next = fresh_slope ? size * shrinkage : newton_curvature * size * size;
    if (next <= tolerance) return equations.mismatch_is_small;
    fresh_slope = size < 0.4 && (!fresh_slope || size < 0.5 * last);
    last = size;
  }
  return false;
}

// All segments together. Columns: node k at k times `unknowns`; the tip's, the last, has its turns alone. Rows: the
// clamp's turns, then all for each segment k > 0.
template <int D>
bool BasicBoundaryValue<D>::newton_segments(double tolerance) {
  const auto count = static_cast<int>(segments_.size());
  constexpr int wrenches = turns + D;
  SegmentEquations equations;
  system_.resize(unknowns * count - wrenches);
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    ++newton_steps_;
    system_.set_zero();
    bool small = true;
    for (int k = 0; k < count; ++k) {
      const bool tip = k + 1 == count;
      if (tip) evaluate_segment<turns>(static_cast<std::size_t>(k), equations);
      else evaluate_segment<unknowns>(static_cast<std::size_t>(k), equations);
      small = small && equations.mismatch_is_small;
      const int column = unknowns * k;
      const int before = column - unknowns;
      const int row = k > 0 ? column - wrenches : 0;
      for (int i = 0; i < (k > 0 ? unknowns : turns); ++i) {
        system_.right()[row + i] = -equations.residual[i];
        for (int j = 0; j < (tip ? turns : unknowns); ++j) system_(row + i, column + j) = equations.arrival(i, j);
        if (k == 0) continue;
        if (i >= turns) system_(row + i, before + i) = -1;
        for (int j = 0; i < turns && j < turns; ++j) system_(row + i, before + j) = equations.mismatch_slope(i, j);
      }
    }
    if (!system_.right().allFinite() || !system_.solve() || !system_.right().allFinite()) return false;
    const double size = apply(system_.right());
    if (newton_curvature * size * size <= tolerance) return small;
  }
  return false;
}

template <int D>
bool BasicBoundaryValue<D>::newton(double tolerance) {
  return segments_.size() == 1 ? newton_one_segment(false, tolerance) : newton_segments(tolerance);
}

// The full load from the rest shape; first with a quarter of the arcs, whose derivatives then serve for all.
template <int D>
bool BasicBoundaryValue<D>::solve_at_once() {
  load_steps_ = 1;
  if (coarse_ && coarse_->segment_count() == 1 && coarse_->solve_at_once()) {
    set_load(1);
    nodes_ = coarse_->nodes_;
    slope_ = coarse_->slope_;
    newton_steps_ += coarse_->newton_steps_;
    return newton_one_segment(true, newton_tolerance_);
  }
  start_unloaded();
  set_load(1);
  return newton(newton_tolerance_);
}

// At the solution for the current load; exact, or from the derivatives that Newton's method ended with.
template <int D>
typename BasicBoundaryValue<D>::Orientation BasicBoundaryValue<D>::orientation(bool exact) {
  if (segments_.size() > 1) return {factor_, system_.log_determinant(), system_.determinant_is_negative()};
  SegmentEquations equations;
  if (exact) evaluate_segment<turns>(0, equations);
  const double determinant =
      (exact ? equations.arrival.template topLeftCorner<turns, turns>().eval() : slope_).determinant();
  return {factor_, std::log(std::abs(determinant)), determinant < 0};
}

// Arcs, poses and the base wrench from the nodes.
template <int D>
scene::Status BasicBoundaryValue<D>::finish(bool solved) {
  if (!solved) return failure_;
  struct {
    BasicBoundaryValue& self;
    void meet(int arc, const State<double>& state) const {
      self.distal_wrenches_S_[static_cast<std::size_t>(arc)] = state.wrench;
    }
    void operator()(int arc, const BasicScrew<double, D>& screw, const BasicMotion<double, D>& motion,
                    const State<double>&) const {
      self.arcs_[static_cast<std::size_t>(arc)].screw = screw;
      self.motions_[static_cast<std::size_t>(arc)] = motion;
    }
  } keep{*this};
  State<double> state;
  for (std::size_t k = segments_.size(); k-- > 0;) {
    state = nodes_[k];
    march(segments_[k].first_arc, segments_[k].end_arc, state, keep);
  }
  poses_.front() = {};
  for (std::size_t k = 0; k < arcs_.size(); ++k) poses_[k + 1] = poses_[k].then(motions_[k]);
  const bool finite = poses_.back().position_B_mm.allFinite() && state.wrench.moment_Nmm.allFinite();
  if (!finite) message_ = "a pose or wrench is not finite";
  return finite ? scene::Status::converged : scene::Status::not_finite;
}

template <int D>
scene::Status BasicBoundaryValue<D>::run() {
  load_steps_ = newton_steps_ = 0;
  previous_factor_ = 0;
  if (coarse_) coarse_->newton_steps_ = 0;
  return finish(grow_load());
}

template <int D>
scene::Status BasicBoundaryValue<D>::run_from(const BasicBoundaryValue& other) {
  segments_ = other.segments_;
  const auto here = [&](int arc) {
    return static_cast<int>(static_cast<long long>(arc) * arc_count() / other.arc_count());
  };
  for (Segment& segment : segments_) segment = {here(segment.first_arc), here(segment.end_arc)};
  nodes_ = other.nodes_;
  load_steps_ = other.load_steps_;
  newton_steps_ = other.newton_steps_;
  set_load(1);
  if (newton(newton_tolerance_)) return finish(true);
  message_ = "Newton did not converge from the solution with fewer arcs";
  return scene::Status::not_converged;
}

// The same rod, loads and solution among the rods in space.
template <int D>
BasicBoundaryValue<3> BasicBoundaryValue<D>::in_space() const {
  BasicBoundaryValue<3> rod(spans_, arcs_per_span_, law_, model_, newton_tolerance_);
  rod.segments_.clear();
  rod.nodes_.clear();
  rod.set_load(factor_);
  for (const Segment& segment : segments_) rod.segments_.push_back({segment.first_arc, segment.end_arc});
  for (const State<double>& node : nodes_) {
    BasicBoundaryValue<3>::State<double> state{Matrix3d::Identity(), {}};
    state.rotation_SB.template topLeftCorner<D, D>() = node.rotation_SB;
    state.wrench.force_N.template head<D>() = node.wrench.force_N;
    state.wrench.moment_Nmm.template tail<turns>() = node.wrench.moment_Nmm;
    rod.nodes_.push_back(state);
  }
  return rod;
}

bool agree(const Stability& a, const Stability& b) {
  return a.conjugate_points == b.conjugate_points && std::abs(a.log_determinant - b.log_determinant) < 0.25;
}

template <>
Stability BasicBoundaryValue<2>::stability() const {
  return in_space().stability();
}

// Fields of small motions that leave the tip free, started there with three turns of it, marched to the clamp and
// made the identity at each arc's end: their turn over one arc has a negative eigenvalue for each conjugate point in
// it.
template <>
Stability BasicBoundaryValue<3>::stability() const {
  using Number = Dual<3>;
  Stability result;
  State<Number> state;
  Eigen::Matrix<double, 6, 3> wrench_slopes = Eigen::Matrix<double, 6, 3>::Zero();
  for (std::size_t k = segments_.size(); k-- > 0;) {
    const auto set = [&](State<Number>& s, const State<double>& value) {
      for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          const Vector3d column = value.rotation_SB.col(axis);
          Number& entry = s.rotation_SB(i, axis);
          entry = value.rotation_SB(i, axis);
          for (int field = 0; field < 3; ++field) entry.slope[field] = -Vector3d::Unit(field).cross(column)[i];
        }
        s.wrench.force_N[i] = {value.wrench.force_N[i], wrench_slopes.row(i).transpose().array()};
        s.wrench.moment_Nmm[i] = {value.wrench.moment_Nmm[i], wrench_slopes.row(3 + i).transpose().array()};
      }
    };
    set(state, nodes_[k]);
    march(segments_[k].first_arc, segments_[k].end_arc, state, [&](int, const auto&, const auto&, State<Number>& s) {
      State<double> value;
      Matrix3d turn;
      Eigen::Matrix<double, 6, 3> slopes;
      for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis) value.rotation_SB(i, axis) = s.rotation_SB(i, axis).value;
        value.wrench.force_N[i] = s.wrench.force_N[i].value;
        value.wrench.moment_Nmm[i] = s.wrench.moment_Nmm[i].value;
        slopes.row(i) = s.wrench.force_N[i].slope.matrix().transpose();
        slopes.row(3 + i) = s.wrench.moment_Nmm[i].slope.matrix().transpose();
      }
      for (int field = 0; field < 3; ++field) {
        Matrix3d slope;
        for (int i = 0; i < 3; ++i) {
          for (int axis = 0; axis < 3; ++axis) slope(i, axis) = s.rotation_SB(i, axis).slope[field];
        }
        turn.col(field) = -sine_vector<double>(Matrix3d(slope * value.rotation_SB.transpose()));
      }
      result.conjugate_points += static_cast<int>((turn.eigenvalues().real().array() < 0).count());
      result.log_determinant += std::log(std::abs(turn.determinant()));
      wrench_slopes = slopes * turn.inverse();
      set(s, value);
    });
  }
  if (!wrench_slopes.allFinite()) result.log_determinant = std::numeric_limits<double>::quiet_NaN();
  return result;
}

template class BasicBoundaryValue<2>;
template class BasicBoundaryValue<3>;

}  // namespace fam
