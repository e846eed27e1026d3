#include "fam/boundary_value.h"

#include "fam/dual.h"
#include "fam/scene_facts.h"

#include <Eigen/Dense>
#include <Eigen/SparseLU>

#include <algorithm>
#include <limits>

namespace fam {
namespace {

// v with sin(angle) * axis of a rotation matrix; monotone up to a quarter turn.
template <class T>
Vector3<T> sine_vector(const Eigen::Matrix<T, 3, 3>& rotation) {
  return T(0.5) *
         Vector3<T>(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0), rotation(1, 0) - rotation(0, 1));
}

Vector3d rotation_vector(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Matrix3d rotation_matrix(const Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Matrix3d::Identity();
}

// Turns a section by a small rotation given in its own frame: the base axes turn back.
Matrix3d turned(const Matrix3d& rotation_SB, const Vector3d& turn_S) {
  return rotation_matrix(turn_S).transpose() * rotation_SB;
}

template <bool with_shear, class T>
BasicMotion<T> law_step(Law law, const ArcConstants& constants, const ArcForces<T>* distributed, BasicWrench<T>& wrench,
                        BasicScrew<T>& screw) {
  if (law == Law::midpoint) {
    return distributed ? midpoint_step<with_shear>(constants, *distributed, wrench, screw)
                       : midpoint_step<with_shear>(constants, wrench, screw);
  }
  return distributed ? fourth_order_step<with_shear>(constants, *distributed, wrench, screw)
                     : fourth_order_step<with_shear>(constants, wrench, screw);
}

// The same with every call inlined: twice as fast, but for many derivatives minutes to compile.
template <bool with_shear, class T>
FAM_FLATTEN BasicMotion<T> flat_step(Law law, const ArcConstants& constants, const ArcForces<T>* distributed,
                                     BasicWrench<T>& wrench, BasicScrew<T>& screw) {
  return law_step<with_shear>(law, constants, distributed, wrench, screw);
}

}  // namespace

BoundaryValue::BoundaryValue(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law,
                             RodModel model, double newton_tolerance)
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
    SpanArcs& arcs = span_arcs_.emplace_back();
    arcs.first_arc = first_arc;
    arcs.end_arc = first_arc += arcs_per_span_[i];
    arcs.distributed = !spans_[i].follower_force_S_N_per_mm.isZero(0) || !spans_[i].fixed_force_B_N_per_mm.isZero(0);
  }
  arcs_.resize(static_cast<std::size_t>(first_arc));
  poses_.resize(arcs_.size() + 1);
  cut_into_segments();
  if (!one_equilibrium() || arc_count() < 4 * static_cast<int>(spans_.size())) return;
  std::vector<int> few = arcs_per_span_;
  for (int& count : few) count = std::max(1, count / 4);
  coarse_ = std::make_unique<BoundaryValue>(spans_, few, law_, model_, 1e-3);
}

bool BoundaryValue::one_equilibrium() const {
  return total_growth_ * total_growth_ <= unique_load && total_turn_rad_ <= largest_turn_rad;
}

void BoundaryValue::cut_into_segments() {
  double force = 0;
  double moment = 0;
  double since_cut = 0;
  const bool planar = is_planar(spans_);
  int end_arc = arc_count();
  for (std::size_t i = spans_.size(); i-- > 0;) {
    const scene::Span& span = spans_[i];
    force += span.follower_load_S.force_N.norm() + span.fixed_load_B.force_N.norm();
    moment += span.follower_load_S.moment_Nmm.norm() + span.fixed_load_B.moment_Nmm.norm();
    const double per_mm = span.follower_force_S_N_per_mm.norm() + span.fixed_force_B_N_per_mm.norm();
    const double h = span.length_mm() / arcs_per_span_[i];
    for (int arc = span_arcs_[i].end_arc; arc-- > span_arcs_[i].first_arc;) {
      force += per_mm * h;
      const double stiffness = planar ? span.stiffness.bending_Nmm2.minCoeff() : least_stiffness_Nmm2(span);
      const double growth = h * std::sqrt(force / stiffness);
      total_growth_ += growth;
      total_turn_rad_ += h * moment / least_stiffness_Nmm2(span);
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

void BoundaryValue::set_load(double factor) {
  factor_ = factor;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const scene::Span& span = spans_[i];
    SpanArcs& arcs = span_arcs_[i];
    arcs.constants = arc_constants(span, arcs_per_span_[i], model_, factor);
    arcs.follower_load_S = {factor * span.follower_load_S.force_N, factor * span.follower_load_S.moment_Nmm};
    arcs.fixed_load_B = {factor * span.fixed_load_B.force_N, factor * span.fixed_load_B.moment_Nmm};
    arcs.follower_force_S_N = factor * arcs.constants.length_mm * span.follower_force_S_N_per_mm;
    arcs.fixed_force_B_N = factor * arcs.constants.length_mm * span.fixed_force_B_N_per_mm;
  }
}

// March over arcs end_arc-1 .. first_arc; after_arc(index, screw, state) sees each proximal end.
template <bool with_shear, class T, class After>
void BoundaryValue::march_law(int first_arc, int end_arc, State<T>& state, After&& after_arc) const {
  auto span = std::upper_bound(span_arcs_.begin(), span_arcs_.end(), end_arc - 1,
                               [](int arc, const SpanArcs& s) { return arc < s.first_arc; });
  while (end_arc > first_arc) {
    --span;
    if (end_arc == span->end_arc) {
      state.wrench.force_N += span->follower_load_S.force_N.template cast<T>() +
                              state.rotation_SB * span->fixed_load_B.force_N.template cast<T>();
      state.wrench.moment_Nmm += span->follower_load_S.moment_Nmm.template cast<T>() +
                                 state.rotation_SB * span->fixed_load_B.moment_Nmm.template cast<T>();
    }
    for (int arc = end_arc; arc-- > std::max(first_arc, span->first_arc);) {
      BasicScrew<T> screw;
      BasicMotion<T> motion;
      const ArcForces<T> forces{span->follower_force_S_N.template cast<T>(),
                                span->distributed
                                    ? Vector3<T>(state.rotation_SB * span->fixed_force_B_N.template cast<T>())
                                    : Vector3<T>(Vector3<T>::Zero())};
      const ArcForces<T>* distributed = span->distributed ? &forces : nullptr;
      if constexpr (sizeof(T) <= sizeof(Dual<3>)) {
        motion = flat_step<with_shear>(law_, span->constants, distributed, state.wrench, screw);
      } else {
        motion = law_step<with_shear>(law_, span->constants, distributed, state.wrench, screw);
      }
      for (int axis = 0; axis < 3; ++axis) {
        state.rotation_SB.col(axis) = motion.rotate(Vector3<T>(state.rotation_SB.col(axis)));
      }
      after_arc(arc, screw, state);
    }
    end_arc = std::max(first_arc, span->first_arc);
  }
}

template <class T, class After>
void BoundaryValue::march(int first_arc, int end_arc, State<T>& state, After&& after_arc) const {
  if (model_ == RodModel::reissner) march_law<true>(first_arc, end_arc, state, after_arc);
  else march_law<false>(first_arc, end_arc, state, after_arc);
}

// The rest shape: march without load from a tip turned so that the clamp has R = I.
void BoundaryValue::start_unloaded() {
  set_load(0);
  State<double> tip{Matrix3d::Identity(), {}};
  const auto nothing = [](int, const auto&, const auto&) {};
  State<double> clamp = tip;
  march(0, arc_count(), clamp, nothing);
  tip.rotation_SB = clamp.rotation_SB.transpose();
  for (std::size_t k = segments_.size(); k-- > 0;) {
    nodes_[k] = tip;
    march(segments_[k].first_arc, segments_[k].end_arc, tip, nothing);
  }
}

// Residual and derivatives of segment k with respect to the N unknowns of its node: 3 at the tip, 9 elsewhere.
template <int N>
void BoundaryValue::evaluate_segment(std::size_t k, SegmentEquations& equations) const {
  using Number = Dual<N>;
  const double force_unit = bending_Nmm2_ / (length_mm_ * length_mm_);
  const double moment_unit = bending_Nmm2_ / length_mm_;
  const State<double>& node = nodes_[k];
  State<Number> state{node.rotation_SB.template cast<Number>(),
                      {node.wrench.force_N.template cast<Number>(), node.wrench.moment_Nmm.template cast<Number>()}};
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {  // turning the section by e_i turns the base axes in it by -e_i
      const Vector3d slope = -Vector3d::Unit(i).cross(Vector3d(node.rotation_SB.col(axis)));
      for (int row = 0; row < 3; ++row) state.rotation_SB(row, axis).slope[i] = slope[row];
    }
    if constexpr (N == 9) {
      state.wrench.force_N[i].slope[3 + i] = force_unit;
      state.wrench.moment_Nmm[i].slope[6 + i] = moment_unit;
    }
  }
  march(segments_[k].first_arc, segments_[k].end_arc, state, [](int, const auto&, const auto&) {});

  const Matrix3d target_SB = k > 0 ? nodes_[k - 1].rotation_SB : Matrix3d::Identity();
  const Eigen::Matrix<Number, 3, 3> mismatch = state.rotation_SB * target_SB.transpose().cast<Number>();
  Eigen::Matrix<Number, 9, 1> residual;
  residual << sine_vector(mismatch), state.wrench.force_N, state.wrench.moment_Nmm;
  if (k > 0) {
    residual.template segment<3>(3) -= nodes_[k - 1].wrench.force_N.template cast<Number>();
    residual.template segment<3>(6) -= nodes_[k - 1].wrench.moment_Nmm.template cast<Number>();
  }
  Matrix3d values;
  for (int i = 0; i < 9; ++i) values(i) = mismatch(i).value;
  equations.mismatch_slope = 0.5 * (values.trace() * Matrix3d::Identity() - values.transpose());
  for (int i = 0; i < 9; ++i) {
    const double unit = i < 3 ? 1 : i < 6 ? force_unit : moment_unit;
    equations.residual[i] = residual[i].value / unit;
    equations.arrival.row(i).template head<N>() = residual[i].slope.matrix().transpose() / unit;
  }
}

// Moves the nodes; the largest change of an unknown.
double BoundaryValue::apply(const Eigen::VectorXd& step) {
  const double force_unit = bending_Nmm2_ / (length_mm_ * length_mm_);
  const double moment_unit = bending_Nmm2_ / length_mm_;
  double largest_turn = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    largest_turn = std::max(largest_turn, step.segment<3>(static_cast<Eigen::Index>(9 * k)).norm());
  }
  const double shorten = largest_turn > largest_turn_rad ? largest_turn_rad / largest_turn : 1;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(9 * k);
    nodes_[k].rotation_SB = turned(nodes_[k].rotation_SB, shorten * step.segment<3>(at));
    if (k + 1 == nodes_.size()) break;
    nodes_[k].wrench.force_N += shorten * force_unit * step.segment<3>(at + 3);
    nodes_[k].wrench.moment_Nmm += shorten * moment_unit * step.segment<3>(at + 6);
  }
  return step.cwiseAbs().maxCoeff();
}

// One segment: three unknowns on the stack. Derivatives are kept while they still shrink the steps tenfold; slope_
// holds them between calls, `fresh_slope` says whether it does at the start.
bool BoundaryValue::newton_one_segment(bool fresh_slope) {
  SegmentEquations equations;
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    ++newton_steps_;
    Vector3d residual;
    if (fresh_slope) {
      State<double> state = nodes_[0];
      march(0, arc_count(), state, [](int, const auto&, const auto&) {});
      residual = sine_vector(state.rotation_SB);
    } else {
      evaluate_segment<3>(0, equations);
      residual = equations.residual.head<3>();
      slope_.compute(equations.arrival.topLeftCorner<3, 3>());
    }
    Vector3d step = -slope_.solve(residual);
    const double size = step.norm();
    if (!std::isfinite(size)) return false;
    if (size > largest_turn_rad) step *= largest_turn_rad / size;
    nodes_[0].rotation_SB = turned(nodes_[0].rotation_SB, step);
    // The next step would be smaller by what this one was, or squared after fresh derivatives.
    const double next = fresh_slope ? size * std::min(size / last, 0.1) : size * size;
    if (next <= newton_tolerance_) return true;
    fresh_slope = size < 0.1 && (!fresh_slope || size < 0.1 * last);
    last = size;
  }
  return false;
}

// All segments together. Columns: node k at 9 k; the tip's, the last, has 3. Rows: the clamp's 3, then 9 for each
// segment k > 0.
bool BoundaryValue::newton_segments() {
  const auto count = static_cast<int>(segments_.size());
  Eigen::VectorXd residual(9 * count - 6);
  Eigen::SparseMatrix<double> matrix(9 * count - 6, 9 * count - 6);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu;
  std::vector<Eigen::Triplet<double>> entries;
  SegmentEquations equations;
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    ++newton_steps_;
    entries.clear();
    for (int k = 0; k < count; ++k) {
      const bool tip = k + 1 == count;
      if (tip) evaluate_segment<3>(static_cast<std::size_t>(k), equations);
      else evaluate_segment<9>(static_cast<std::size_t>(k), equations);
      const int column = 9 * k;
      const int row = k > 0 ? column - 6 : 0;
      for (int i = 0; i < (k > 0 ? 9 : 3); ++i) {
        residual[row + i] = equations.residual[i];
        for (int j = 0; j < (tip ? 3 : 9); ++j) entries.emplace_back(row + i, column + j, equations.arrival(i, j));
        if (k == 0) continue;
        if (i >= 3) entries.emplace_back(row + i, column - 9 + i, -1.0);
        for (int j = 0; i < 3 && j < 3; ++j)
          entries.emplace_back(row + i, column - 9 + j, equations.mismatch_slope(i, j));
      }
    }
    if (!residual.allFinite()) return false;
    matrix.setFromTriplets(entries.begin(), entries.end());
    lu.compute(matrix);
    if (lu.info() != Eigen::Success) return false;
    const Eigen::VectorXd step = -lu.solve(residual);
    if (!step.allFinite()) return false;
    const double size = apply(step);
    if (size * size <= newton_tolerance_) return true;
  }
  return false;
}

bool BoundaryValue::newton() {
  return segments_.size() == 1 ? newton_one_segment(false) : newton_segments();
}

// Where the last two loads point: rotations along their relative turn, wrenches along their difference.
std::vector<BoundaryValue::State<double>> BoundaryValue::predict(double factor) const {
  std::vector<State<double>> guess = nodes_;
  if (load_steps_ == 0) return guess;
  const double ahead = (factor - factor_) / (factor_ - previous_factor_);
  for (std::size_t k = 0; k < guess.size(); ++k) {
    // R_B,new = R_B,now exp(turn): base axes in the section turn back.
    const Vector3d turn = rotation_vector(previous_[k].rotation_SB * nodes_[k].rotation_SB.transpose());
    guess[k].rotation_SB = turned(nodes_[k].rotation_SB, ahead * turn);
    guess[k].wrench.force_N += ahead * (nodes_[k].wrench.force_N - previous_[k].wrench.force_N);
    guess[k].wrench.moment_Nmm += ahead * (nodes_[k].wrench.moment_Nmm - previous_[k].wrench.moment_Nmm);
  }
  return guess;
}

// The full load from the rest shape; first with a quarter of the arcs, whose derivatives then serve for all.
bool BoundaryValue::solve_at_once() {
  set_load(1);
  load_steps_ = 1;
  if (!coarse_ || coarse_->segment_count() != 1) return newton();
  coarse_->start_unloaded();
  if (!coarse_->solve_at_once()) return newton();
  nodes_ = coarse_->nodes_;
  slope_ = coarse_->slope_;
  newton_steps_ += coarse_->newton_steps_;
  return newton_one_segment(true);
}

bool BoundaryValue::grow_load() {
  if (one_equilibrium()) {
    if (solve_at_once()) return true;
    start_unloaded();
    load_steps_ = 0;
  }
  bool watch_stability = conservative(spans_);
  double step = std::min(1.0, std::max(0.02, 1 / (total_growth_ * total_growth_ + total_turn_rad_)));
  while (factor_ < 1) {
    const double from = factor_;
    const double to = 1 - from <= 1.001 * step ? 1 : from + step;
    const std::vector<State<double>> start = nodes_;
    const std::vector<State<double>> guess = predict(to);
    nodes_ = guess;
    set_load(to);
    bool accepted = newton();
    double turn = 0;
    double surprise = 0;
    for (std::size_t k = 0; accepted && k < nodes_.size(); ++k) {
      turn = std::max(turn, rotation_vector(nodes_[k].rotation_SB * start[k].rotation_SB.transpose()).norm());
      surprise = std::max(surprise, rotation_vector(nodes_[k].rotation_SB * guess[k].rotation_SB.transpose()).norm());
    }
    if (accepted && watch_stability && stable() == false) {
      if (to - from > smallest_bifurcation_step) accepted = false;
      else watch_stability = false;
    }
    const double allowed_surprise = load_steps_ == 0 ? largest_turn_rad / 2 : largest_surprise_rad;
    accepted = accepted && turn <= largest_turn_rad && surprise <= allowed_surprise;
    if (accepted) {
      previous_ = start;
      previous_factor_ = from;
      ++load_steps_;
      step *= surprise < allowed_surprise / 4 ? 2 : 1.2;
    } else {
      nodes_ = start;
      set_load(from);
      step = (to - from) / 2;
      if (step < smallest_load_step) {
        message_ = "the load step fell below " + std::to_string(smallest_load_step) + " at " +
                   std::to_string(100 * factor_) + " % of the load";
        return false;
      }
    }
  }
  return true;
}

// Arcs, poses and the base wrench from the nodes.
scene::Status BoundaryValue::finish(bool solved) {
  if (!solved) return scene::Status::load_step_too_small;
  State<double> state;
  for (std::size_t k = segments_.size(); k-- > 0;) {
    state = nodes_[k];
    march(segments_[k].first_arc, segments_[k].end_arc, state,
          [this](int arc, const Screw& screw, const auto&) { arcs_[static_cast<std::size_t>(arc)].screw = screw; });
  }
  const scene::Wrench& tendon = spans_.front().tendon_S;
  base_wrench_ = {state.wrench.force_N + tendon.force_N, state.wrench.moment_Nmm + tendon.moment_Nmm};
  poses_.front() = SectionPose{};
  for (std::size_t k = 0; k < arcs_.size(); ++k) poses_[k + 1] = poses_[k].then(exponential(arcs_[k].screw));
  const bool finite = poses_.back().position_B_mm.allFinite() && base_wrench_.moment_Nmm.allFinite();
  if (!finite) message_ = "a pose or wrench is not finite";
  return finite ? scene::Status::converged : scene::Status::not_finite;
}

scene::Status BoundaryValue::run() {
  load_steps_ = newton_steps_ = 0;
  previous_factor_ = 0;
  if (coarse_) coarse_->newton_steps_ = 0;
  start_unloaded();
  return finish(grow_load());
}

scene::Status BoundaryValue::run_from(const BoundaryValue& half_as_many) {
  segments_ = half_as_many.segments_;
  for (Segment& segment : segments_) segment = {2 * segment.first_arc, 2 * segment.end_arc};
  nodes_ = half_as_many.nodes_;
  load_steps_ = half_as_many.load_steps_;
  newton_steps_ = half_as_many.newton_steps_;
  set_load(1);
  if (newton()) return finish(true);
  message_ = "Newton did not converge from the solution with half as many arcs";
  return scene::Status::not_converged;
}

// Fields of small motions that leave the tip free, started there with three turns of it, marched to the clamp and
// made the identity at each arc's end: their turn over one arc has a negative eigenvalue for each conjugate point in
// it.
std::optional<bool> BoundaryValue::stable() const {
  using Number = Dual<3>;
  int conjugate_points = 0;
  double nearest = 1;  // eigenvalue over the last arc: 0 at a conjugate point at the clamp
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
    march(segments_[k].first_arc, segments_[k].end_arc, state, [&](int, const auto&, State<Number>& s) {
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
        turn.col(field) = -sine_vector<double>(slope * value.rotation_SB.transpose());
      }
      const auto eigenvalues = turn.eigenvalues().real().eval();
      conjugate_points += static_cast<int>((eigenvalues.array() < 0).count());
      nearest = eigenvalues.cwiseAbs().minCoeff();
      wrench_slopes = slopes * turn.inverse();
      set(s, value);
    });
  }
  if (!wrench_slopes.allFinite() || nearest < 1e-9) return std::nullopt;
  return conjugate_points == 0;
}

}  // namespace fam
