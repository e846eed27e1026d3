// What a user of the installed library writes: a rod bent by a moment at its tip into a quarter of a circle.
#include <fam/solve.h>

#include <cmath>
#include <cstdio>
#include <numbers>

int main() {
  scene::Section section;
  section.length_mm = 100;
  scene::CircularSection circle;
  circle.outer_diameter_mm = 2;
  circle.youngs_modulus_MPa = 1000;
  circle.poissons_ratio = 0.3;
  section.cross_section = circle;
  scene::Scene scene;
  scene.sections = {section};
  const double bending_Nmm2 = scene::stiffness_of(section).bending_Nmm2[1];
  const double moment_Nmm = std::numbers::pi / 2 * bending_Nmm2 / section.length_mm;
  scene.loads = {scene::Moment{100, scene::Frame::follower, {0, 0, moment_Nmm}}};
  scene::validate(scene);

  const scene::Equilibrium result = fam::solve(scene);
  if (!result.converged()) return 1;
  const double radius_mm = 200 / std::numbers::pi;
  const Eigen::Vector3d miss_mm = result.tip().position_B_mm - Eigen::Vector3d(radius_mm, radius_mm, 0);
  std::printf("tip %.6f mm off a quarter of a circle\n", miss_mm.norm());
  return miss_mm.norm() < 1e-6 ? 0 : 1;
}
