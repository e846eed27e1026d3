#include "scene/json_file.h"
#include "scene/load_visitor.h"
#include "scene/scene_file.h"

namespace scene {
namespace {

template <class Vector>
Json list(const Vector& values) {
  Json array = Json::array();
  for (int i = 0; i < values.size(); ++i) array.push_back(values[i]);
  return array;
}

const char* name(Frame frame) {
  return frame == Frame::follower ? "follower" : "fixed";
}

Json place(double at_mm, double length) {
  return at_mm == length ? Json("tip") : Json(at_mm);
}

Json write(const Stiffness& stiffness) {
  Json json{{"bending_Nmm2", list(stiffness.bending_Nmm2)}, {"torsion_Nmm2", stiffness.torsion_Nmm2}};
  if (stiffness.axial_N) json["axial_N"] = *stiffness.axial_N;
  if (stiffness.shear_N) json["shear_N"] = list(*stiffness.shear_N);
  if (stiffness.mass_per_length_kg_per_m > 0) json["mass_per_length_kg_per_m"] = stiffness.mass_per_length_kg_per_m;
  return json;
}

Json write(const Section& section) {
  Json json{{"length_mm", section.length_mm}};
  if (const auto* circle = std::get_if<CircularSection>(&section.cross_section)) {
    json["geometry"] = {{"outer_diameter_mm", circle->outer_diameter_mm},
                        {"inner_diameter_mm", circle->inner_diameter_mm}};
    json["material"] = {{"youngs_modulus_MPa", circle->youngs_modulus_MPa}, {"poissons_ratio", circle->poissons_ratio}};
    if (circle->density_kg_per_m3 > 0) json["material"]["density_kg_per_m3"] = circle->density_kg_per_m3;
  } else {
    json["stiffness"] = write(std::get<Stiffness>(section.cross_section));
  }
  if (!section.rest_curvature_per_mm.isZero(0)) json["rest_curvature_per_mm"] = list(section.rest_curvature_per_mm);
  return json;
}

struct LoadWriter {
  double length;

  Json operator()(const Force& force) const {
    Json json{{"kind", kind_name(force)},
              {"at", place(force.at_mm, length)},
              {"frame", name(force.frame)},
              {"value_N", list(force.value_N)}};
    if (!force.offset_mm.isZero(0)) json["offset_mm"] = list(force.offset_mm);
    return json;
  }
  Json operator()(const Moment& moment) const {
    return {{"kind", kind_name(moment)},
            {"at", place(moment.at_mm, length)},
            {"frame", name(moment.frame)},
            {"value_Nmm", list(moment.value_Nmm)}};
  }
  Json operator()(const DistributedForce& force) const {
    return {{"kind", kind_name(force)},
            {"from_mm", force.from_mm},
            {"to_mm", force.to_mm},
            {"frame", name(force.frame)},
            {"value_N_per_mm", list(force.value_N_per_mm)}};
  }
  Json operator()(const Gravity& gravity) const {
    return {{"kind", kind_name(gravity)}, {"acceleration_m_per_s2", list(gravity.acceleration_m_per_s2)}};
  }
  Json operator()(const Tendon& tendon) const {
    return {{"kind", kind_name(tendon)},
            {"offset_mm", list(tendon.offset_mm)},
            {"tension_N", tendon.tension_N},
            {"to_mm", tendon.to_mm}};
  }
};

}  // namespace

std::string write_scene(const Scene& scene) {
  Json json;
  if (!scene.title.empty()) json["title"] = scene.title;
  json["rod"]["sections"] = Json::array();
  for (const Section& section : scene.sections) json["rod"]["sections"].push_back(write(section));
  json["loads"] = Json::array();
  for (const Load& load : scene.loads) json["loads"].push_back(std::visit(LoadWriter{length_mm(scene)}, load));
  return json.dump(2) + "\n";
}

}  // namespace scene
