// New loads, places, rest curvatures and stiffnesses of a Solver.
#include "fam/solver_impl.h"

#include "scene/load_visitor.h"

#include <cmath>
#include <string_view>

namespace fam {
namespace {

// A value that the scene format refuses, as it does: on a copy, so that the scene stays as it is.
template <class Change>
[[noreturn]] void refuse(scene::Scene copy, Change&& change) {
  change(copy);
  scene::validate(copy);
  throw scene::SceneError("scene: a value is refused");
}

std::string name_of(std::size_t load) {
  return "scene: loads[" + std::to_string(load) + "]";
}

// The load of this kind, whose value is good.
template <class Kind>
Kind& kind_of(scene::Scene& scene, std::size_t load) {
  if (load >= scene.loads.size())
    throw scene::SceneError(name_of(load) + ": there are " + std::to_string(scene.loads.size()) + " loads");
  const char* const wanted = scene::kind_name(Kind{});
  if (std::string_view(scene::kind_name(scene.loads[load])) != wanted)
    throw scene::SceneError(name_of(load) + ".kind = " + scene::kind_name(scene.loads[load]) + ": must be " + wanted);
  return std::get<Kind>(scene.loads[load]);
}

scene::Section& section_of(scene::Scene& scene, std::size_t section) {
  if (section >= scene.sections.size())
    throw scene::SceneError("scene: rod.sections[" + std::to_string(section) + "]: there are " +
                            std::to_string(scene.sections.size()) + " sections");
  return scene.sections[section];
}

bool is_a_moment(const scene::Load& load) {
  return std::string_view(scene::kind_name(load)) == scene::kind_name(scene::Moment{});
}

template <class Kind, class Value>
void set_value(scene::Scene& scene, std::size_t load, Value Kind::*field, const Value& value, bool is_good) {
  Kind& kind = kind_of<Kind>(scene, load);
  if (!is_good) refuse(scene, [&](scene::Scene& copy) { kind_of<Kind>(copy, load).*field = value; });
  kind.*field = value;
}

}  // namespace

void Solver::set_force_N(std::size_t load, const Vector3d& force_N) {
  set_value(impl_->scene, load, &scene::Force::value_N, force_N, force_N.allFinite());
}
void Solver::set_moment_Nmm(std::size_t load, const Vector3d& moment_Nmm) {
  set_value(impl_->scene, load, &scene::Moment::value_Nmm, moment_Nmm, moment_Nmm.allFinite());
}
void Solver::set_distributed_N_per_mm(std::size_t load, const Vector3d& force_N_per_mm) {
  set_value(impl_->scene, load, &scene::DistributedForce::value_N_per_mm, force_N_per_mm, force_N_per_mm.allFinite());
}
void Solver::set_acceleration_m_per_s2(std::size_t load, const Vector3d& acceleration_m_per_s2) {
  set_value(impl_->scene, load, &scene::Gravity::acceleration_m_per_s2, acceleration_m_per_s2,
            acceleration_m_per_s2.allFinite());
}
void Solver::set_tension_N(std::size_t load, double tension_N) {
  set_value(impl_->scene, load, &scene::Tendon::tension_N, tension_N, std::isfinite(tension_N) && tension_N >= 0);
}
void Solver::set_at_mm(std::size_t load, double s_mm) {
  const double length_mm = scene::length_mm(impl_->scene), hair_mm = length_mm * scene::same_place_relative;
  const bool is_good = s_mm > hair_mm && s_mm <= length_mm + hair_mm;
  const bool is_moment = load < impl_->scene.loads.size() && is_a_moment(impl_->scene.loads[load]);
  if (is_moment) set_value(impl_->scene, load, &scene::Moment::at_mm, s_mm, is_good);
  else set_value(impl_->scene, load, &scene::Force::at_mm, s_mm, is_good);
}
void Solver::set_rest_curvature_per_mm(std::size_t section, const Vector3d& rest_curvature_per_mm) {
  section_of(impl_->scene, section);
  if (!rest_curvature_per_mm.allFinite())
    refuse(impl_->scene,
           [&](scene::Scene& copy) { copy.sections[section].rest_curvature_per_mm = rest_curvature_per_mm; });
  section_of(impl_->scene, section).rest_curvature_per_mm = rest_curvature_per_mm;
}
void Solver::set_stiffness_Nmm2(std::size_t section, const Vector3d& GJ_EIy_EIz_Nmm2) {
  const auto put = [&](scene::Scene& scene) {
    scene::Section& changed = section_of(scene, section);
    scene::Stiffness stiffness = scene::stiffness_of(changed);
    stiffness.torsion_Nmm2 = GJ_EIy_EIz_Nmm2[0];
    stiffness.bending_Nmm2 = GJ_EIy_EIz_Nmm2.tail<2>();
    changed.cross_section = stiffness;
  };
  section_of(impl_->scene, section);
  if (!(GJ_EIy_EIz_Nmm2.allFinite() && GJ_EIy_EIz_Nmm2.minCoeff() > 0)) refuse(impl_->scene, put);
  put(impl_->scene);
  impl_->choose_model();
}

}  // namespace fam
