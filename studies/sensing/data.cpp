#include "studies/sensing/data.h"

#include "studies/scenes/sensing_problem.h"

#include <fmt/format.h>

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

}  // namespace studies
