// Where the sources of fam/response.h act, and the slopes that they give to the arcs there.
#include "fam/response.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

constexpr double same_part = 1e-12;  // of an arc: the place is the arc's end

}  // namespace

std::size_t Response::span_ending_at(double s_mm) const {
  const auto& spans = solution_.spans;
  const auto above = std::lower_bound(spans.begin(), spans.end() - 1, s_mm,
                                      [](const scene::Span& span, double s) { return span.end_mm < s; });
  const auto i = static_cast<std::size_t>(above - spans.begin());
  return i > 0 && s_mm - above->start_mm < above->end_mm - s_mm ? i - 1 : i;
}

Response::Place Response::place_of(double s_mm) const {
  const auto& spans = solution_.spans;
  const double length_mm = spans.back().end_mm;
  if (!(s_mm >= 0 && s_mm <= length_mm * (1 + scene::same_place_relative))) return {};
  std::size_t i = 0;
  while (i + 1 < spans.size() && s_mm > spans[i].end_mm + scene::same_place_relative * length_mm) ++i;
  const double arcs = (s_mm - spans[i].start_mm) / arc_length_mm(i);
  const double end = std::clamp(std::ceil(arcs - same_part), 1.0, static_cast<double>(solution_.arcs_per_span[i]));
  const double part = end - arcs;
  return {i, first_arcs_[i] + static_cast<std::size_t>(end) - 1, part > same_part ? part : 0, true};
}

// Whether the source changes an arc of this span.
bool Response::acts_in(const Source& source, std::size_t i) const {
  const scene::Span& span = solution_.spans[i];
  const double middle_mm = (span.start_mm + span.end_mm) / 2;
  switch (source.kind) {
    case Kind::rest_curvature:
    case Kind::stiffness: return section_of_span_[i] == source.index;
    case Kind::tension: return middle_mm < std::get<scene::Tendon>(solution_.scene->loads[source.index]).to_mm;
    case Kind::distributed:
      if (const auto* force = std::get_if<scene::DistributedForce>(&solution_.scene->loads[source.index])) {
        return force->from_mm < middle_mm && middle_mm < force->to_mm;
      }
      return span.stiffness.mass_per_length_kg_per_m > 0;
    default: return false;
  }
}

bool Response::brings_forces(const Source& source, std::size_t i) const {
  return source.kind == Kind::distributed && acts_in(source, i);
}

VariedConstants<Dual<3>> Response::seeded_constants(const Source& source, std::size_t i, double length_mm) {
  const scene::Span& span = solution_.spans[i];
  VariedConstants<Dual<3>> constants = varied_constants<Dual<3>>(span, length_mm, solution_.model);
  const bool acts = acts_in(source, i);
  std::size_t tendons = 0;
  for (const scene::SectionTendon& tendon : span.tendons)
    seeded_tendons_[tendons++] = {tendon.arm_S_mm, tendon.tension_N};
  if (acts && source.kind == Kind::tension) {
    const Eigen::Vector2d& offset_mm = std::get<scene::Tendon>(solution_.scene->loads[source.index]).offset_mm;
    const Vector3d arm_mm(0, offset_mm[0], offset_mm[1]);
    std::size_t same = 0;
    while (same < tendons && seeded_tendons_[same].arm_mm != arm_mm) ++same;
    if (same == tendons) seeded_tendons_[tendons++] = {arm_mm, 0.0};  // it is slack
    seeded_tendons_[same].tension_N.slope[0] = 1;
  }
  constants.tendons = {seeded_tendons_.data(), tendons};
  const scene::Stiffness& stiffness = span.stiffness;
  const Vector3d angular(stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]);
  for (int axis = 0; acts && axis < 3; ++axis) {
    if (source.kind == Kind::rest_curvature) constants.rest_rotation[axis].slope[axis] = length_mm;
    if (source.kind == Kind::stiffness) {
      constants.angular_compliance[axis].slope[axis] = -length_mm / (angular[axis] * angular[axis]);
    }
  }
  return constants;
}

ArcForces<Dual<3>, 3> Response::seeded_forces(const Source& source, std::size_t i, double length_mm,
                                              const Matrix3d& rotation_BS, const Matrix3d& fixed_slopes_B) const {
  const scene::Span& span = solution_.spans[i];
  Matrix3d follower = Matrix3d::Zero(), fixed_B = fixed_slopes_B;
  if (brings_forces(source, i)) {
    const auto* force = std::get_if<scene::DistributedForce>(&solution_.scene->loads[source.index]);
    if (!force) fixed_B += 1e-3 * span.stiffness.mass_per_length_kg_per_m * length_mm * Matrix3d::Identity();
    else if (force->frame == scene::Frame::fixed) fixed_B += length_mm * Matrix3d::Identity();
    else follower = length_mm * Matrix3d::Identity();
  }
  const Matrix3d to_section = rotation_BS.transpose();
  return {with_slopes<3>(length_mm * span.follower_force_S_N_per_mm, follower),
          with_slopes<3>(to_section * (length_mm * span.fixed_force_B_N_per_mm), to_section * fixed_B)};
}

}  // namespace fam
