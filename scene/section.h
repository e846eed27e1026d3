// Sections of a rod: stiffness from numbers, or from geometry and material.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <variant>

namespace scene {

// Stiffness of a cross-section about its own axes x (tangent), y, z.
// A missing axial or shear stiffness means that the section does not stretch or shear.
struct Stiffness {
  double torsion_Nmm2 = 0;                 // GJ
  Eigen::Vector2d bending_Nmm2{0, 0};      // EI about y, EI about z
  std::optional<double> axial_N;           // EA
  std::optional<Eigen::Vector2d> shear_N;  // kGA along y, along z
  double mass_per_length_kg_per_m = 0;     // 0: gravity does not act
};

// Solid circle (inner diameter 0) or tube of one isotropic material.
struct CircularSection {
  double outer_diameter_mm = 0;
  double inner_diameter_mm = 0;
  double youngs_modulus_MPa = 0;
  double poissons_ratio = 0;
  double density_kg_per_m3 = 0;
};

// A piece of rod with one cross-section.
struct Section {
  double length_mm = 0;
  std::variant<Stiffness, CircularSection> cross_section;
  // Strain of the unloaded rod in the section frame: (torsion, bending y, bending z).
  Eigen::Vector3d rest_curvature_per_mm = Eigen::Vector3d::Zero();
};

// All six stiffnesses of a circle or tube. Shear coefficient of Cowper (1966), eqs. for the circular and the
// hollow circular section: k = 6(1+nu)(1+r^2)^2 / ((7+6nu)(1+r^2)^2 + (20+12nu) r^2), r = inner/outer diameter.
Stiffness stiffness_of(const CircularSection& section);

// The section's stiffness, however it was given.
Stiffness stiffness_of(const Section& section);

// Torsion, bending about y and z: what the section has at rest and what the rod's own moment adds.
Eigen::Vector3d curvature_per_mm(const Section& section, const Eigen::Vector3d& moment_S_Nmm);

}  // namespace scene
