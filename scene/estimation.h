// What to find from a rod's measured shape: unknown numbers of scenes, and measurements.
//
// Units and frames as in scene/scene.h.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scene {

// A number of the scenes that is not known.
struct Unknown {
  // component: of a load's value (a tendon's tension: 0); place: of a point load, mm; bending_factor: EI_y and EI_z,
  // torsion_factor: GJ, times those of the scene; rest_curvature: 1/mm, component 1 or 2.
  enum class Kind { component, place, bending_factor, torsion_factor, rest_curvature };
  Kind kind = Kind::component;
  std::size_t scene = 0;  // whose load; sections are those of all scenes
  std::size_t index = 0;  // of the load or the section
  int component = 0;
  double prior_mean = 0;  // where the search begins, too; without a prior the scene's value, 1 of factors
  std::optional<double> prior_sd = std::nullopt;  // none: no prior
};

// Of the section's centre, base frame.
struct PositionMeasurement {
  Eigen::Vector3d position_B_mm;
  double sd_mm;
};
struct RotationMeasurement {
  Eigen::Matrix3d rotation_BS;
  double sd_rad;  // of the turn about each axis
};
// The total u_y, u_z, as fibre sensors give them.
struct CurvatureMeasurement {
  Eigen::Vector2d curvature_S_per_mm;
  double sd_per_mm;
};
// The rod's own, at the clamp; base frame.
struct BaseWrenchMeasurement {
  Wrench wrench_B;
  double sd_N, sd_Nmm;
};
struct Measurement {
  double s_mm = 0;
  std::variant<PositionMeasurement, RotationMeasurement, CurvatureMeasurement, BaseWrenchMeasurement> value;
};

// A rod under loads, and what was measured of it.
struct MeasuredScene {
  Scene scene;
  std::vector<Measurement> measurements;
};

struct EstimationProblem {
  std::vector<MeasuredScene> scenes;  // of one rod
  std::vector<Unknown> unknowns;
};

// Throws SceneError at the first rule of the estimation format that the values break. Paths are those of a file with
// one scene or, `in_list` (of several unless told), with "scenes".
void validate(const EstimationProblem& problem, const std::string& source = "estimation",
              std::optional<bool> in_list = std::nullopt);
// Of one measurement, on a rod of this length; `path` where it stands.
void validate(const Measurement& measurement, double length_mm, const std::string& source, const std::string& path);

// "loads[0].x, N", "sections[1].bending_factor"; with several scenes the load's scene before it.
std::string name_of(const Unknown& unknown, const EstimationProblem& problem);

// Whether it stands at a place that can be found: a force or a moment.
bool has_place(const Load& load);

// The number as the scene has it; 1 of factors.
double value_in(const EstimationProblem& problem, const Unknown& unknown);
// Puts it into the scene, or into all; a factor makes stiffnesses out of a section's geometry.
void put(EstimationProblem& problem, const Unknown& unknown, double value);

}  // namespace scene
