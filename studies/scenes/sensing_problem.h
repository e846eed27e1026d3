// Problems with a known answer: a rod's exact shape, where it is measured, and what is to be found.
#pragma once

#include "scene/estimation.h"

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace studies {

// Normal numbers that are the same with every standard library: Box and Muller's pairs.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high);
  double normal();

 private:
  std::mt19937_64 engine_;
};

// The last two, with some sensors of curvature, are a table of their own.
enum class Sensing {
  tip_pose,
  four_positions,
  two_contacts,
  catheter,
  base_wrench,
  calibration,
  placed_force,
  placed_moment
};
constexpr Sensing all_sensing[] = {Sensing::tip_pose, Sensing::four_positions, Sensing::two_contacts,
                                   Sensing::catheter, Sensing::base_wrench,    Sensing::calibration};

struct SensingWords {
  const char *name, *question, *unit;
  std::vector<double> noises;  // standard deviations, the first so small that the problem is nearly linear
};
const SensingWords& words_of(Sensing kind);

// How the world differs from the estimator's model of it.
enum class Mismatch { none, stiffer, load_missing, thick_rod };

struct SensingProblem {
  scene::EstimationProblem estimation;  // from nothing known, with what is measured without noise
  Eigen::VectorXd truth;                // of the unknowns
};

// With standard deviations as `noise` says. Positions: how many, of four_positions; of placed_force and placed_moment
// sensors of curvature, beside the tip's position. Throws std::runtime_error where the
// exact reference finds no shape. Cases: the folder of the scene files.
SensingProblem sensing_problem(Sensing kind, std::uint64_t seed, double noise, const std::filesystem::path& cases,
                               Mismatch mismatch = Mismatch::none, int positions = 4);

// The measurement with noise of its standard deviation.
scene::Measurement noisy(scene::Measurement measurement, Noise& noise);

}  // namespace studies
