#include "studies/scenes/sensing_problem.h"

#include "exact_reference/solve.h"
#include "scene/load_visitor.h"
#include "studies/scenes/cases.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace studies {
namespace {

using Eigen::Vector3d;
using Kind = scene::Unknown::Kind;

// A nitinol wire of some 0.45 mm, as the tests' rod.
constexpr double sensed_L_mm = 40, sensed_EI_Nmm2 = 1500, sensed_GJ_Nmm2 = 1000;
constexpr double force_unit_N = sensed_EI_Nmm2 / (sensed_L_mm * sensed_L_mm);
// Of the base's moment and of the tip's rotation, beside force and position. Chosen.
constexpr double lever_mm = 10;
constexpr double tip_noise_over_L = 2e-3;  // of the position beside sensors of curvature; chosen

scene::Scene rod_under(std::vector<scene::Load> loads) {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2 = {sensed_EI_Nmm2, sensed_EI_Nmm2};
  stiffness.torsion_Nmm2 = sensed_GJ_Nmm2;
  scene::Scene scene;
  scene.sections = {{sensed_L_mm, stiffness, Vector3d::Zero()}};
  scene.loads = std::move(loads);
  return scene;
}

scene::Force fixed_force(double at_mm, const Vector3d& value_N) {
  return {at_mm, scene::Frame::fixed, value_N};
}

// Across the rod, in any direction, of a size in EI/L^2.
Vector3d transverse_N(Noise& random, double least, double most) {
  const double size_N = force_unit_N * random.uniform(least, most);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return {0, size_N * std::cos(angle), size_N * std::sin(angle)};
}

Vector3d tip_force_N(Noise& random) {
  const Vector3d across_N = transverse_N(random, 0.2, 2);
  return across_N + Vector3d(force_unit_N * random.uniform(-0.5, 0.5), 0, 0);
}

void change(scene::Scene& world, Mismatch mismatch) {
  auto* stiffness = std::get_if<scene::Stiffness>(&world.sections[0].cross_section);
  switch (mismatch) {
    case Mismatch::none: break;
    case Mismatch::stiffer:
      stiffness->bending_Nmm2 /= 1.05;  // so that the model is 5 % stiffer
      stiffness->torsion_Nmm2 /= 1.05;
      break;
    case Mismatch::load_missing:
      world.loads.push_back(fixed_force(0.5 * sensed_L_mm, {0, 0.1 * force_unit_N, 0}));
      break;
    case Mismatch::thick_rod:  // as thick as a tenth of its length, of Poisson's ratio 0.3: EA and GA over EI
      stiffness->axial_N = sensed_EI_Nmm2 * 16 / std::pow(0.1 * sensed_L_mm, 2);
      stiffness->shear_N.emplace(Eigen::Vector2d::Constant(0.9 / 2.6 * *stiffness->axial_N));
      break;
  }
}

scene::Equilibrium exact_shape(const scene::Scene& world) {
  const bool is_thick = std::holds_alternative<scene::Stiffness>(world.sections[0].cross_section) &&
                        std::get<scene::Stiffness>(world.sections[0].cross_section).axial_N.has_value();
  const auto model = is_thick ? scene::RodModel::reissner : scene::RodModel::kirchhoff;
  scene::Equilibrium exact = exact_reference::solve(world, {model, 1e-10});
  if (!exact.converged()) throw std::runtime_error("sensing: the exact reference says " + exact.message);
  return exact;
}

const scene::Station& station_near(const scene::Equilibrium& exact, double s_mm) {
  return *std::min_element(exact.stations.begin(), exact.stations.end(),
                           [&](const scene::Station& a, const scene::Station& b) {
                             return std::abs(a.s_mm - s_mm) < std::abs(b.s_mm - s_mm);
                           });
}

scene::Measurement position(const scene::Station& station, double sd_mm) {
  return {station.s_mm, scene::PositionMeasurement{station.X_BS.position_B_mm, sd_mm}};
}

scene::Measurement rotation(const scene::Station& station, double sd_rad) {
  return {station.s_mm, scene::RotationMeasurement{station.X_BS.rotation_BS, sd_rad}};
}

scene::Measurement curvature(const scene::Station& station, double sd_per_mm) {
  const Vector3d moment_S_Nmm = station.X_BS.rotation_BS.transpose() * station.moment_B_Nmm;
  return {station.s_mm, scene::CurvatureMeasurement{moment_S_Nmm.tail<2>() / sensed_EI_Nmm2, sd_per_mm}};
}

std::vector<scene::Measurement> measured(Sensing kind, const scene::Equilibrium& exact, double noise, int positions) {
  std::vector<scene::Measurement> result;
  const double length_mm = exact.stations.back().s_mm;
  const auto evenly = [&](int count) {
    for (int i = 1; i <= count; ++i) result.push_back(position(station_near(exact, length_mm * i / count), noise));
  };
  switch (kind) {
    case Sensing::tip_pose:
    case Sensing::calibration:
      evenly(1);
      result.push_back(rotation(exact.stations.back(), noise / lever_mm));
      break;
    case Sensing::four_positions: evenly(positions); break;
    case Sensing::catheter: evenly(20); break;
    case Sensing::two_contacts:
      for (int i = 0; i < 20; ++i)
        result.push_back(curvature(station_near(exact, length_mm * (2 * i + 1) / 40), noise));
      break;
    case Sensing::placed_force:
    case Sensing::placed_moment:
      for (int i = 1; i <= positions; ++i)
        result.push_back(curvature(station_near(exact, length_mm * i / (positions + 1)), noise));
      result.push_back(position(exact.stations.back(), tip_noise_over_L * length_mm));
      break;
    case Sensing::base_wrench: {
      const scene::Station& base = exact.base();
      const scene::Wrench wrench_B{base.force_B_N, base.moment_B_Nmm};
      result.push_back({0, scene::BaseWrenchMeasurement{wrench_B, noise, noise * lever_mm}});
    }
  }
  return result;
}

std::vector<scene::Scene> worlds(Sensing kind, Noise& random, const std::filesystem::path& cases) {
  switch (kind) {
    case Sensing::catheter: return {read_case(cases, "study2/study2")};
    case Sensing::two_contacts: {
      const double first = random.uniform(0.2, 0.4), second = random.uniform(first + 0.2, 0.8);
      const Vector3d first_N = transverse_N(random, 0.5, 1.5), second_N = transverse_N(random, 0.5, 1.5);
      return {rod_under({fixed_force(first * sensed_L_mm, first_N), fixed_force(second * sensed_L_mm, second_N)})};
    }
    case Sensing::placed_force:
    case Sensing::placed_moment: {
      const double at_mm = random.uniform(0.2, 0.95) * sensed_L_mm;
      const Vector3d force_N = transverse_N(random, 0.5, 1.5);
      if (kind == Sensing::placed_force) return {rod_under({fixed_force(at_mm, force_N)})};
      return {rod_under({scene::Moment{at_mm, scene::Frame::fixed, sensed_L_mm * force_N}})};
    }
    case Sensing::calibration: {
      std::vector<scene::Scene> poses;
      for (int i = 0; i < 5; ++i) {
        const scene::Moment twist{sensed_L_mm, scene::Frame::follower, {sensed_EI_Nmm2 / sensed_L_mm / 2, 0, 0}};
        poses.push_back(rod_under({fixed_force(sensed_L_mm, tip_force_N(random)), twist}));
      }
      return poses;
    }
    default: return {rod_under({fixed_force(sensed_L_mm, tip_force_N(random))})};
  }
}

std::vector<scene::Unknown> unknowns_of(Sensing kind, std::size_t loads) {
  if (kind == Sensing::calibration) return {{Kind::bending_factor}, {Kind::torsion_factor}};
  std::vector<scene::Unknown> unknowns;
  const bool placed = kind == Sensing::two_contacts || kind == Sensing::placed_force || kind == Sensing::placed_moment;
  const bool across = placed || kind == Sensing::catheter;
  for (std::size_t load = 0; load < loads; ++load) {
    for (int axis = across; axis < 3; ++axis) unknowns.push_back({Kind::component, 0, load, axis});
    if (placed) unknowns.push_back({Kind::place, 0, load});
  }
  return unknowns;
}

// What an estimator knows before it looks: next to no force, contacts at a third and two thirds, factors of 1.
void forget(Sensing kind, scene::EstimationProblem& problem) {
  std::size_t contact = 0;
  for (scene::Unknown& unknown : problem.unknowns) {
    const bool is_place = unknown.kind == Kind::place;
    const bool is_force = unknown.kind == Kind::component;
    double start = is_place ? sensed_L_mm * static_cast<double>(++contact) / 3 : is_force ? 0 : 1;
    if (kind == Sensing::two_contacts && is_force) start = 0.1 * force_unit_N;
    scene::put(problem, unknown, start);
    unknown.prior_mean = start;
  }
}

}  // namespace

double Noise::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
}

double Noise::normal() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
  return radius * std::cos(uniform(0, 2 * std::numbers::pi));
}

const SensingWords& words_of(Sensing kind) {
  static const SensingWords words[] = {
      {"tip_pose", "tip force from the tip's pose", "mm", {0.01, 0.03, 0.1, 0.3, 1}},
      {"four_positions", "tip force from four positions", "mm", {0.01, 0.03, 0.1, 0.3, 1}},
      {"two_contacts", "two contacts and their places from twenty curvatures", "1/mm", {1e-5, 1e-4, 1e-3}},
      {"catheter", "three forces on Study II's catheter from twenty positions", "mm", {0.01, 0.03, 0.1, 0.3, 1}},
      {"base_wrench", "tip force from the base's wrench", "N", {0.001, 0.01, 0.1}},
      {"calibration", "EI and GJ from five poses of the tip", "mm", {0.01, 0.1, 1}},
      {"placed_force", "a force and its place from curvatures and the tip's position", "1/mm", {1e-5, 1e-4}},
      {"placed_moment", "a moment and its place from curvatures and the tip's position", "1/mm", {1e-5, 1e-4}}};
  return words[static_cast<int>(kind)];
}

SensingProblem sensing_problem(Sensing kind, std::uint64_t seed, double noise, const std::filesystem::path& cases,
                               Mismatch mismatch, int positions) {
  Noise random(seed);
  SensingProblem problem;
  for (const scene::Scene& model : worlds(kind, random, cases)) {
    scene::Scene world = model;
    change(world, mismatch);
    problem.estimation.scenes.push_back({model, measured(kind, exact_shape(world), noise, positions)});
  }
  problem.estimation.unknowns = unknowns_of(kind, problem.estimation.scenes[0].scene.loads.size());
  problem.truth.resize(static_cast<Eigen::Index>(problem.estimation.unknowns.size()));
  for (Eigen::Index i = 0; i < problem.truth.size(); ++i)
    problem.truth[i] = scene::value_in(problem.estimation, problem.estimation.unknowns[static_cast<std::size_t>(i)]);
  forget(kind, problem.estimation);
  return problem;
}

scene::Measurement noisy(scene::Measurement measurement, Noise& noise) {
  const auto some = [&](double sd) {
    Vector3d result;
    for (double& x : result) x = sd * noise.normal();
    return result;
  };
  if (auto* position_of = std::get_if<scene::PositionMeasurement>(&measurement.value)) {
    position_of->position_B_mm += some(position_of->sd_mm);
  } else if (auto* rotation_of = std::get_if<scene::RotationMeasurement>(&measurement.value)) {
    const Vector3d turn = some(rotation_of->sd_rad);
    rotation_of->rotation_BS *= Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  } else if (auto* curvature_of = std::get_if<scene::CurvatureMeasurement>(&measurement.value)) {
    curvature_of->curvature_S_per_mm += some(curvature_of->sd_per_mm).head<2>();
  } else if (auto* wrench_of = std::get_if<scene::BaseWrenchMeasurement>(&measurement.value)) {
    wrench_of->wrench_B.force_N += some(wrench_of->sd_N);
    wrench_of->wrench_B.moment_Nmm += some(wrench_of->sd_Nmm);
  }
  return measurement;
}

}  // namespace studies
