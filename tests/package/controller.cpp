// What a user of the installed library writes: a kept solver, its derivatives and a batch, on a cantilever beam.
#include <fam/solver.h>

#include <cmath>
#include <cstdio>

namespace {

constexpr double length_mm = 100, bending_Nmm2 = 1000;
int failures = 0;

void check(const char* what, double value, double expected, double allowed) {
  if (std::abs(value - expected) <= allowed) return;
  std::printf("%s: %.12g, expected %.12g +- %.1g\n", what, value, expected, allowed);
  ++failures;
}

scene::Scene cantilever() {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2 = {bending_Nmm2, bending_Nmm2};
  stiffness.torsion_Nmm2 = 700;
  scene::Section section;
  section.length_mm = length_mm;
  section.cross_section = stiffness;
  scene::Scene scene;
  scene.sections = {section};
  scene.loads = {scene::Force{length_mm, scene::Frame::fixed, {0, 0, 0}}};
  return scene;
}

// Without load: the compliance of a straight beam, L^3/3EI, L^2/2EI, L/EI and L/GJ.
void check_straight(fam::Solver& solver) {
  if (!solver.solve().converged()) ++failures;
  const Eigen::Matrix<double, 6, 3> by_force = solver.by_load(0, length_mm);
  check("d y / d F_y, mm/N", by_force(1, 1), std::pow(length_mm, 3) / (3 * bending_Nmm2), 1e-7);
  check("d turn z / d F_y, rad/N", by_force(5, 1), std::pow(length_mm, 2) / (2 * bending_Nmm2), 1e-9);
  const Eigen::Matrix<double, 6, 6> compliance = solver.compliance(length_mm);
  check("d turn z / d M_z", compliance(5, 5), length_mm / bending_Nmm2, 1e-10);
  check("d turn x / d M_x", compliance(3, 3), length_mm / 700, 1e-10);
}

// A fixed transverse force of EI/L^2: the tip of Mattiasson (1981), moved by 0.05643 L and 0.30172 L.
void check_bent(fam::Solver& solver) {
  const double force_N = bending_Nmm2 / (length_mm * length_mm);
  solver.set_force_N(0, {0, force_N, 0});
  if (!solver.solve().converged()) ++failures;
  const Eigen::Vector3d tip_mm = solver.tip().position_B_mm;
  check("x / L", tip_mm[0] / length_mm, 1 - 0.05643, 6e-6);
  check("y / L", tip_mm[1] / length_mm, 0.30172, 6e-6);
  check("force at the clamp, N", solver.base_wrench_B().force_N[1], force_N, 1e-9);
  check("moment at the clamp, N mm", solver.base_wrench_B().moment_Nmm[2], force_N * tip_mm[0], 1e-5);

  fam::RowMajorMatrix values(2, 1);
  values << 0, force_N;
  const fam::BatchColumn column{0, 1};
  fam::Options options;
  options.tolerance_mm = 1e-6;
  const fam::BatchResult batch = fam::solve_batch(solver.scene(), {&column, 1}, values, options);
  if (batch.position_mm.rows() != 2) {
    ++failures;
    return;
  }
  check("x of the batch's straight rod", batch.position_mm(0, 0), length_mm, 1e-9);
  check("y of the batch's bent rod", batch.position_mm(1, 1), tip_mm[1], 2e-6);
}

}  // namespace

int main() {
  fam::Options options;
  options.tolerance_mm = 1e-6;
  auto made = fam::Solver::make(cantilever(), options);
  if (const auto* refusal = std::get_if<fam::Refusal>(&made)) {
    std::printf("%s\n", refusal->message.c_str());
    return 1;
  }
  fam::Solver& solver = std::get<fam::Solver>(made);
  check_straight(solver);
  check_bent(solver);
  try {
    solver.set_force_N(1, {0, 0, 0});
    ++failures;
  } catch (const scene::SceneError& error) {
    std::printf("refused as it should be: %s\n", error.what());
  }
  return failures;
}
