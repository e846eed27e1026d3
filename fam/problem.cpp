#include "fam/problem.h"

#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace fam {
namespace {

using scene::Span;

template <class V>
void enlarge(V& a, const V& b) {
  if (b.squaredNorm() > a.squaredNorm()) a = b;
}

void enlarge(scene::Wrench& a, const scene::Wrench& b) {
  enlarge(a.force_N, b.force_N);
  enlarge(a.moment_Nmm, b.moment_Nmm);
}

void enlarge(std::vector<scene::SectionTendon>& tendons, const std::vector<scene::SectionTendon>& others) {
  for (const scene::SectionTendon& other : others) {
    const auto same = std::find_if(tendons.begin(), tendons.end(),
                                   [&](const scene::SectionTendon& t) { return t.arm_S_mm == other.arm_S_mm; });
    if (same == tendons.end()) tendons.push_back(other);
    else same->tension_N = std::max(same->tension_N, other.tension_N);
  }
}

}  // namespace

void set_larger(std::span<const Span> a, std::span<const Span> b, scene::Reused<Span>& larger) {
  larger.assign(a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    Span& span = larger[i];
    span.stiffness.torsion_Nmm2 = std::min(span.stiffness.torsion_Nmm2, b[i].stiffness.torsion_Nmm2);
    span.stiffness.bending_Nmm2 = span.stiffness.bending_Nmm2.cwiseMin(b[i].stiffness.bending_Nmm2);
    enlarge(span.rest_curvature_per_mm, b[i].rest_curvature_per_mm);
    enlarge(span.follower_load_S, b[i].follower_load_S);
    enlarge(span.fixed_load_B, b[i].fixed_load_B);
    enlarge(span.fixed_force_arms_BS_Nmm, b[i].fixed_force_arms_BS_Nmm);
    enlarge(span.follower_force_S_N_per_mm, b[i].follower_force_S_N_per_mm);
    enlarge(span.fixed_force_B_N_per_mm, b[i].fixed_force_B_N_per_mm);
    enlarge(span.tendons, b[i].tendons);
  }
}

void Problem::reserve(const scene::Scene& scene, const Room& room) {
  cutter_.reserve(scene, 2);
  for (Spans* spans : {&given_, &solved_}) {
    for (scene::Reused<Span>* list : {&spans->from, &spans->to, &spans->bounds}) {
      list->reserve(room.spans, [&](Span& span) { span.tendons.reserve(room.tendons); });
    }
  }
}

void validate(const Options& options) {
  const auto refuse = [](const char* what, double value, const char* rule) {
    std::ostringstream why;
    why << "options." << what << " = " << value << ": " << rule;
    throw scene::SceneError(why.str());
  };
  const double tolerance_mm = options.tolerance_mm;
  if (!(tolerance_mm >= 0 && std::isfinite(tolerance_mm)))
    refuse("tolerance_mm", tolerance_mm, "must be finite and >= 0");
  if (options.arcs < 0) refuse("arcs", options.arcs, "must be >= 0");
  if (options.arcs > max_arcs) refuse("arcs", options.arcs, "must be <= 1000000");
  if (options.reserved_arcs < 0) refuse("reserved_arcs", options.reserved_arcs, "must be >= 0");
  if (options.threads < 0) refuse("threads", options.threads, "must be >= 0");
}

void Problem::take(const scene::Scene& scene, const Options& options) {
  validate(options);
  scene_ = scene;
  options_ = options;
  tolerance_mm_ = fam::tolerance_mm(options, scene::length_mm(scene));
}

void Problem::set(const scene::Scene& scene, const Options& options) {
  take(scene, options);
  const scene::Scene* const scenes[] = {&scene_};
  cutter_.cut(scenes);
  cutter_.fill(scene_, given_.to);
  choice_ = choose(given_.to, options, tolerance_mm_);
  set_way(true);
}

// In the plane only where both loads lie in the one that the rod was solved in; in space with its own GJ.
void Problem::set(const scene::Scene& scene, const Options& options, const Problem& before) {
  take(scene, options);
  const scene::Scene* const scenes[] = {&scene_, &before.scene_};
  cutter_.cut(scenes);
  cutter_.fill(scene_, given_.to);
  cutter_.fill(before.scene_, given_.from);
  set_larger(given_.to, given_.from, given_.bounds);
  choice_ = choose(given_.bounds, options, tolerance_mm_);
  choice_.march = scene::all_loads_follow(given_.to);
  choice_.round = false;
  const std::optional<Eigen::Vector2d>& plane = before.choice_.plane;
  const auto lies_in_it = [&](std::span<const Span> spans) {
    const std::optional<Eigen::Vector2d> direction = scene::plane_direction(spans);
    return plane && direction && (*direction == *plane || *direction == -*plane || scene::needs_no_plane(spans));
  };
  const bool stays_in_plane = lies_in_it(given_.from) && lies_in_it(given_.to);
  choice_.plane = stays_in_plane ? plane : std::nullopt;
  choice_.rotation_BP = stays_in_plane ? before.choice_.rotation_BP : Matrix3d::Identity();
  set_way(false);
}

void Problem::leave_plane() {
  choice_.plane.reset();
  choice_.rotation_BP.setIdentity();
  set_way(false);
}

void Problem::set_way(bool from_no_load) {
  const auto prepared = [this](const scene::Reused<Span>& given, scene::Reused<Span>& solved) -> std::span<const Span> {
    if (choice_.plane) turn_into_plane(given, choice_, solved);
    else if (choice_.round) leave_out_torsion(given, solved);
    else return given;
    return solved;
  };
  if (from_no_load) {
    given_.from.assign(given_.to);
    for (Span& span : given_.from) span.unload();
  }
  way_.from = prepared(given_.from, solved_.from);
  way_.to = prepared(given_.to, solved_.to);
  way_.bounds = from_no_load ? way_.to : prepared(given_.bounds, solved_.bounds);
}

}  // namespace fam
