// What the finite element tests share: solving a scene, and the benchmarks of an independent solver (tests/data).
#pragma once

#include "fem_reference/solve.h"
#include "support.h"

#include <string>
#include <vector>

namespace fem_benchmark {

// Without an error estimate, the second solve.
fem_reference::Options bare(int elements = 50, int order = 2);

// A converged solution, or a failed test and a rod of one station.
scene::Equilibrium solved(const scene::Scene& scene, const fem_reference::Options& options = bare());

// One scene of a JSON file in tests/data with its exact solution; the wrench at the base is the rod's own.
struct Benchmark {
  scene::Scene scene;
  scene::Station tip;
  Eigen::Vector3d base_force_N;
  Eigen::Vector3d base_moment_Nmm;
};
std::vector<Benchmark> read_benchmarks(const std::string& file);

// The largest error of the tip's position over L, of its rotation, and of the base's force and moment over their size.
double error(const scene::Equilibrium& found, const Benchmark& exact);

// The same scene on 160 cubic elements, and the largest distance from it of any station of another mesh that both have:
// s = k L/40, span ends and the nodes in common.
scene::Equilibrium fine(const scene::Scene& scene);
double largest_error_mm(const scene::Equilibrium& found, const scene::Equilibrium& fine);

// Axial vector of the rotation from one section frame to another, rad; for small turns.
Eigen::Vector3d turn(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to);

}  // namespace fem_benchmark
