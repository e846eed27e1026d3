// The kernel of fam/lanes.h, compiled once for each vector unit: FAM_UNIT names its namespace, FAM_LANES and FAM_LEVEL
// its pack. No double goes through a template here: what the linker kept of it would run on every processor.
#include "fam/lane_tendons.h"
#include "fam/load_length.h"
#include "fam/rotation.h"
#include "fam/shooting.h"

#include <limits>
#include <type_traits>
#include <vector>

namespace fam::FAM_UNIT {
namespace {

using P = Pack<FAM_LANES, FAM_LEVEL>;
using Mask = P::Mask;
namespace at = lane_number;

constexpr double largest_turn_squared = 4;  // of an arc, fam/pack.h

template <bool with_shear, int D, bool with_tendons>
class Rods {
 public:
  using Section = std::conditional_t<with_tendons, LaneTendonSection<P, with_shear>, LaneSection<P, with_shear, D>>;
  static constexpr int rotations = rotations_of(D);
  using Rotation = Eigen::Matrix<P, D, D>;
  using Slope = Eigen::Matrix<P, rotations, rotations>;
  struct Pose {
    Rotation rotation_BS = Rotation::Identity();
    Vector<P, D> position_mm = Vector<P, D>::Zero();

    Pose then(const BasicMotion<P, D>& motion) const {
      Pose next{rotation_BS, position_mm + rotation_BS * motion.position_mm};
      turn_rows(next.rotation_BS, [&](const Vector<P, D>& row) { return motion.rotate_back(row); });
      return next;
    }
    Vector<P, D> position_before(const BasicMotion<P, D>& motion) const {
      Rotation before = rotation_BS;
      turn_rows(before, [&](const Vector<P, D>& row) { return motion.rotate(row); });
      return position_mm - before * motion.position_mm;
    }
  };

  explicit Rods(const LaneRods& rods)
      : rods_(rods),
        numbers_(static_cast<std::size_t>(rods.numbers) * rods.spans.size()),
        motions_(static_cast<std::size_t>(rods.arc_count)) {
    if (!rods.estimate) return;
    halves_.resize(motions_.size());
    finer_.resize(2 * motions_.size());
  }

  void solve(const double* values, const std::ptrdiff_t* rows, int count, LaneTip* tips) {
    set(values, rows, count);
    Mask solved = is_within_bounds();
    largest_swing_squared_ = P(0);
    twist_rad_ = P(0);
    shortest_tendon_ = P(1);
    Rotation tip = Rotation::Identity();
    Slope inverse;
    if (!rods_.march) {
      start(tip, inverse);
      solved &= newton(tip, inverse, 1, solved);
    }
    place(tip, motions_, 1);
    Pose pose;
    for (const BasicMotion<P, D>& motion : motions_) pose = pose.then(motion);
    P error_mm(0);
    if (rods_.estimate) {
      if (!rods_.march) solved &= newton(tip, inverse, 2, solved);
      place(tip, finer_, 2);
      error_mm = estimate_mm();
      solved &= error_mm < P(std::numeric_limits<double>::infinity());
    }
    solved &= P(0) < shortest_tendon_;
    const double limit = rods_.largest_swing_rad * rods_.largest_swing_rad;
    solved &= largest_swing_squared_ < P(limit < largest_turn_squared ? limit : largest_turn_squared);
    tell(pose, error_mm, solved, rows, count, tips);
  }

 private:
  template <class Turn>
  static void turn_rows(Rotation& rotation, Turn&& turn) {
    for (int row = 0; row < D; ++row) rotation.row(row) = turn(Vector<P, D>(rotation.row(row).transpose())).transpose();
  }
  const P* numbers(std::size_t span) const { return &numbers_[static_cast<std::size_t>(rods_.numbers) * span]; }

  // The last lanes of an incomplete pack repeat its first row.
  void set(const double* values, const std::ptrdiff_t* rows, int count) {
    for (std::size_t i = 0; i < rods_.spans.size(); ++i) {
      P* const numbers = &numbers_[static_cast<std::size_t>(rods_.numbers) * i];
      for (int k = 0; k < rods_.numbers; ++k) numbers[k] = P(rods_.spans[i].numbers[k]);
    }
    for (const LaneTerm& term : rods_.terms) {
      P value;
      for (int lane = 0; lane < FAM_LANES; ++lane) {
        value.value[lane] = values[rows[lane < count ? lane : 0] * rods_.row_stride + term.column];
      }
      numbers_[static_cast<std::size_t>(rods_.numbers * term.span + term.number)] += P(term.slope) * value;
    }
  }

  // Arcs short enough for the law's series, and of boundary values one equilibrium (fam/shooting.h).
  Mask is_within_bounds() const {
    P force(0), moment(0), convexity(0), force_beyond(0), by_moments(0), turn(0), strain(0), longest(0);
    P arms(0), arms_turn(0), moment_trace(0), moment_squares(0);
    for (std::size_t i = rods_.spans.size(); i-- > 0;) {
      const LaneSpan& span = rods_.spans[i];
      const P* n = numbers(i);
      force += norm(n + at::follower_force) + norm(n + at::fixed_force);
      moment += norm(n + at::follower_moment) + norm(n + at::fixed_moment);
      P squares(0);
      for (int k = 0; k < 9; ++k) squares += n[at::fixed_force_arms + k] * n[at::fixed_force_arms + k];
      moment += sqrt(squares);
      arms += sqrt(squares);
      const P on_arc = norm(n + at::distributed_follower) + norm(n + at::distributed_fixed);
      const P h(span.arc_length_mm), arcs(span.arcs);
      const bool whole = rods_.march && !span.distributed;
      for (int arc = 0; arc < (whole ? 1 : span.arcs); ++arc) {
        force += on_arc;
        const double cell_mm = span.arc_length_mm * (whole ? span.arcs : 1);
        const double before_mm = whole ? 0 : span.arc_length_mm * (span.arcs - 1 - arc);
        const double to_clamp = span.compliance_to_clamp_per_Nmm + before_mm / span.buckling_stiffness_Nmm2;
        convexity += convexity_share(force, force_beyond, to_clamp, cell_mm, span.buckling_stiffness_Nmm2);
        const P by_forces = force_beyond + force * P(cell_mm) + arms;
        const P square = by_forces * by_forces * P(1 / span.buckling_stiffness_Nmm2);
        moment_trace += convexity_share(square, moment_squares, to_clamp, cell_mm, span.buckling_stiffness_Nmm2);
        moment_squares += square * P(cell_mm);
        force_beyond += force * P(cell_mm);
      }
      if (D == 3) by_moments += arcs * h * moment * P(span.spin_rate_per_Nmm2);
      turn += arcs * h * moment * P(1 / span.least_stiffness_Nmm2) + P(span.rest_turn_rad);
      P tensions(0);
      if constexpr (with_tendons) {
        const Vector<P, 3> bending = tendon_moment(span, n, tensions);
        turn += arcs * h * sqrt(bending.dot(bending)) * P(1 / span.least_stiffness_Nmm2);
      }
      arms_turn += arcs * h * arms * P(1 / span.buckling_stiffness_Nmm2);
      strain = larger(strain, (force + tensions) * P(span.linear_compliance_per_N));
      longest = larger(longest, h * h * force * P(1 / span.least_stiffness_Nmm2));
    }
    Mask within = longest <= P(rods_.longest_load_length * rods_.longest_load_length);
    if (rods_.march) return within;
    const P unique_length = sqrt(sqrt(P(6) * convexity)) + by_moments;
    Mask one = unique_length * unique_length <= P(unique_length_squared) * (P(1) - arms_turn);
    if (D == 3) one &= turn <= P(unique_turn_rad);
    if (D == 3 && rods_.conservative) one |= sqrt(convexity) + sqrt(sqrt(moment_trace)) + arms_turn < P(1);
    within &= one;
    if (with_shear) within &= strain <= P(unique_strain);
    return within;
  }

  // That tendons along the tangent leave to the rod, -r x T e_x, and the sum of their tensions.
  static Vector<P, 3> tendon_moment(const LaneSpan& span, const P* numbers, P& tensions_N) {
    Vector<P, 3> sum = Vector<P, 3>::Zero();
    for (int i = 0; i < span.tendons; ++i) {
      const P tension_N = numbers[at::tension + i];
      sum[1] -= tension_N * P(span.tendon_z_mm[i]);
      sum[2] += tension_N * P(span.tendon_y_mm[i]);
      tensions_N += tension_N;
    }
    return sum;
  }

  // The rest shape, tendons that bend it included, and the derivatives there: a turn of the tip turns the clamp.
  void start(Rotation& tip_SB, Slope& inverse) const {
    P numbers[9];
    for (int k = 0; k < 9; ++k) numbers[k] = P(rods_.rest_tip_rotation_SB[k]);
    tip_SB = matrix_at<D>(numbers);
    if constexpr (with_tendons) {
      tip_SB.setIdentity();
      for (std::size_t i = 0; i < rods_.spans.size(); ++i) {
        const Angular<P, D> turn = turn_at<D>(this->numbers(i) + at::rest_rotation);
        for (int arc = 0; arc < rods_.spans[i].arcs; ++arc) tip_SB = turned(tip_SB, turn);
      }
    }
    if constexpr (D == 3) inverse = -tip_SB;
    else inverse(0, 0) = P(-1);
  }

  // From the tip to the clamp over arcs `finer` times as many; meet(arc, section, distal wrench, screw, motion).
  template <bool turns, class Meet>
  FAM_FLATTEN void march(Rotation& rotation_SB, int finer, Meet&& meet) const {
    BasicWrench<P, D> wrench;
    int k = finer * rods_.arc_count;
    for (std::size_t i = rods_.spans.size(); i-- > 0;) {
      const LaneSpan& span = rods_.spans[i];
      const P* n = numbers(i);
      add_point_loads<turns>(n, rotation_SB, wrench);
      const P part(1.0 / finer);
      Section section(span, n, 1.0 / finer);
      const Vector<P, D> follower = part * vector_at<D>(n + at::distributed_follower);
      for (int arc = 0; arc < finer * span.arcs; ++arc) {
        const BasicWrench<P, D> distal = wrench;
        BasicScrew<P, D> screw;
        ArcForces<P, D> forces;
        if (span.distributed) {
          forces = {follower, Vector<P, D>::Zero()};
          if (turns) forces.fixed_D_N = rotation_SB * Vector<P, D>(part * vector_at<D>(n + at::distributed_fixed));
        }
        const BasicMotion<P, D> motion = sixth_order_step(section, span.distributed ? &forces : nullptr, wrench, screw);
        for (int axis = 0; turns && axis < D; ++axis)
          rotation_SB.col(axis) = motion.rotate(Vector<P, D>(rotation_SB.col(axis)));
        meet(static_cast<std::size_t>(--k), section, span.distributed ? &forces : nullptr, distal, screw, motion, span);
      }
    }
  }

  template <bool turns>
  static void add_point_loads(const P* n, const Rotation& rotation_SB, BasicWrench<P, D>& wrench) {
    wrench.force_N += vector_at<D>(n + at::follower_force);
    wrench.moment_Nmm += turn_at<D>(n + at::follower_moment);
    if (!turns) return;
    wrench.force_N += rotation_SB * vector_at<D>(n + at::fixed_force);
    if constexpr (D == 3) wrench.moment_Nmm += rotation_SB * turn_at<D>(n + at::fixed_moment);
    else wrench.moment_Nmm += turn_at<D>(n + at::fixed_moment);
    const Rotation arms_S = rotation_SB * matrix_at<D>(n + at::fixed_force_arms);
    wrench.moment_Nmm += P(2) * sine_vector(arms_S);
  }

  // Newton's method on the tip's rotation with Broyden's secants; the lanes where it ends at round-off: those of
  // another unit, which rounds otherwise, must end at the same place.
  Mask newton(Rotation& tip_SB, Slope& inverse, int finer, Mask active) const {
    Angular<P, D> step = Angular<P, D>::Zero(), last_residual = step;
    P last(std::numeric_limits<double>::min()), last_shrinkage(0.1);
    Mask solved = active & ~active;
    for (int iteration = 0; iteration < max_newton_steps && P::any(active); ++iteration) {
      Rotation clamp_SB = tip_SB;
      march<true>(clamp_SB, finer, [](auto&&...) {});
      const Angular<P, D> residual = sine_vector(clamp_SB);
      if (iteration > 0) {
        const Angular<P, D> moved = inverse * (residual - last_residual);
        const Eigen::Matrix<P, 1, rotations> row = step.transpose() * inverse;
        const P scale = select(active, P(1) / step.dot(moved), P(0));
        inverse += scale * (step - moved) * row;
      }
      last_residual = residual;
      step = -(inverse * residual);
      const P size = sqrt(step.dot(step));
      step *= select(P(largest_newton_turn_rad) < size, P(largest_newton_turn_rad) / size, P(1));
      const Rotation turned_SB = turned(tip_SB, step);
      for (int k = 0; k < D * D; ++k) tip_SB(k) = select(active, turned_SB(k), tip_SB(k));
      const P shrinkage = smaller(size / last, P(1));
      const Mask ends = active & (size * larger(shrinkage, last_shrinkage) <= P(tightest_newton_tolerance));
      solved |= ends & (P(D - 2) < clamp_SB.trace());
      active &= ~ends & (size < P(std::numeric_limits<double>::infinity()));
      last_shrinkage = iteration > 0 ? shrinkage : P(0.1);
      last = size;
    }
    return solved;
  }
  static Rotation turned(const Rotation& rotation_SB, const Angular<P, D>& turn) {
    const BasicMotion<P, D> motion = exponential(BasicScrew<P, D>{turn, Vector<P, D>::Zero()});
    Rotation result;
    for (int axis = 0; axis < D; ++axis) result.col(axis) = motion.rotate_back(Vector<P, D>(rotation_SB.col(axis)));
    return result;
  }

  // The motions of the arcs, and beside the coarse ones those of their distal halves.
  void place(const Rotation& tip_SB, std::vector<BasicMotion<P, D>>& motions, int finer) {
    Rotation rotation_SB = tip_SB;
    const auto keep = [&](std::size_t arc, Section& section, const ArcForces<P, D>* forces,
                          const BasicWrench<P, D>& distal, const BasicScrew<P, D>& screw,
                          const BasicMotion<P, D>& motion, const LaneSpan& span) {
      motions[arc] = motion;
      if (finer > 1) return;
      largest_swing_squared_ = larger(section.swing_squared(screw), largest_swing_squared_);
      shortest_tendon_ = smaller(section.tendon_stretch(screw, span), shortest_tendon_);
      if (rods_.round) twist_rad_ += P(span.twist_per_Nmm2 * span.arc_length_mm) * distal.moment_Nmm[0];
      if (rods_.estimate) halves_[arc] = distal_half(section, forces, distal);
    };
    if (rods_.march) march<false>(rotation_SB, finer, keep);
    else march<true>(rotation_SB, finer, keep);
  }

  FAM_FLATTEN static BasicMotion<P, D> distal_half(Section& section, const ArcForces<P, D>* forces,
                                                   const BasicWrench<P, D>& distal) {
    auto s = rod_series<6>(section, forces, distal);
    double power = 0.5;
    for (std::size_t k = 0; k < 6; ++k, power /= 2) {
      s.rotation[k] *= P(power);
      if (with_shear || k == 0) s.translation_mm[k] *= P(power);
    }
    return exponential(magnus<with_shear>(s));
  }

  // As estimate_by_doubling_mm, without what the model leaves out.
  P estimate_mm() const {
    P largest(0);
    Pose coarse, fine;
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      coarse = coarse.then(motions_[k]);
      fine = fine.then(finer_[2 * k]);
      const Vector<P, D> middle = coarse.position_before(halves_[k]) - fine.position_mm;
      fine = fine.then(finer_[2 * k + 1]);
      const Vector<P, D> end = coarse.position_mm - fine.position_mm;
      largest = larger(larger(middle.dot(middle), end.dot(end)), largest);
    }
    const P round_off_mm = P(4 * std::numeric_limits<double>::epsilon() * rods_.length_mm) * sqrt(P(rods_.arc_count));
    return P(64. / 63) * sqrt(largest) + round_off_mm;
  }

  void tell(const Pose& pose, const P& error_mm, const Mask& solved, const std::ptrdiff_t* rows, int count,
            LaneTip* tips) const {
    const Vector3<P> position_mm = in_base(pose.position_mm);
    Eigen::Matrix<P, 3, 3> rotation = Eigen::Matrix<P, 3, 3>::Identity();
    for (int row = 0; row < D; ++row) {
      for (int column = 0; column < D; ++column) rotation(row, column) = pose.rotation_BS(row, column);
    }
    const Eigen::Matrix<P, 4, 1> q = quaternion_wxyz(rotation);
    const Vector3<P> axis = in_base(Vector<P, 3>(q[1], q[2], q[3]));
    const Mask finite = position_mm.dot(position_mm) < P(std::numeric_limits<double>::infinity());
    for (int lane = 0; lane < count; ++lane) {
      LaneTip& tip = tips[rows[lane]];
      for (int i = 0; i < 3; ++i) tip.position_mm[i] = position_mm[i].value[lane];
      tip.rotation_wxyz[0] = q[0].value[lane];
      for (int i = 0; i < 3; ++i) tip.rotation_wxyz[i + 1] = axis[i].value[lane];
      tip.twist_rad = twist_rad_.value[lane];
      tip.error_mm = error_mm.value[lane];
      tip.solved = (solved & finite)[lane] != 0;
    }
  }
  template <int size>
  Vector3<P> in_base(const Eigen::Matrix<P, size, 1>& v) const {
    Vector3<P> result = Vector3<P>::Zero();
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < size; ++i) result[row] += P(rods_.rotation_BP[3 * row + i]) * v[i];
    }
    return result;
  }

  const LaneRods& rods_;
  std::vector<P> numbers_;
  std::vector<BasicMotion<P, D>> motions_, halves_, finer_;
  P largest_swing_squared_, twist_rad_, shortest_tendon_;
};

template <bool with_shear, int D, bool with_tendons = false>
void solve(const LaneRods& rods, const double* values, std::span<const std::ptrdiff_t> rows, LaneTip* tips) {
  Rods<with_shear, D, with_tendons> kernel(rods);
  const std::ptrdiff_t* const end = rows.data() + rows.size();
  for (const std::ptrdiff_t* row = rows.data(); row < end; row += FAM_LANES) {
    kernel.solve(values, row, end - row < FAM_LANES ? static_cast<int>(end - row) : FAM_LANES, tips);
  }
}

}  // namespace

void solve_lanes(const LaneRods& rods, const double* values, std::span<const std::ptrdiff_t> rows, LaneTip* tips) {
  if (rods.planar) return (rods.reissner ? solve<true, 2> : solve<false, 2>)(rods, values, rows, tips);
  if (rods.numbers > at::tension)
    return (rods.reissner ? solve<true, 3, true> : solve<false, 3, true>)(rods, values, rows, tips);
  return (rods.reissner ? solve<true, 3> : solve<false, 3>)(rods, values, rows, tips);
}

}  // namespace fam::FAM_UNIT
