#include "fam/load_length.h"

#include <algorithm>
#include <limits>

namespace fam {

using scene::Span;

namespace {

Vector3d stiffness_of(const Span& span) {
  return {span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2[0], span.stiffness.bending_Nmm2[1]};
}

// Strain k of an arc that turns by k h, and the moment m = K (k - k0) - tendons' of its section.
struct ArcMoment {
  Vector3d strain_per_mm, moment_Nmm;
  Vector3d stiffness_Nmm2;
  double scale;  // of m x k

  ArcMoment(const scene::Span& span, const Vector3d& strain_per_mm_)
      : strain_per_mm(strain_per_mm_), stiffness_Nmm2(stiffness_of(span)) {
    const Vector3d elastic_Nmm = stiffness_Nmm2.cwiseProduct(strain_per_mm - span.rest_curvature_per_mm);
    const Vector3d tendons_Nmm = straight_tendons(span).moment_Nmm;
    moment_Nmm = elastic_Nmm - tendons_Nmm;
    scale = (elastic_Nmm.norm() + tendons_Nmm.norm()) * strain_per_mm.norm();
  }

  bool is_steady() const { return moment_Nmm.cross(strain_per_mm).norm() <= 1e-12 * scale; }

  double rate_per_mm() const {
    Matrix3d slope;  // its trace is 0
    for (int i = 0; i < 3; ++i) {
      slope.col(i) = (moment_Nmm / stiffness_Nmm2[i] - strain_per_mm).cross(Vector3d::Unit(i));
    }
    return std::sqrt(std::abs((slope * slope).trace()) / 2);
  }
};

}  // namespace

double least_stiffness_Nmm2(const Span& span) {
  return std::min(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2.minCoeff());
}

scene::Wrench straight_tendons(const Span& span) {
  scene::Wrench wrench;
  for (const scene::SectionTendon& tendon : span.tendons) {
    wrench.force_N[0] -= tendon.tension_N;
    wrench.moment_Nmm -= tendon.tension_N * tendon.arm_S_mm.cross(Eigen::Vector3d::UnitX());
  }
  return wrench;
}

double spin_rate_per_Nmm2(const Span& span) {
  Eigen::Vector3d c(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2[0], span.stiffness.bending_Nmm2[1]);
  c = c.cwiseInverse().eval();
  std::sort(c.begin(), c.end());
  return std::sqrt((c[1] - c[0]) * (c[2] - c[1]));
}

double linear_compliance_per_N(const Span& span) {
  const double axial = span.stiffness.axial_N ? 1 / *span.stiffness.axial_N : 0;
  return span.stiffness.shear_N ? std::max(axial, 1 / span.stiffness.shear_N->minCoeff()) : axial;
}

double clamp_straying(std::span<const Span> spans, bool planar) {
  double force_N = 0, moment_Nmm = 0;                          // F, M
  double turn = 1, force_change_N = 0, moment_change_Nmm = 0;  // |phi|, |Gamma|, |Delta|
  for (std::size_t i = spans.size(); i-- > 0;) {
    const Span& span = spans[i];
    const double h_mm = span.length_mm();
    const double fixed_N = span.fixed_load_B.force_N.norm(), fixed_N_per_mm = span.fixed_force_B_N_per_mm.norm();
    const double fixed_Nmm = span.fixed_load_B.moment_Nmm.norm() + span.fixed_force_arms_BS_Nmm.norm();
    const double distal_N = force_N + fixed_N + span.follower_load_S.force_N.norm();
    force_N = distal_N + h_mm * (fixed_N_per_mm + span.follower_force_S_N_per_mm.norm());
    moment_Nmm += fixed_Nmm + span.follower_load_S.moment_Nmm.norm();
    const double moment_sum_Nmm2 = h_mm * (moment_Nmm + h_mm * (2 * distal_N + force_N) / 6);  // int M ds
    moment_Nmm += h_mm * (distal_N + force_N) / 2;

    const double stiffness_Nmm2 = planar ? span.stiffness.bending_Nmm2.minCoeff() : least_stiffness_Nmm2(span);
    const double largest_Nmm2 = std::max(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2.maxCoeff());
    const double by_M = planar ? 1 : std::exp(moment_sum_Nmm2 * (1 / stiffness_Nmm2 - 1 / largest_Nmm2) / 2);
    const double w = h_mm * std::sqrt(force_N / stiffness_Nmm2), cosh = std::cosh(w);
    const double first = w > 1e-4 ? std::sinh(w) / w : 1, second = w > 1e-4 ? (cosh - 1) / (w * w) : 0.5;
    // Over the units in which the span's curvature turns its end by 1; the larger turn at its end with f on all of it,
    // of which (sinh w - w) / w^3 < second / 3 comes back.
    const double moment_unit_Nmm = stiffness_Nmm2 / h_mm, force_unit_N = moment_unit_Nmm / h_mm;
    const double m = (moment_change_Nmm + fixed_Nmm * turn) / moment_unit_Nmm;
    const double n = (force_change_N + fixed_N * turn) / force_unit_N;
    const double f = fixed_N_per_mm * h_mm / force_unit_N, comes_back = by_M * f * second / 3;
    if (!(comes_back < 1)) return std::numeric_limits<double>::infinity();
    turn = (turn + by_M * (m * first + n * second)) / (1 - comes_back);
    moment_change_Nmm = by_M * (m * cosh + n * first + turn * f * second) * moment_unit_Nmm;
    force_change_N = by_M * (n * cosh + (m * w * w + turn * f) * first) * force_unit_N;
  }
  return turn - 1;
}

bool strains_are_constant(std::span<const Span> spans, bool planar) {
  bool constant = true;
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& cell) {
    const bool known = cell.span.fixed_force_arms_BS_Nmm.isZero(0);
    constant = constant && known && cell.force_N == 0 && (planar || cell.moment_Nmm == 0);
  });
  return constant;
}

double largest_load_length(std::span<const Span> spans, std::span<const int> arcs_per_span) {
  double largest = 0;
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& cell) {
    const double length_mm = cell.length_mm / arcs_per_span[cell.span_index];
    largest = std::max(largest, length_mm * std::sqrt(cell.force_N / least_stiffness_Nmm2(cell.span)));
  });
  return largest;
}

double across_stiffness_Nmm2(const Span& span) {
  Vector3d stiffness_Nmm2 = stiffness_of(span);
  std::sort(stiffness_Nmm2.begin(), stiffness_Nmm2.end());
  return std::sqrt(stiffness_Nmm2[0] * stiffness_Nmm2[1]);
}

double size_of_change(std::span<const Span> from, std::span<const Span> to) {
  LoadSum force_N(Sum::vectors), moment_Nmm(Sum::vectors);
  double load_length = 0, turn_rad = 0;
  for (std::size_t i = to.size(); i-- > 0;) {
    const Span &a = from[i], &b = to[i];
    const double stiffness_Nmm2 = least_stiffness_Nmm2(b), length_mm = b.length_mm();
    const auto add = [](LoadSum& sum, const Vector3d& fixed, const Vector3d& following) {
      sum.add_fixed(fixed);
      sum.add_following(following.norm());
    };
    add(force_N, b.fixed_load_B.force_N - a.fixed_load_B.force_N,
        b.follower_load_S.force_N - a.follower_load_S.force_N);
    const double at_end_N = force_N.size();
    add(force_N, length_mm * (b.fixed_force_B_N_per_mm - a.fixed_force_B_N_per_mm),
        length_mm * (b.follower_force_S_N_per_mm - a.follower_force_S_N_per_mm));
    add(moment_Nmm, b.fixed_load_B.moment_Nmm - a.fixed_load_B.moment_Nmm,
        b.follower_load_S.moment_Nmm - a.follower_load_S.moment_Nmm);
    moment_Nmm.add_following((b.fixed_force_arms_BS_Nmm - a.fixed_force_arms_BS_Nmm).norm());
    const double tendons_Nmm = (straight_tendons(b).moment_Nmm - straight_tendons(a).moment_Nmm).norm();
    load_length += length_mm * std::sqrt(std::max(at_end_N, force_N.size()) / stiffness_Nmm2);
    turn_rad += length_mm * ((moment_Nmm.size() + tendons_Nmm) / stiffness_Nmm2 +
                             (b.rest_curvature_per_mm - a.rest_curvature_per_mm).norm());
  }
  return load_length * load_length + turn_rad;
}

double swing_rate_per_mm(const Span& span, const Vector3d& moment_Nmm) {
  const Vector3d bending_Nmm = moment_Nmm + straight_tendons(span).moment_Nmm;
  const ArcMoment state(span, span.rest_curvature_per_mm + bending_Nmm.cwiseQuotient(stiffness_of(span)));
  return std::max(state.rate_per_mm(), state.strain_per_mm.norm());
}

template <int D>
double largest_swing_rad(std::span<const Span> spans, std::span<const int> arcs_per_span,
                         std::span<const BasicArc<D>> arcs) {
  const bool free_of_force = largest_load_length(spans, arcs_per_span) == 0;
  if (free_of_force && strains_are_constant(spans, D == 2)) return 0;
  auto arc = arcs.begin();
  double largest = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double length_mm = spans[i].length_mm() / arcs_per_span[i];
    for (int k = 0; k < arcs_per_span[i]; ++k, ++arc) {
      if constexpr (D == 3) {
        const ArcMoment state(spans[i], arc->screw.rotation / length_mm);
        if (free_of_force && state.is_steady()) continue;
        largest = std::max(largest, length_mm * state.rate_per_mm());
      }
      largest = std::max(largest, arc->screw.rotation.norm());
    }
  }
  return largest;
}

template <int D>
double largest_swing_in_space_rad(std::span<const Span> spans, std::span<const int> arcs_per_span,
                                  std::span<const BasicArc<D>> arcs) {
  auto arc = arcs.begin();
  double largest = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double length_mm = spans[i].length_mm() / arcs_per_span[i];
    for (int k = 0; k < arcs_per_span[i]; ++k, ++arc) {
      Vector3d turn = Vector3d::Zero();
      turn.tail<rotations_of(D)>() = arc->screw.rotation;
      largest = std::max(largest, length_mm * ArcMoment(spans[i], turn / length_mm).rate_per_mm());
    }
  }
  return largest;
}

template <int D>
double series_error_over_L(std::span<const Span> spans, std::span<const int> arcs_per_span,
                           std::span<const BasicArc<D>> arcs) {
  double left_out = 0, length = 0;
  walk_from_tip(spans, arcs_per_span, [&](const LoadedCell& cell) {
    const Span& span = cell.span;
    const double h_mm = cell.length_mm;
    const double stiffness_Nmm2 = D == 2 ? span.stiffness.bending_Nmm2.minCoeff() : least_stiffness_Nmm2(span);
    const Angular<double, D>& turn = arcs[static_cast<std::size_t>(cell.cell)].screw.rotation;
    double x = std::max(h_mm * std::sqrt(cell.force_N / stiffness_Nmm2), turn.norm());
    if constexpr (D == 3) {
      const ArcMoment state(span, turn / h_mm);
      const double spin_per_mm2 = state.moment_Nmm.cross(state.strain_per_mm).norm() / stiffness_Nmm2;
      x = std::max({x, h_mm * state.rate_per_mm(), h_mm * std::sqrt(spin_per_mm2)});
    }
    const double density_N_per_mm = span.follower_force_S_N_per_mm.norm() + span.fixed_force_B_N_per_mm.norm();
    const double q = h_mm * h_mm * h_mm * density_N_per_mm / stiffness_Nmm2;
    left_out += x * x * x * x * (x * x * x + q);
    length += x;
  });
  return series_share * (1 + length * length) * left_out;
}

template double series_error_over_L(std::span<const Span>, std::span<const int>, std::span<const BasicArc<2>>);
template double series_error_over_L(std::span<const Span>, std::span<const int>, std::span<const BasicArc<3>>);
template double largest_swing_in_space_rad(std::span<const Span>, std::span<const int>, std::span<const BasicArc<2>>);
template double largest_swing_in_space_rad(std::span<const Span>, std::span<const int>, std::span<const BasicArc<3>>);
template double largest_swing_rad(std::span<const Span>, std::span<const int>, std::span<const BasicArc<2>>);
template double largest_swing_rad(std::span<const Span>, std::span<const int>, std::span<const BasicArc<3>>);

}  // namespace fam
