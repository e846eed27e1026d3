#include "scene/section.h"

#include <numbers>

namespace scene {

Stiffness stiffness_of(const CircularSection& section) {
  const double outer = section.outer_diameter_mm;
  const double inner = section.inner_diameter_mm;
  const double nu = section.poissons_ratio;
  const double shear_modulus = section.youngs_modulus_MPa / (2 * (1 + nu));
  const double area = std::numbers::pi / 4 * (outer - inner) * (outer + inner);
  const double second_moment = area / 16 * (outer * outer + inner * inner);

  const double r2 = (inner / outer) * (inner / outer);
  const double thick = (1 + r2) * (1 + r2);
  const double cowper = 6 * (1 + nu) * thick / ((7 + 6 * nu) * thick + (20 + 12 * nu) * r2);

  Stiffness stiffness;
  stiffness.torsion_Nmm2 = shear_modulus * 2 * second_moment;
  stiffness.bending_Nmm2.setConstant(section.youngs_modulus_MPa * second_moment);
  stiffness.axial_N = section.youngs_modulus_MPa * area;
  stiffness.shear_N = Eigen::Vector2d::Constant(cowper * shear_modulus * area);
  stiffness.mass_per_length_kg_per_m = section.density_kg_per_m3 * area * 1e-6;  // mm^2 to m^2
  return stiffness;
}

Stiffness stiffness_of(const Section& section) {
  if (const auto* circular = std::get_if<CircularSection>(&section.cross_section)) return stiffness_of(*circular);
  return std::get<Stiffness>(section.cross_section);
}

Eigen::Vector3d curvature_per_mm(const Section& section, const Eigen::Vector3d& moment_S_Nmm) {
  const Stiffness stiffness = stiffness_of(section);
  const Eigen::Vector3d stiffnesses_Nmm2(stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]);
  return section.rest_curvature_per_mm + moment_S_Nmm.cwiseQuotient(stiffnesses_Nmm2);
}

}  // namespace scene
