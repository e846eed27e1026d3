#include "scene/scene.h"
#include "scene/text.h"

#include <array>
#include <cmath>
#include <set>

namespace scene {
namespace {

// Checks one scene; each check names the JSON path of the value it looks at.
class Checker {
 public:
  Checker(const std::string& source, const std::string& path)
      : source_(source), path_(path.empty() ? "" : path + ".") {}

  template <class Value>
  void require(bool rule_holds, const std::string& path, const Value& value, const std::string& rule) const {
    if (!rule_holds) throw SceneError(source_ + ": " + path_ + path + " = " + text(value) + ": " + rule);
  }

  void finite(const std::string& path, double value) const {
    require(std::isfinite(value), path, value, "must be finite");
  }
  template <class Vector>
  void finite(const std::string& path, const Eigen::MatrixBase<Vector>& value) const {
    require(value.allFinite(), path, value, "must be finite");
  }
  void positive(const std::string& path, double value) const {
    require(std::isfinite(value) && value > 0, path, value, "must be > 0");
  }
  void not_negative(const std::string& path, double value) const {
    require(std::isfinite(value) && value >= 0, path, value, "must be >= 0");
  }

  void check(const std::string& path, const Section& section) const {
    positive(path + ".length_mm", section.length_mm);
    finite(path + ".rest_curvature_per_mm", section.rest_curvature_per_mm);
    std::visit([&](const auto& cross_section) { check(path, cross_section); }, section.cross_section);
  }

  void check(const std::string& path, const Stiffness& stiffness) const {
    const std::string of = path + ".stiffness.";
    positive(of + "torsion_Nmm2", stiffness.torsion_Nmm2);
    require(stiffness.bending_Nmm2.allFinite() && (stiffness.bending_Nmm2.array() > 0).all(), of + "bending_Nmm2",
            stiffness.bending_Nmm2, "must be > 0");
    if (stiffness.axial_N) positive(of + "axial_N", *stiffness.axial_N);
    if (stiffness.shear_N) {
      require(stiffness.shear_N->allFinite() && (stiffness.shear_N->array() > 0).all(), of + "shear_N",
              *stiffness.shear_N, "must be > 0");
    }
    not_negative(of + "mass_per_length_kg_per_m", stiffness.mass_per_length_kg_per_m);
  }

  void check(const std::string& path, const CircularSection& circle) const {
    const std::string geometry = path + ".geometry.";
    const std::string material = path + ".material.";
    positive(geometry + "outer_diameter_mm", circle.outer_diameter_mm);
    not_negative(geometry + "inner_diameter_mm", circle.inner_diameter_mm);
    require(circle.inner_diameter_mm < circle.outer_diameter_mm, geometry + "inner_diameter_mm",
            circle.inner_diameter_mm, "must be < outer_diameter_mm = " + text(circle.outer_diameter_mm));
    positive(material + "youngs_modulus_MPa", circle.youngs_modulus_MPa);
    require(circle.poissons_ratio > -1 && circle.poissons_ratio <= 0.5, material + "poissons_ratio",
            circle.poissons_ratio, "must lie in (-1, 0.5]");
    not_negative(material + "density_kg_per_m3", circle.density_kg_per_m3);
    const Stiffness stiffness = stiffness_of(circle);
    const bool usable = std::isfinite(*stiffness.axial_N) && std::isfinite(stiffness.bending_Nmm2[0]) &&
                        stiffness.torsion_Nmm2 > 0 && stiffness.bending_Nmm2[0] > 0;
    require(usable, geometry + "outer_diameter_mm", circle.outer_diameter_mm,
            "the section's stiffness must be a positive double");
  }

  void on_rod(const std::string& path, double at_mm) const {
    require(at_mm > length_mm_ * same_place_relative && at_mm <= length_mm_ * (1 + same_place_relative), path, at_mm,
            "must lie on the rod, 0 < s <= " + text(length_mm_) + " mm");
  }

  void check(const std::string& path, const Force& force) const {
    on_rod(path + ".at", force.at_mm);
    finite(path + ".value_N", force.value_N);
    finite(path + ".offset_mm", force.offset_mm);
  }
  void check(const std::string& path, const Moment& moment) const {
    on_rod(path + ".at", moment.at_mm);
    finite(path + ".value_Nmm", moment.value_Nmm);
  }
  void check(const std::string& path, const DistributedForce& force) const {
    require(force.from_mm >= 0 && force.from_mm < length_mm_, path + ".from_mm", force.from_mm,
            "must lie on the rod, 0 <= s < " + text(length_mm_) + " mm");
    on_rod(path + ".to_mm", force.to_mm);
    require(force.from_mm < force.to_mm, path + ".from_mm", force.from_mm, "must be < to_mm = " + text(force.to_mm));
    finite(path + ".value_N_per_mm", force.value_N_per_mm);
  }
  void check(const std::string& path, const Gravity& gravity) const {
    const std::string acceleration = path + ".acceleration_m_per_s2";
    finite(acceleration, gravity.acceleration_m_per_s2);
    require(has_mass_, acceleration, gravity.acceleration_m_per_s2, "gravity needs a section with a mass");
  }
  void check(const std::string& path, const Tendon& tendon) {
    finite(path + ".offset_mm", tendon.offset_mm);
    tendon_offsets_.insert({tendon.offset_mm[0], tendon.offset_mm[1]});
    require(tendon_offsets_.size() <= max_tendon_offsets, path + ".offset_mm", tendon.offset_mm,
            "at most " + std::to_string(max_tendon_offsets) + " different offsets of tendons");
    not_negative(path + ".tension_N", tendon.tension_N);
    on_rod(path + ".to_mm", tendon.to_mm);
  }

  void check(const Scene& scene) {
    const double sections = static_cast<double>(scene.sections.size());
    require(sections >= 1, "rod.sections", sections, "the rod needs at least one section");
    require(sections <= max_sections, "rod.sections", sections,
            "at most " + std::to_string(max_sections) + " sections");
    const double loads = static_cast<double>(scene.loads.size());
    require(loads <= max_loads, "loads", loads, "at most " + std::to_string(max_loads) + " loads");
    for (std::size_t i = 0; i < scene.sections.size(); ++i) {
      check("rod.sections[" + std::to_string(i) + "]", scene.sections[i]);
      if (stiffness_of(scene.sections[i]).mass_per_length_kg_per_m > 0) has_mass_ = true;
    }
    length_mm_ = length_mm(scene);
    require(std::isfinite(length_mm_), "rod.sections", length_mm_, "the rod's length must be finite");
    for (std::size_t i = 0; i < scene.loads.size(); ++i) {
      const std::string path = "loads[" + std::to_string(i) + "]";
      std::visit([&](const auto& load) { check(path, load); }, scene.loads[i]);
    }
  }

 private:
  const std::string& source_;
  const std::string path_;  // before each path
  double length_mm_ = 0;
  bool has_mass_ = false;
  std::set<std::array<double, 2>> tendon_offsets_;
};

}  // namespace

double length_mm(const Scene& scene) {
  double length = 0;
  for (const Section& section : scene.sections) length += section.length_mm;
  return length;
}

const Section& section_at(const Scene& scene, double s_mm) {
  const double hair_mm = same_place_relative * length_mm(scene);
  double end_mm = 0;
  for (const Section& section : scene.sections) {
    end_mm += section.length_mm;
    if (s_mm <= end_mm + hair_mm) return section;
  }
  return scene.sections.back();
}

void validate(const Scene& scene, const std::string& source, const std::string& path) {
  Checker(source, path).check(scene);
}

}  // namespace scene
