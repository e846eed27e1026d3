// Where the sources of fam/response.h act, and the slopes that they give to the arcs there.
#include "fam/response.h"

#include "scene/load_visitor.h"

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

TendonArms Response::tendon_arms(const Source& source, std::size_t i) const {
  const scene::Span& span = solution_.spans[i];
  TendonArms arms;
  std::size_t ordinal = 0;
  for (const scene::Load& load : solution_.scene->loads) {
    const scene::Tendon* tendon = scene::tendon_of(load);
    if (!tendon) continue;
    const bool passes = (span.start_mm + span.end_mm) / 2 < tendon->to_mm;
    if (passes && ordinal / 3 == source.index) {
      arms[ordinal % 3] = Vector3d(0, tendon->offset_mm[0], tendon->offset_mm[1]);
    }
    ++ordinal;
  }
  return arms;
}

// Whether the source changes an arc of this span.
bool Response::acts_in(const Source& source, std::size_t i) const {
  const scene::Span& span = solution_.spans[i];
  const double middle_mm = (span.start_mm + span.end_mm) / 2;
  switch (source.kind) {
    case Kind::rest_curvature:
    case Kind::stiffness: return solution_.section_of_span[i] == source.index;
    case Kind::tension: {
      const TendonArms arms = tendon_arms(source, i);
      return arms[0] || arms[1] || arms[2];
    }
    case Kind::distributed:
      if (const scene::DistributedForce* force = distributed(source)) {
        return force->from_mm < middle_mm && middle_mm < force->to_mm;
      }
      return span.stiffness.mass_per_length_kg_per_m > 0;
    default: return false;
  }
}

// Null: of gravity.
const scene::DistributedForce* Response::distributed(const Source& source) const {
  return scene::visit_load(
      solution_.scene->loads[source.index],
      [](const scene::Force&) -> const scene::DistributedForce* { return nullptr; },
      [](const scene::Moment&) -> const scene::DistributedForce* { return nullptr; },
      [](const scene::DistributedForce& force) { return &force; },
      [](const scene::Gravity&) -> const scene::DistributedForce* { return nullptr; },
      [](const scene::Tendon&) -> const scene::DistributedForce* { return nullptr; });
}

bool Response::brings_forces(const Source& source, std::size_t i) const {
  return source.kind == Kind::distributed && acts_in(source, i);
}

void Response::add_source(const Source& source, std::size_t i, double length_mm, const Matrix3d& rotation_BS,
                          ArcChange<3>& change) const {
  if (!acts_in(source, i)) return;
  if (source.kind == Kind::rest_curvature) change.constant = Constant::rest_curvature;
  if (source.kind == Kind::stiffness) change.constant = Constant::stiffness;
  if (source.kind == Kind::tension) {
    change.constant = Constant::tension;
    change.tendon_arms = tendon_arms(source, i);
  }
  if (source.kind != Kind::distributed) return;
  const scene::DistributedForce* force = distributed(source);
  if (force && force->frame == scene::Frame::follower) {
    change.follower_S_N += length_mm * Matrix3d::Identity();
  } else {
    const double mass = 1e-3 * solution_.spans[i].stiffness.mass_per_length_kg_per_m;  // kg/m m/s^2 = 1e-3 N/mm
    change.fixed_D_N += (force ? 1 : mass) * length_mm * rotation_BS.transpose();
  }
}

void Response::set_constants(std::size_t i, double length_mm) {
  const scene::Span& span = solution_.spans[i];
  fam::set_constants(constants_, tendons_, {span, span}, length_mm, solution_.model);
}

ArcForces<double, 3> Response::forces_on(std::size_t i, double length_mm, const Matrix3d& rotation_BS) const {
  const scene::Span& span = solution_.spans[i];
  return {length_mm * span.follower_force_S_N_per_mm,
          rotation_BS.transpose() * (length_mm * span.fixed_force_B_N_per_mm)};
}

}  // namespace fam
