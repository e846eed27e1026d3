#include "studies/methods/rk4_shooting.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotation_of(const Rk4Shooting::State& y) {
  const double w = y[0], x = y[1], v = y[2], z = y[3];
  Matrix3d rotation;
  rotation << 1 - 2 * (v * v + z * z), 2 * (x * v - w * z), 2 * (x * z + w * v),  //
      2 * (x * v + w * z), 1 - 2 * (x * x + z * z), 2 * (v * z - w * x),          //
      2 * (x * z - w * v), 2 * (v * z + w * x), 1 - 2 * (x * x + v * v);
  return rotation;
}

double least_stiffness_Nmm2(std::span<const scene::Span> spans) {
  double least = INFINITY;
  for (const scene::Span& span : spans) {
    least = std::min({least, span.stiffness.bending_Nmm2.minCoeff(), span.stiffness.torsion_Nmm2});
  }
  return least;
}

scene::Wrench scaled(const scene::Wrench& wrench, double force_N, double moment_Nmm) {
  return {wrench.force_N / force_N, wrench.moment_Nmm / moment_Nmm};
}

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d matrix;
  matrix << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return matrix;
}

}  // namespace

Rk4Shooting::Rk4Shooting(std::span<const scene::Span> spans, std::span<const int> steps_per_span, bool with_shear)
    : length_mm_(spans.back().end_mm), stiffness_Nmm2_(least_stiffness_Nmm2(spans)) {
  const double L = length_mm_, moment_Nmm = stiffness_Nmm2_ / L, force_N = moment_Nmm / L;
  std::size_t step_count = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const scene::Span& span = spans[i];
    const scene::Stiffness& stiffness = span.stiffness;
    SpanSteps steps;
    steps.count = steps_per_span[i];
    steps.step = span.length_mm() / L / steps.count;
    steps.rest_curvature = span.rest_curvature_per_mm * L;
    steps.bending_compliance << stiffness_Nmm2_ / stiffness.torsion_Nmm2, stiffness_Nmm2_ / stiffness.bending_Nmm2[0],
        stiffness_Nmm2_ / stiffness.bending_Nmm2[1];
    steps.shear_compliance.setZero();
    if (with_shear && stiffness.axial_N) steps.shear_compliance[0] = force_N / *stiffness.axial_N;
    if (with_shear && stiffness.shear_N) steps.shear_compliance.tail<2>() = force_N * stiffness.shear_N->cwiseInverse();
    steps.fixed_density_B = span.fixed_force_B_N_per_mm * L / force_N;
    steps.follower_density_S = span.follower_force_S_N_per_mm * L / force_N;
    steps.has_follower_density = !steps.follower_density_S.isZero(0);
    steps.fixed_load_B = scaled(span.fixed_load_B, force_N, moment_Nmm);
    steps.follower_load_S = scaled(span.follower_load_S, force_N, moment_Nmm);
    steps.fixed_force_arms = span.fixed_force_arms_BS_Nmm / moment_Nmm;
    steps.has_arms = !steps.fixed_force_arms.isZero(0);
    for (const scene::SectionTendon& tendon : span.tendons) {
      steps.tendons.push_back({tendon.arm_S_mm / L, tendon.tension_N / force_N});
    }
    steps.section = !span.tendons.empty() ? Section::tendons : with_shear ? Section::reissner : Section::kirchhoff;
    steps.at_rest = steps.at_start = near(steps, {steps.rest_curvature, Vector3d::UnitX()});
    step_count += static_cast<std::size_t>(steps.count);
    spans_.push_back(steps);
  }
  states_.resize(step_count + 1);
}

scene::Wrench Rk4Shooting::tendon_pull_S(const SpanSteps& span, const Strains& strains) {
  scene::Wrench sum;
  for (const scene::SectionTendon& tendon : span.tendons) {
    const Vector3d t = strains.v + strains.u.cross(tendon.arm_S_mm);
    const Vector3d pull = tendon.tension_N / t.norm() * t;
    sum.force_N += pull;
    sum.moment_Nmm += tendon.arm_S_mm.cross(pull);
  }
  return sum;
}

// The slope is I + C sum T/|t| A^T (I - d d^T) A, C the compliances, d = t/|t|, A = [-[r]x, I] what makes t = A (u, v).
Rk4Shooting::Near Rk4Shooting::near(const SpanSteps& span, const Strains& strains) {
  Matrix6d stiffening = Matrix6d::Zero();
  for (const scene::SectionTendon& tendon : span.tendons) {
    const Vector3d t = strains.v + strains.u.cross(tendon.arm_S_mm), d = t.normalized();
    Eigen::Matrix<double, 3, 6> A;
    A << -cross_matrix(tendon.arm_S_mm), Matrix3d::Identity();
    stiffening += tendon.tension_N / t.norm() * A.transpose() * (Matrix3d::Identity() - d * d.transpose()) * A;
  }
  Vector6d compliance;
  compliance << span.bending_compliance, span.shear_compliance;
  return {strains, (Matrix6d::Identity() + compliance.asDiagonal() * stiffening).inverse()};
}

// u = u0 + K_u^-1 (m - sum r x T t/|t|), v = e_x + K_v^-1 (n - sum T t/|t|); not a number where that is not found.
Rk4Shooting::Strains Rk4Shooting::strains_of(const SpanSteps& span, const Near& start, const State& y) {
  const Matrix3d rotation = rotation_of(y);
  const Vector3d force_S = rotation.transpose() * y.segment<3>(7), moment_S = rotation.transpose() * y.segment<3>(10);
  constexpr int most_iterations = 50;
  constexpr double accuracy = 1e-14;
  Strains x = start.strains;
  double last = 0;
  for (int i = 0; i < most_iterations; ++i) {
    const scene::Wrench pull = tendon_pull_S(span, x);
    Vector6d step;
    step << span.rest_curvature + span.bending_compliance.cwiseProduct(moment_S - pull.moment_Nmm) - x.u,
        Vector3d::UnitX() + span.shear_compliance.cwiseProduct(force_S - pull.force_N) - x.v;
    step = (start.slope_inverse * step).eval();
    x.u += step.head<3>();
    x.v += step.tail<3>();
    const double size = step.norm();
    if (size * size <= accuracy * last) return x;  // steps shrink by a factor: size^2/last is the next
    last = size;
  }
  return {Vector3d::Constant(NAN), Vector3d::Constant(NAN)};
}

template <Rk4Shooting::Section section>
Rk4Shooting::State Rk4Shooting::derivative(const SpanSteps& span, const State& y) {
  const Matrix3d rotation = rotation_of(y);
  const Vector3d force = y.segment<3>(7), moment = y.segment<3>(10);
  Vector3d u, tangent = rotation.col(0);
  if constexpr (section == Section::tendons) {
    const Strains strains = strains_of(span, span.at_start, y);
    u = strains.u;
    tangent = rotation * strains.v;
  } else {
    u = span.rest_curvature + span.bending_compliance.cwiseProduct(rotation.transpose() * moment);
    if constexpr (section == Section::reissner) {
      tangent += rotation * span.shear_compliance.cwiseProduct(rotation.transpose() * force);
    }
  }
  State d;
  d[0] = 0.5 * (-y[1] * u[0] - y[2] * u[1] - y[3] * u[2]);
  d[1] = 0.5 * (y[0] * u[0] + y[2] * u[2] - y[3] * u[1]);
  d[2] = 0.5 * (y[0] * u[1] + y[3] * u[0] - y[1] * u[2]);
  d[3] = 0.5 * (y[0] * u[2] + y[1] * u[1] - y[2] * u[0]);
  d.segment<3>(4) = tangent;
  d.segment<3>(7) = -span.fixed_density_B;
  if (span.has_follower_density) d.segment<3>(7) -= rotation * span.follower_density_S;
  d.segment<3>(10) = force.cross(tangent);
  return d;
}

template <Rk4Shooting::Section section>
Rk4Shooting::State Rk4Shooting::step(const SpanSteps& span, const State& y, double h) {
  const State k1 = derivative<section>(span, y);
  const State k2 = derivative<section>(span, y + h / 2 * k1);
  const State k3 = derivative<section>(span, y + h / 2 * k2);
  const State k4 = derivative<section>(span, y + h * k3);
  State next = y + h / 6 * (k1 + 2 * (k2 + k3) + k4);
  next.head<4>() /= std::sqrt(next.head<4>().squaredNorm());
  return next;
}

Rk4Shooting::State Rk4Shooting::step(const SpanSteps& span, const State& y, double h) {
  switch (span.section) {
    case Section::kirchhoff: return step<Section::kirchhoff>(span, y, h);
    case Section::reissner: return step<Section::reissner>(span, y, h);
    case Section::tendons: break;
  }
  return step<Section::tendons>(span, y, h);
}

Rk4Shooting::State Rk4Shooting::beyond_point_loads(const SpanSteps& span, const State& y) {
  const Matrix3d rotation = rotation_of(y);
  State beyond = y;
  beyond.segment<3>(7) -= span.fixed_load_B.force_N + rotation * span.follower_load_S.force_N;
  beyond.segment<3>(10) -= span.fixed_load_B.moment_Nmm + rotation * span.follower_load_S.moment_Nmm;
  if (span.has_arms) {
    beyond.segment<3>(10) -= scene::moment_of_arms<double>(span.fixed_force_arms * rotation.transpose());
  }
  return beyond;
}

// The internal force and moment beyond the tip, which must be zero.
template <bool keep_states>
Rk4Shooting::Vector6d Rk4Shooting::residual_of(const Vector6d& base_wrench) {
  State y;
  y << 1, 0, 0, 0, 0, 0, 0, base_wrench;
  State* kept = states_.data();
  if constexpr (keep_states) *kept++ = y;
  for (SpanSteps& span : spans_) {
    if (span.section == Section::tendons) span.at_start = near(span, strains_of(span, span.at_rest, y));
    for (int i = 0; i < span.count; ++i) {
      y = step(span, y, span.step);
      if constexpr (keep_states) *kept++ = y;
    }
    y = beyond_point_loads(span, y);
  }
  return y.tail<6>();
}

scene::Status Rk4Shooting::run(const Vector6d& guess) noexcept {
  constexpr double root_of_epsilon = 1.5e-8;
  base_wrench_ = guess;
  for (iterations_ = 0;; ++iterations_) {
    const Vector6d residual = residual_of<true>(base_wrench_);
    residual_ = residual.lpNorm<Eigen::Infinity>();
    if (!residual.allFinite()) return scene::Status::not_finite;
    if (residual_ <= tolerance) return scene::Status::converged;
    if (iterations_ == max_iterations) return scene::Status::not_converged;
    Eigen::Matrix<double, 6, 6> slope;
    for (int k = 0; k < 6; ++k) {
      Vector6d moved = base_wrench_;
      moved[k] += root_of_epsilon * std::max(1.0, std::abs(moved[k]));
      slope.col(k) = (residual_of<false>(moved) - residual) / (moved[k] - base_wrench_[k]);
    }
    base_wrench_ -= slope.partialPivLu().solve(residual);
  }
}

scene::Station Rk4Shooting::station(const SpanSteps& span, double place, const State& y) const {
  const double moment_Nmm = stiffness_Nmm2_ / length_mm_, force_N = moment_Nmm / length_mm_;
  const Matrix3d rotation = rotation_of(y);
  Vector3d force = y.segment<3>(7), moment = y.segment<3>(10);
  if (!span.tendons.empty()) {
    const Strains strains = strains_of(span, span.at_start, y);
    const scene::Wrench pull_S = tendon_pull_S(span, strains);
    force -= rotation * pull_S.force_N;
    moment -= rotation * pull_S.moment_Nmm;
  }
  return {place * length_mm_, {rotation, y.segment<3>(4) * length_mm_}, force * force_N, moment * moment_Nmm};
}

std::vector<scene::Station> Rk4Shooting::stations() const {
  constexpr int equal_parts = 40;
  std::vector<scene::Station> list{station(spans_[0], 0, states_[0])};
  int part = 1;
  double start = 0;
  const State* end = &states_[0];
  State y = *end;
  for (const SpanSteps& span : spans_) {
    for (int i = 0; i < span.count; ++i) {
      const double from = start + i * span.step, to = from + span.step;
      for (; part < equal_parts && part < equal_parts * (to - scene::same_place_relative); ++part) {
        const double place = static_cast<double>(part) / equal_parts, h = place - from;
        if (h <= scene::same_place_relative) continue;
        list.push_back(station(span, place, step(span, y, h)));
      }
      y = *++end;
      list.push_back(station(span, to, y));
    }
    start += span.count * span.step;
    y = beyond_point_loads(span, y);
  }
  return list;
}

}  // namespace studies
