// A rod, what exact shapes of it measure, and noise.
#pragma once

#include "scene/equilibrium.h"
#include "scene/estimation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace estimation_support {

inline constexpr double L_mm = 40, EI_Nmm2 = 1500, GJ_Nmm2 = 1000;

inline scene::Scene rod_under(std::vector<scene::Load> loads) {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2 = {EI_Nmm2, EI_Nmm2};
  stiffness.torsion_Nmm2 = GJ_Nmm2;
  scene::Scene scene;
  scene.sections = {{L_mm, stiffness, Eigen::Vector3d::Zero()}};
  scene.loads = std::move(loads);
  return scene;
}

inline scene::Force force(double at_mm, const Eigen::Vector3d& value_N) {
  return {at_mm, scene::Frame::fixed, value_N};
}

// The exact station nearest to a place.
inline scene::Station exact_station(const scene::Equilibrium& exact, double s_mm) {
  return *std::min_element(exact.stations.begin(), exact.stations.end(),
                           [&](const scene::Station& a, const scene::Station& b) {
                             return std::abs(a.s_mm - s_mm) < std::abs(b.s_mm - s_mm);
                           });
}

inline scene::Measurement position(const scene::Station& station, double sd_mm) {
  return {station.s_mm, scene::PositionMeasurement{station.X_BS.position_B_mm, sd_mm}};
}

inline scene::Measurement curvature(const scene::Station& station, double sd_per_mm) {
  const Eigen::Vector3d moment_S_Nmm = station.X_BS.rotation_BS.transpose() * station.moment_B_Nmm;
  return {station.s_mm, scene::CurvatureMeasurement{moment_S_Nmm.tail<2>() / EI_Nmm2, sd_per_mm}};
}

}  // namespace estimation_support
