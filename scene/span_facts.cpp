#include "scene/span_facts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scene {

bool all_loads_follow(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return !span.has_fixed_point_load() && span.fixed_force_B_N_per_mm.isZero(0);
  });
}

bool moments_are_known(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    const Wrench &follower = span.follower_load_S, &fixed = span.fixed_load_B;
    return span.tendons.empty() && follower.force_N.isZero(0) && follower.moment_Nmm.isZero(0) &&
           fixed.force_N.isZero(0) && span.fixed_force_arms_BS_Nmm.isZero(0) &&
           span.follower_force_S_N_per_mm.isZero(0) && span.fixed_force_B_N_per_mm.isZero(0);
  });
}

namespace {

constexpr double round_off = 2 * std::numeric_limits<double>::epsilon();

// The mirror of the plane with this normal maps the tendons onto each other.
bool mirrors_tendons(const Span& span, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d in_plane = normal.cross(Eigen::Vector3d::UnitX());
  double size = 0;
  for (const SectionTendon& tendon : span.tendons) size = std::max(size, tendon.arm_S_mm.norm());
  return std::all_of(span.tendons.begin(), span.tendons.end(), [&](const SectionTendon& tendon) {
    double sum = 0, sizes = 0;  // over the tendons at the same place in the plane
    for (const SectionTendon& other : span.tendons) {
      if (std::abs((other.arm_S_mm - tendon.arm_S_mm).dot(in_plane)) > 4 * round_off * size) continue;
      sum += other.tension_N * other.arm_S_mm.dot(normal);
      sizes += other.tension_N * std::max(size, other.arm_S_mm.norm());
    }
    return std::abs(sum) <= 4 * round_off * sizes;
  });
}

// The moment of the tendons on the straight rod.
Eigen::Vector3d tendon_moment_Nmm(const Span& span) {
  Eigen::Vector3d moment_Nmm = Eigen::Vector3d::Zero();
  for (const SectionTendon& tendon : span.tendons) {
    moment_Nmm -= tendon.tension_N * tendon.arm_S_mm.cross(Eigen::Vector3d::UnitX());
  }
  return moment_Nmm;
}

// Half a turn about the axis maps the tendons onto each other.
bool turns_tendons(const Span& span) {
  return std::all_of(span.tendons.begin(), span.tendons.end(), [&](const SectionTendon& tendon) {
    return tendon.arm_S_mm.isZero(0) ||
           std::any_of(span.tendons.begin(), span.tendons.end(), [&](const SectionTendon& other) {
             return other.arm_S_mm == -tendon.arm_S_mm && other.tension_N == tendon.tension_N;
           });
  });
}

// A vector, or a turn, lies in a plane of this direction (y, z) if its own direction is this one.
class DirectionFinder {
 public:
  // Whether the direction agrees with those before it; zero agrees with all.
  bool agrees(const Eigen::Vector2d& direction) {
    const double plain = direction.norm(), size = std::isfinite(plain) ? plain : direction.stableNorm();
    if (size == 0) return true;
    if (common_.isZero(0)) common_ = direction / size;
    return std::abs(common_[0] * direction[1] - common_[1] * direction[0]) <= round_off * size;
  }
  bool vector_agrees(const Eigen::Vector3d& vector) { return agrees(vector.tail<2>()); }
  bool turn_agrees(const Eigen::Vector3d& turn) { return turn[0] == 0 && agrees({turn[2], -turn[1]}); }
  Eigen::Vector2d common() const { return common_.isZero(0) ? Eigen::Vector2d(1, 0) : common_; }

 private:
  Eigen::Vector2d common_ = Eigen::Vector2d::Zero();
};

// Each lever arm and its force.
bool arms_agree(const Span& span, DirectionFinder& finder) {
  if (span.fixed_force_arms_BS_Nmm.isZero(0)) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (!finder.agrees(span.fixed_force_arms_BS_Nmm.row(axis).tail<2>().transpose())) return false;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!finder.vector_agrees(span.fixed_force_arms_BS_Nmm.col(axis))) return false;
  }
  return true;
}

Eigen::Vector3d normal_of(const Eigen::Vector2d& direction) {
  return {0, -direction[1], direction[0]};
}

bool lies_in(std::span<const Span> spans, int normal) {
  const int other = 3 - normal;
  return std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
    const auto planar = [&](const Wrench& load) {
      return load.force_N[normal] == 0 && load.moment_Nmm[0] == 0 && load.moment_Nmm[other] == 0;
    };
    return planar(span.follower_load_S) && planar(span.fixed_load_B) && span.follower_force_S_N_per_mm[normal] == 0 &&
           span.fixed_force_B_N_per_mm[normal] == 0 && span.rest_curvature_per_mm[0] == 0 &&
           span.rest_curvature_per_mm[other] == 0 && span.fixed_force_arms_BS_Nmm.row(normal).isZero(0) &&
           span.fixed_force_arms_BS_Nmm.col(normal).isZero(0) && mirrors_tendons(span, Eigen::Vector3d::Unit(normal));
  });
}

bool lies_on_axis(std::span<const Span> spans) {
  const auto along = [](const Eigen::Vector3d& v) { return v[1] == 0 && v[2] == 0; };
  return std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
    const auto both = [&](const Wrench& wrench) { return along(wrench.force_N) && along(wrench.moment_Nmm); };
    return both(span.follower_load_S) && both(span.fixed_load_B) && turns_tendons(span) &&
           span.fixed_force_arms_BS_Nmm.isZero(0) && along(span.follower_force_S_N_per_mm) &&
           along(span.fixed_force_B_N_per_mm) && along(span.rest_curvature_per_mm);
  });
}

}  // namespace

bool is_isotropic(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    const Stiffness& k = span.stiffness;
    return k.bending_Nmm2[0] == k.bending_Nmm2[1] && (!k.shear_N || (*k.shear_N)[0] == (*k.shear_N)[1]);
  });
}

bool is_round(std::span<const Span> spans) {
  const auto along = [](const Eigen::Vector3d& v) { return v[1] == 0 && v[2] == 0; };
  return is_isotropic(spans) && std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
           const bool centred = std::all_of(span.tendons.begin(), span.tendons.end(),
                                            [](const SectionTendon& tendon) { return tendon.arm_S_mm.isZero(0); });
           return centred && span.rest_curvature_per_mm.isZero(0) && span.fixed_force_arms_BS_Nmm.isZero(0) &&
                  along(span.follower_load_S.force_N) && along(span.follower_load_S.moment_Nmm) &&
                  along(span.follower_force_S_N_per_mm);
         });
}

std::optional<Eigen::Vector2d> plane_direction(std::span<const Span> spans) {
  DirectionFinder finder;
  for (const Span& span : spans) {
    const bool agrees =
        finder.vector_agrees(span.follower_load_S.force_N) && finder.vector_agrees(span.fixed_load_B.force_N) &&
        finder.vector_agrees(span.follower_force_S_N_per_mm) && finder.vector_agrees(span.fixed_force_B_N_per_mm) &&
        arms_agree(span, finder) && finder.turn_agrees(span.follower_load_S.moment_Nmm) &&
        finder.turn_agrees(span.fixed_load_B.moment_Nmm) && finder.turn_agrees(span.rest_curvature_per_mm) &&
        finder.turn_agrees(tendon_moment_Nmm(span));
    if (!agrees) return std::nullopt;
  }
  const Eigen::Vector2d direction = finder.common();
  const bool along_axis = direction[0] == 0 || direction[1] == 0;
  if (!along_axis && !is_isotropic(spans)) return std::nullopt;
  const bool mirrored = std::all_of(spans.begin(), spans.end(),
                                    [&](const Span& span) { return mirrors_tendons(span, normal_of(direction)); });
  return mirrored ? std::optional(direction) : std::nullopt;
}

bool needs_no_plane(std::span<const Span> spans) {
  return lies_on_axis(spans) && std::all_of(spans.begin(), spans.end(), [](const Span& span) {
           return std::all_of(span.tendons.begin(), span.tendons.end(),
                              [](const SectionTendon& tendon) { return tendon.arm_S_mm.isZero(0); });
         });
}

std::optional<Eigen::Vector3d> plane_normal(std::span<const Span> spans) {
  const std::optional<Eigen::Vector2d> direction = plane_direction(spans);
  return direction ? std::optional(normal_of(*direction)) : std::nullopt;
}

Symmetry symmetry_of(std::span<const Span> spans) {
  if (lies_on_axis(spans)) return Symmetry::axis;
  if (lies_in(spans, 2)) return Symmetry::plane_xy;
  return lies_in(spans, 1) ? Symmetry::plane_xz : Symmetry::none;
}

Symmetry common_symmetry(Symmetry a, Symmetry b) {
  if (a == b || b == Symmetry::axis) return a;
  return a == Symmetry::axis ? b : Symmetry::none;
}

bool is_conservative(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return span.follower_load_S.is_zero() && span.follower_force_S_N_per_mm.isZero(0) &&
           span.fixed_load_B.moment_Nmm.isZero(0);
  });
}

}  // namespace scene
