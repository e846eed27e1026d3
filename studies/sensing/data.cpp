#include "studies/sensing/data.h"

#include "fam/estimator.h"
#include "studies/scenes/sensing_problem.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace studies {
namespace {

constexpr int published_truths = 100;
constexpr double published_noise_mm = 0.1, published_noise_per_mm = 1e-4;

// Of a problem's measurements, all numbers in a row.
std::string numbers_of(const std::vector<scene::Measurement>& measurements) {
  std::string row;
  for (const scene::Measurement& measurement : measurements) {
    if (const auto* position = std::get_if<scene::PositionMeasurement>(&measurement.value)) {
      for (const double x : position->position_B_mm) row += fmt::format(",{:.6f}", x);
    } else if (const auto* curvature = std::get_if<scene::CurvatureMeasurement>(&measurement.value)) {
      for (const double x : curvature->curvature_S_per_mm) row += fmt::format(",{:.9f}", x);
    }
  }
  return row;
}

std::string head_of(const std::vector<scene::Measurement>& measurements, bool noisy_ones) {
  std::string head;
  for (const scene::Measurement& measurement : measurements) {
    const bool is_position = std::holds_alternative<scene::PositionMeasurement>(measurement.value);
    for (const char* axis :
         is_position ? std::vector<const char*>{"x", "y", "z"} : std::vector<const char*>{"uy", "uz"})
      head += fmt::format(",{}{}_{:g}", noisy_ones ? "noisy_" : "", axis, measurement.s_mm);
  }
  return head;
}

std::string set_of(Sensing kind, double noise, const std::filesystem::path& cases) {
  std::string text;
  for (std::uint64_t seed = 1; seed <= published_truths; ++seed) {
    const SensingProblem problem = sensing_problem(kind, seed, noise, cases);
    const std::vector<scene::Measurement>& exact = problem.estimation.scenes[0].measurements;
    Noise random(1'000'000 + seed);
    std::vector<scene::Measurement> measured;
    for (const scene::Measurement& measurement : exact) measured.push_back(noisy(measurement, random));
    if (seed == 1) {
      text = "seed";
      for (const scene::Unknown& unknown : problem.estimation.unknowns) {
        std::string name = scene::name_of(unknown, problem.estimation);
        text += "," + name.substr(0, name.find(','));
      }
      text += head_of(exact, false) + head_of(exact, true) + "\n";
    }
    text += std::to_string(seed);
    for (const double value : problem.truth) text += fmt::format(",{:.6f}", value);
    text += numbers_of(exact) + numbers_of(measured) + "\n";
  }
  return text;
}

const char* const readme = R"(# Synthetic shapes with known loads

No measured force is here: shapes are the exact reference's, noise is added from seeds. Under the project's licence.

A rod of 40 mm, EI 1500 N mm^2, GJ 1000 N mm^2, straight, clamped at the origin along x; fixed forces. A row a rod: its seed, the
true unknowns (N, mm), the exact measurements, and the same with noise. Columns end with the place s in mm.

- [four_positions.csv](four_positions.csv): a tip force; positions in mm at four places, noise 0.1 mm.
- [two_contacts.csv](two_contacts.csv): two forces across the rod and their places; curvatures u_y, u_z in 1/mm at twenty places,
  noise 1e-4 /mm.

Seeds 1 to 100 make the truths, those and 10^6 the noise: `studies/scenes/sensing_problem.cpp`.
)";

}  // namespace

std::map<std::string, std::string> sensing_data(const std::filesystem::path& cases) {
  return {{"data/README.md", readme},
          {"data/four_positions.csv", set_of(Sensing::four_positions, published_noise_mm, cases)},
          {"data/two_contacts.csv", set_of(Sensing::two_contacts, published_noise_per_mm, cases)}};
}

Table observability_table(int digits) {
  constexpr double length_mm = 40, bending_Nmm2 = 1500, unit_N = bending_Nmm2 / (length_mm * length_mm);
  const std::vector<double> angles_deg{0, 10, 45, 90}, sizes{0.01, 0.1, 1};
  std::vector<std::string> head{"force at, L", "size, EI/L²"};
  for (const double angle : angles_deg) head.push_back(fmt::format("{:g}° to the rod", angle));
  Table table(head);
  for (const double place : {1e-7, 0.1, 0.25, 0.5, 1.0}) {
    for (const double size : sizes) {
      std::vector<std::string> cells{fmt::format("{:g}", place), fmt::format("{:g}", size)};
      for (const double angle_deg : angles_deg) {
        const double angle = angle_deg * std::numbers::pi / 180;
        const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
        scene::Scene scene;
        scene::Stiffness stiffness;
        stiffness.bending_Nmm2.setConstant(bending_Nmm2);
        stiffness.torsion_Nmm2 = 1000;
        scene.sections = {{length_mm, stiffness, Eigen::Vector3d::Zero()}};
        scene.loads = {scene::Force{place * length_mm, scene::Frame::fixed, size * unit_N * along}};
        fam::Options fine;
        fine.tolerance_mm = 1e-7;
        const scene::Equilibrium answer = fam::solve(scene, fine);
        scene::EstimationProblem problem{
            {{scene, {{length_mm, scene::PositionMeasurement{answer.tip().position_B_mm, 0.01}}}}}, {}};
        for (const int axis : {0, 1, 2}) {
          problem.unknowns.push_back({scene::Unknown::Kind::component, 0, 0, axis});
          problem.unknowns.back().prior_mean = size * unit_N * along[axis];
        }
        const fam::Estimate found = fam::Estimator(problem).estimate();
        double variance = 0;
        for (const int i : {0, 1, 2})
          for (const int k : {0, 1, 2})
            if (along[i] * along[k] != 0) variance += along[i] * along[k] * found.covariance(i, k);
        const bool known = found.converged() && std::isfinite(variance);
        cells.push_back(known ? significant(std::sqrt(variance) / (size * unit_N), digits) : "–");
      }
      table.add(cells);
    }
  }
  return table;
}

}  // namespace studies
