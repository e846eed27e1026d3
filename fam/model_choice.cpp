#include "fam/model_choice.h"

#include "fam/load_length.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

using Eigen::Vector2d;
using scene::Span;

// A bound on the tip's shift by shear and stretch: the strain |K_v^-1 n| summed along the rod, |n| bounded by the
// forces beyond, times what that changes in the moments. Of 5167 random scenes with a bound between 1e-7 and 1e-2 L,
// 3113 of them drawn after it was chosen, the tip moved by 0.77 of it at most. Without amplification five whose loads
// are fixed moved farther than it, up to 3.7 times (at load lengths of 10 to 78); of 1098 others two whose loads all
// follow, and turn with what is shifted, moved 66 and 78 times the sum (at a load length of 46, at turns of 156 rad).
double shear_bound_mm(std::span<const Span> spans) {
  double bound = 0, load_length = 0, turn_rad = 0;
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& span) {
    const double force_N = span.force_N + straight_tendons(span.span).force_N.norm();
    const double least_Nmm2 = least_stiffness_Nmm2(span.span);
    bound += span.length_mm * linear_compliance_per_N(span.span) * force_N;
    load_length += span.load_length(least_Nmm2, true);
    turn_rad += span.length_mm * span.moment_Nmm / least_Nmm2;
  });
  const double amplification =
      scene::all_loads_follow(spans) ? 1 + load_length * load_length + turn_rad : 1 + load_length / 10;
  return 1.5 * amplification * bound;
}

void turn(Span& span, const Matrix3d& rotation_PB, bool swap) {
  const bool turns = rotation_PB(1, 1) != 1;
  const auto turned = [&](Vector3d& v, bool is_turn) {
    if (turns) v = rotation_PB * v;
    (is_turn ? v[1] : v[2]) = 0;
  };
  for (scene::Wrench* wrench : {&span.follower_load_S, &span.fixed_load_B}) {
    turned(wrench->force_N, false);
    turned(wrench->moment_Nmm, true);
  }
  if (turns) {
    span.fixed_force_arms_BS_Nmm = rotation_PB * span.fixed_force_arms_BS_Nmm * rotation_PB.transpose();
    for (scene::SectionTendon& tendon : span.tendons) tendon.arm_S_mm = rotation_PB * tendon.arm_S_mm;
  }
  turned(span.follower_force_S_N_per_mm, false);
  turned(span.fixed_force_B_N_per_mm, false);
  turned(span.rest_curvature_per_mm, true);
  if (swap) {
    span.stiffness.bending_Nmm2.reverseInPlace();
    if (span.stiffness.shear_N) span.stiffness.shear_N->reverseInPlace();
  }
}

const char* in_words(RodChoice::Why why) {
  switch (why) {
    case RodChoice::Why::asked_for: return "rod model as asked for";
    case RodChoice::Why::does_not_give_way: return "no shear: the sections neither shear nor stretch";
    case RodChoice::Why::does_not_matter:
      return "no shear: shear and stretch move the tip by less than a quarter of the tolerance";
    case RodChoice::Why::may_matter: break;
  }
  return "shear: the sections shear or stretch, and it may matter";
}

}  // namespace

void turn_into_plane(std::span<const Span> spans, const Choice& choice, scene::Reused<Span>& turned) {
  const bool swap = (*choice.plane)[0] == 0 && !scene::is_isotropic(spans);
  turned.assign(spans);
  for (Span& span : turned) turn(span, choice.rotation_BP.transpose(), swap);
}

void leave_out_torsion(std::span<const Span> spans, scene::Reused<Span>& without) {
  without.assign(spans);
  for (Span& span : without) span.stiffness.torsion_Nmm2 = span.stiffness.bending_Nmm2[0];
}

double twist_per_Nmm2(const Span& span) {
  return 1 / span.stiffness.torsion_Nmm2 - 1 / span.stiffness.bending_Nmm2[0];
}

double compliance_left_out(const scene::Scene& scene) {
  double shift_mm_per_N = 0, bent_mm_per_N = 0, to_tip_mm = scene::length_mm(scene);
  for (const scene::Section& section : scene.sections) {
    Span span;
    span.stiffness = scene::stiffness_of(section);
    shift_mm_per_N += section.length_mm * linear_compliance_per_N(span);
    const double beyond_mm = to_tip_mm - section.length_mm;
    bent_mm_per_N += (std::pow(to_tip_mm, 3) - std::pow(beyond_mm, 3)) / (3 * span.stiffness.bending_Nmm2.minCoeff());
    to_tip_mm = beyond_mm;
  }
  return shift_mm_per_N / bent_mm_per_N;
}

double linear_strain_bound(std::span<const Span> spans) {
  double largest = 0;
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& span) {
    const double force_N = span.force_N + straight_tendons(span.span).force_N.norm();
    largest = std::max(largest, linear_compliance_per_N(span.span) * force_N);
  });
  return largest;
}

RodChoice choose_rod(std::span<const Span> spans, RodModel wanted, double tolerance_mm) {
  using enum RodChoice::Why;
  if (wanted != RodModel::automatic) return {wanted, 0, asked_for};
  const bool gives_way = std::any_of(spans.begin(), spans.end(),
                                     [](const Span& span) { return span.stiffness.axial_N || span.stiffness.shear_N; });
  if (!gives_way) return {RodModel::kirchhoff, 0, does_not_give_way};
  const double bound_mm = shear_bound_mm(spans);
  if (bound_mm <= left_out_share * tolerance_mm) return {RodModel::kirchhoff, bound_mm, does_not_matter};
  return {RodModel::reissner, 0, may_matter};
}

namespace {

template <class Stiffness>
void set_arcs(std::span<const Span> spans, bool planar, std::vector<int>& arcs, double factor,
              Stiffness&& stiffness_Nmm2) {
  arcs.assign(spans.size(), 1);
  walk_from_tip(spans, OneEach{}, [&](const LoadedCell& cell) {
    const Span& span = cell.span;
    const double load_length = cell.load_length(stiffness_Nmm2(span), !planar);
    const double moment_Nmm = cell.moment_Nmm + straight_tendons(span).moment_Nmm.norm();
    const double turn_rad =
        cell.length_mm * (span.rest_curvature_per_mm.norm() + moment_Nmm / span.stiffness.bending_Nmm2.minCoeff());
    // Where no force acts the strain is constant, or an Euler top's, and turns matter little.
    const double by_turn = cell.force_N > 0 ? turn_rad / first_turn_rad : 0;
    const double wanted =
        std::ceil(factor * std::max(load_length / first_load_length, by_turn));  // NaN where numbers overflow
    const double most = factor * most_first_arcs;
    arcs[cell.span_index] = std::max(1, static_cast<int>(wanted < most ? wanted : most));
  });
}

}  // namespace

void set_first_arcs(std::span<const Span> spans, bool planar, std::vector<int>& arcs, double factor) {
  set_arcs(spans, planar, arcs, factor, least_stiffness_Nmm2);
}

void set_first_arcs_hardly_bent(std::span<const Span> spans, std::vector<int>& arcs) {
  set_arcs(spans, false, arcs, 1, across_stiffness_Nmm2);
}

double arcs_factor(Law law, double tolerance_over_L) {
  return std::clamp(std::pow(first_arcs_error / tolerance_over_L, 1.0 / facts_of(law).order), 1.0, 1e5);
}

double allowed_swing_rad(Law law, double tolerance_over_L) {
  return first_turn_rad / arcs_factor(law, tolerance_over_L);
}

Choice choose(std::span<const Span> spans, const Options& options, double tolerance_mm) {
  Choice choice;
  choice.law = chosen(options.law);
  choice.law_asked_for = options.law == choice.law;
  const bool coupled = facts_of(choice.law).coupled;
  if (coupled) choice.plane = scene::plane_direction(spans);
  if (choice.plane) {
    const double c = (*choice.plane)[0], s = (*choice.plane)[1];
    choice.rotation_BP << 1, 0, 0, 0, c, -s, 0, s, c;
  }
  choice.round = coupled && !choice.plane && scene::is_round(spans);
  const bool needs_kirchhoff = options.model == RodModel::automatic && !coupled;
  choice.rod =
      choose_rod(spans, needs_kirchhoff ? RodModel::kirchhoff : options.model, options.arcs == 0 ? tolerance_mm : 0);
  choice.march = scene::all_loads_follow(spans);
  choice.constant_strains = coupled && strains_are_constant(spans, choice.plane.has_value());
  return choice;
}

std::string reason(const Choice& choice) {
  return std::string(choice.plane ? "planar: all loads and rest curvatures lie in one plane; " : "spatial; ") +
         in_words(choice.rod.why) + "; " +
         (choice.law_asked_for ? "law as asked for"
                               : "sixth_order: an arc costs no more than a fourth_order one and fewer do") +
         (choice.march ? "; march: all loads follow the rod" : "; boundary value: a load is fixed in space");
}

}  // namespace fam
