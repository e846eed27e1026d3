#include "fam/model_choice.h"

#include "fam/load_length.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fam {
namespace {

using Eigen::Vector2d;
using scene::Span;

// A bound on the tip's shift by shear and stretch: the strain |K_v^-1 n| summed along the rod, |n| bounded by the
// forces beyond. The shift of the tip by the strains themselves; what they change in the moments is of their order.
double shear_bound_mm(std::span<const Span> spans) {
  double bound = 0;
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& span) {
    const double force_N = span.force_N + straight_tendons(span.span).force_N.norm();
    bound += span.length_mm * linear_compliance_per_N(span.span) * force_N;
  });
  return 3 * bound;
}

Span turned(const Span& span, const Matrix3d& rotation_PB, bool swap) {
  Span result = span;
  const auto turn = [&](Vector3d& v, bool is_turn) {
    v = rotation_PB * v;
    (is_turn ? v[1] : v[2]) = 0;
  };
  for (scene::Wrench* wrench : {&result.follower_load_S, &result.fixed_load_B}) {
    turn(wrench->force_N, false);
    turn(wrench->moment_Nmm, true);
  }
  result.fixed_force_arms_BS_Nmm = rotation_PB * result.fixed_force_arms_BS_Nmm * rotation_PB.transpose();
  for (scene::SectionTendon& tendon : result.tendons) tendon.arm_S_mm = rotation_PB * tendon.arm_S_mm;
  turn(result.follower_force_S_N_per_mm, false);
  turn(result.fixed_force_B_N_per_mm, false);
  turn(result.rest_curvature_per_mm, true);
  if (swap) {
    result.stiffness.bending_Nmm2.reverseInPlace();
    if (result.stiffness.shear_N) result.stiffness.shear_N->reverseInPlace();
  }
  return result;
}

}  // namespace

std::optional<PlanarScene> in_one_plane(std::span<const Span> spans) {
  const std::optional<Vector2d> direction = scene::plane_direction(spans);
  if (!direction) return std::nullopt;
  const double c = (*direction)[0], s = (*direction)[1];
  PlanarScene scene;
  scene.rotation_BP << 1, 0, 0, 0, c, -s, 0, s, c;
  const bool swap = c == 0 && !scene::is_isotropic(spans);
  for (const Span& span : spans) scene.spans.push_back(turned(span, scene.rotation_BP.transpose(), swap));
  return scene;
}

std::optional<RoundRod> without_torsion(std::span<const Span> spans) {
  if (!scene::is_round(spans)) return std::nullopt;
  RoundRod rod;
  for (const Span& span : spans) {
    rod.spans.push_back(span);
    double& torsion_Nmm2 = rod.spans.back().stiffness.torsion_Nmm2;
    const double bending_Nmm2 = span.stiffness.bending_Nmm2[0];
    rod.twist_per_Nmm2.push_back(1 / torsion_Nmm2 - 1 / bending_Nmm2);
    torsion_Nmm2 = bending_Nmm2;
  }
  return rod;
}

RodChoice choose_rod(std::span<const Span> spans, RodModel wanted, double tolerance_mm) {
  if (wanted != RodModel::automatic) return {wanted, 0, "rod model as asked for"};
  const bool gives_way = std::any_of(spans.begin(), spans.end(),
                                     [](const Span& span) { return span.stiffness.axial_N || span.stiffness.shear_N; });
  if (!gives_way) return {RodModel::kirchhoff, 0, "no shear: the sections neither shear nor stretch"};
  const double bound_mm = shear_bound_mm(spans);
  if (bound_mm <= 0.1 * tolerance_mm) {
    return {RodModel::kirchhoff, bound_mm,
            "no shear: shear and stretch move the tip by less than a tenth of the tolerance"};
  }
  return {RodModel::reissner, 0, "shear: the sections shear or stretch, and it may matter"};
}

std::vector<int> first_arcs(std::span<const Span> spans, bool planar) {
  std::vector<int> arcs(spans.size(), 1);
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& cell) {
    const Span& span = cell.span;
    const double load_length = cell.load_length(least_stiffness_Nmm2(span), !planar);
    const double moment_Nmm = cell.moment_Nmm + straight_tendons(span).moment_Nmm.norm();
    const double turn_rad =
        cell.length_mm * (span.rest_curvature_per_mm.norm() + moment_Nmm / span.stiffness.bending_Nmm2.minCoeff());
    // Where no force acts the strain is constant, or an Euler top's, and turns matter little.
    const double by_turn = cell.force_N > 0 ? turn_rad / first_turn_rad : 0;
    const double wanted = std::ceil(std::max(load_length / first_load_length, by_turn));  // NaN where numbers overflow
    arcs[cell.span_index] = wanted < most_first_arcs ? std::max(1, static_cast<int>(wanted)) : most_first_arcs;
  });
  return arcs;
}

Choice choose(std::span<const Span> spans, const Options& options, double tolerance_mm) {
  Choice choice;
  choice.law = chosen(options.law);
  const bool coupled = facts_of(choice.law).coupled;
  if (coupled) choice.plane = in_one_plane(spans);
  if (coupled && !choice.plane) choice.round = without_torsion(spans);
  const bool needs_kirchhoff = options.model == RodModel::automatic && !coupled;
  choice.rod =
      choose_rod(spans, needs_kirchhoff ? RodModel::kirchhoff : options.model, options.arcs == 0 ? tolerance_mm : 0);
  choice.march = scene::all_loads_follow(spans);
  choice.reason = (choice.plane ? "planar: all loads and rest curvatures lie in one plane; " : "spatial; ") +
                  choice.rod.reason + "; " +
                  (options.law != choice.law ? "sixth_order: an arc costs no more than a fourth_order one and fewer do"
                                             : "law as asked for") +
                  (choice.march ? "; march: all loads follow the rod" : "; boundary value: a load is fixed in space");
  return choice;
}

}  // namespace fam
