// What the stations say, against the loads: balance of force and moment at every one of them, from the returned shape
// alone; where they stand; and the error estimate against the error of each.
#include "fem_beam.h"
#include "scene/span.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using fem_beam::two_sections;
using fem_benchmark::bare;
using fem_benchmark::solved;
using scene::DistributedForce;
using scene::Force;
using scene::Frame;
using scene::Moment;
using scene::Station;
using scene::Tendon;
using support::slender;
using support::uniform_rod;

struct Pull {
  Vector3d force_B_N = Vector3d::Zero();
  Vector3d moment_B_Nmm = Vector3d::Zero();  // about the station
};

// A solved rod's stations, and which of them are ends of spans.
struct Stations {
  std::vector<Station> at;
  std::vector<bool> is_end;

  Stations(const scene::Scene& scene, const scene::Equilibrium& found) : at(found.stations) {
    for (const Station& station : at) {
      const std::vector<scene::Span> spans = scene::spans_of(scene);
      is_end.push_back(std::any_of(spans.begin(), spans.end(),
                                   [&](const scene::Span& span) { return span.end_mm == station.s_mm; }));
    }
  }
};

// int f(station) ds from a to b, which are stations: parabolas through three neighbours of one span.
template <class Function>
Vector3d integral(const Stations& rod, double a_mm, double b_mm, const Function& f) {
  const std::vector<Station>& stations = rod.at;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const double from = stations[i].s_mm, to = stations[i + 1].s_mm;
    if (from < a_mm - 1e-9 || to > b_mm + 1e-9) continue;
    const std::size_t third = rod.is_end[i + 1] ? i - 1 : i + 2;
    const double x = to - from, h = stations[third].s_mm - from;
    const Vector3d f0 = f(stations[i]), f1 = f(stations[i + 1]), f2 = f(stations[third]);
    // f0 + slope s + curve s^2 on 0..x.
    const Vector3d curve = ((f2 - f0) / h - (f1 - f0) / x) / (h - x);
    const Vector3d slope = (f1 - f0) / x - curve * x;
    sum += x * f0 + x * x / 2 * slope + x * x * x / 3 * curve;
  }
  return sum;
}

// What the loads beyond a station and its own point loads exert about its place.
struct LoadsBeyond {
  const Stations& rod;
  const Station& here;
  const scene::Scene& scene;
  Pull sum{};

  void add(const Vector3d& force_B, const Vector3d& place_B) {
    sum.force_B_N += force_B;
    sum.moment_B_Nmm += (place_B - here.X_BS.position_B_mm).cross(force_B);
  }
  bool is_beyond(double at_mm) const { return at_mm > here.s_mm - 1e-9; }
  const scene::Pose& pose(double at_mm) const {
    return std::find_if(rod.at.begin(), rod.at.end(), [&](const Station& s) { return s.s_mm > at_mm - 1e-9; })->X_BS;
  }
  void distribute(double from_mm, double to_mm, const Vector3d& force, bool follower) {
    const double start_mm = std::max(from_mm, here.s_mm);
    if (start_mm > to_mm - 1e-9) return;
    const auto density = [&](const Station& s) -> Vector3d {
      return follower ? Vector3d(s.X_BS.rotation_BS * force) : force;
    };
    sum.force_B_N += integral(rod, start_mm, to_mm, density);
    sum.moment_B_Nmm += integral(rod, start_mm, to_mm, [&](const Station& s) -> Vector3d {
      return (s.X_BS.position_B_mm - here.X_BS.position_B_mm).cross(density(s));
    });
  }

  void operator()(const Force& force) {
    if (!is_beyond(force.at_mm)) return;
    const scene::Pose& X = pose(force.at_mm);
    const Vector3d arm_B = X.rotation_BS * Vector3d(0, force.offset_mm[0], force.offset_mm[1]);
    add(force.frame == Frame::fixed ? force.value_N : Vector3d(X.rotation_BS * force.value_N), X.position_B_mm + arm_B);
  }
  void operator()(const Moment& moment) {
    if (!is_beyond(moment.at_mm)) return;
    sum.moment_B_Nmm +=
        moment.frame == Frame::fixed ? moment.value_Nmm : Vector3d(pose(moment.at_mm).rotation_BS * moment.value_Nmm);
  }
  void operator()(const DistributedForce& force) {
    distribute(force.from_mm, force.to_mm, force.value_N_per_mm, force.frame == Frame::follower);
  }
  void operator()(const scene::Gravity& gravity) {
    double start_mm = 0;
    for (const scene::Section& section : scene.sections) {
      const double mass_kg_per_mm = scene::stiffness_of(section).mass_per_length_kg_per_m * 1e-3;
      distribute(start_mm, start_mm + section.length_mm, mass_kg_per_mm * gravity.acceleration_m_per_s2, false);
      start_mm += section.length_mm;
    }
  }
  // A tendon that passes the station is cut there and pulls it towards the clamp; at its end it still does.
  void operator()(const Tendon& tendon) {
    if (tendon.to_mm < here.s_mm - 1e-9) return;
    double end_mm = 0;
    const scene::Section* section = nullptr;
    for (std::size_t i = 0; i < scene.sections.size() && (!section || end_mm < here.s_mm - 1e-9); ++i) {
      section = &scene.sections[i];
      end_mm += section->length_mm;
    }
    const scene::Stiffness k = scene::stiffness_of(*section);
    const Eigen::Matrix3d& R = here.X_BS.rotation_BS;
    const Vector3d n = R.transpose() * here.force_B_N, m = R.transpose() * here.moment_B_Nmm;
    const Vector3d u = section->rest_curvature_per_mm +
                       m.cwiseQuotient(Vector3d(k.torsion_Nmm2, k.bending_Nmm2[0], k.bending_Nmm2[1]));
    const Vector3d v(1 + (k.axial_N ? n[0] / *k.axial_N : 0), k.shear_N ? n[1] / (*k.shear_N)[0] : 0,
                     k.shear_N ? n[2] / (*k.shear_N)[1] : 0);
    const Vector3d r(0, tendon.offset_mm[0], tendon.offset_mm[1]);
    add(-tendon.tension_N * (R * (v + u.cross(r)).normalized()), here.X_BS.position_B_mm + R * r);
  }
};

struct Imbalance {
  double force_N = 0;
  double moment_Nmm = 0;
};

// How far the stations' wrenches are from the loads beyond them, at most.
Imbalance imbalance(const scene::Scene& scene, const scene::Equilibrium& found) {
  const Stations rod(scene, found);
  Imbalance worst;
  for (const Station& station : rod.at) {
    LoadsBeyond loads{rod, station, scene};
    for (const scene::Load& load : scene.loads) std::visit(loads, load);
    worst.force_N = std::max(worst.force_N, (station.force_B_N - loads.sum.force_B_N).norm());
    worst.moment_Nmm = std::max(worst.moment_Nmm, (station.moment_B_Nmm - loads.sum.moment_B_Nmm).norm());
  }
  return worst;
}

struct Balanced {
  scene::Scene scene;
  // Limits. Balance is exact on any mesh: round-off, measured 2e-13 and 8e-13 at most; but for the integrals of
  // distributed loads over the stations, whose measured error is half of the limits given.
  double force_N = 1e-11;
  double moment_Nmm = 1e-10;
};

std::vector<Balanced> balanced_scenes() {
  const Force fixed{40, Frame::fixed, {-0.2, 0.5, 0.3}}, offset{33, Frame::fixed, {0.3, -0.2, 0.4}, {2, -1}};
  const Force along{17, Frame::fixed, {0.1, 0.6, -0.4}};
  const Force follower{28, Frame::follower, {0.2, 0.3, -0.3}, {1, 2}};
  const Moment axial{40, Frame::fixed, {8, -3, 5}}, turning{12, Frame::follower, {4, 9, -6}};
  const DistributedForce wind{5, 31, Frame::fixed, {0.004, 0.02, -0.01}};
  const DistributedForce flow{10, 40, Frame::follower, {0.003, -0.02, 0.015}};
  const scene::Gravity gravity{{1, -9.81, 3}};
  const Tendon first{{2, 0}, 4, 40}, second{{-1, 1.7}, 6, 30}, third{{-1, -1.7}, 2.5, 40};
  const scene::Stiffness stiff = slender(750, 500);
  return {{uniform_rod(40, stiff, {fixed})},
          {uniform_rod(40, stiff, {offset, along})},
          {uniform_rod(40, stiff, {fixed, offset, axial})},
          {two_sections({fixed, offset, along, axial})},
          {uniform_rod(40, stiff, {first, second, third})},
          {uniform_rod(40, stiff, {first, second, fixed, axial})},
          {two_sections({first, second, third, offset, along})},
          {two_sections({follower, turning, fixed})},
          {two_sections({follower, turning, first, second, offset})},
          {two_sections({gravity}), 1e-11, 1.1e-7},
          {two_sections({gravity, wind, first, second, offset}), 1e-11, 1.6e-6},
          {two_sections({flow, fixed}), 1.6e-7, 4.9e-6},
          {two_sections({flow, wind, gravity, first, third, offset, follower, turning, axial}), 4.8e-7, 1e-5}};
}

TEST(FemBalance, EveryStationCarriesTheLoadsBeyondIt) {
  int number = 0;
  for (const Balanced& balanced : balanced_scenes()) {
    const auto [force_N, moment_Nmm] = imbalance(balanced.scene, solved(balanced.scene));
    EXPECT_LT(force_N, balanced.force_N) << number;
    EXPECT_LT(moment_Nmm, balanced.moment_Nmm) << number;
    ++number;
  }
}

// The twin: the loads of a scene, one of them 5 % larger, against the stations without that.
TEST(FemBalance, OtherLoadsAreNotBalanced) {
  scene::Scene scene = two_sections({Tendon{{2, 0}, 4, 40}, Force{33, Frame::fixed, {0.3, -0.2, 0.4}, {2, -1}}});
  const scene::Equilibrium found = solved(scene);
  std::get<Force>(scene.loads[1]).value_N *= 1.05;
  EXPECT_GT(imbalance(scene, found).force_N, 0.01);
  EXPECT_GT(imbalance(scene, found).moment_Nmm, 0.1);
}

TEST(FemBalance, WhereAllLoadsAreFixedTheBaseCarriesTheirSum) {
  for (const int elements : {1, 5, 50}) {
    const scene::Equilibrium found =
        solved(uniform_rod(40, slender(750, 500),
                           {Force{40, Frame::fixed, {-0.02, 0.05, 0.03}, {2, -1}},
                            DistributedForce{0, 40, Frame::fixed, {0.001, 0.002, -0.003}}}),
               bare(elements));
    EXPECT_LT((found.base().force_B_N - Vector3d(0.02, 0.13, -0.09)).norm(), 1e-10) << elements;
  }
}

TEST(FemBalance, StationsStandAtTheNodesTheSpanEndsAndEveryFortiethPart) {
  for (const int elements : {3, 37, 50}) {
    const scene::Scene scene = two_sections({Force{33.3, Frame::fixed, {0, 0.3, 0}}, Tendon{{1, 0}, 1, 12.34}});
    const std::vector<Station> stations = solved(scene, bare(elements, 3)).stations;
    const auto has = [&](double s_mm, double within) {
      return std::any_of(stations.begin(), stations.end(),
                         [&](const Station& station) { return std::abs(station.s_mm - s_mm) <= within; });
    };
    for (const double end_mm : {0.0, 12.34, 25.0, 33.3, 40.0}) EXPECT_TRUE(has(end_mm, 0)) << end_mm;
    for (int k = 0; k <= 40; ++k) EXPECT_TRUE(has(k, 1e-12 * 40)) << k;
    EXPECT_GE(stations.size(), std::size_t(3 * elements + 1));
    for (std::size_t i = 1; i < stations.size(); ++i) EXPECT_GT(stations[i].s_mm, stations[i - 1].s_mm + 1e-9);
  }
}

TEST(FemBalance, TheEstimateBoundsTheErrorOfEveryStation) {
  for (const Balanced& balanced : balanced_scenes()) {
    const scene::Equilibrium fine = fem_benchmark::fine(balanced.scene);
    for (const int order : {1, 2, 3}) {
      fem_reference::Options options = bare(32, order);
      options.estimate_error = true;
      const scene::Equilibrium found = solved(balanced.scene, options);
      const double error_mm = fem_benchmark::largest_error_mm(found, fine);
      EXPECT_GE(found.error_estimate_mm, error_mm) << order;
      EXPECT_LE(found.error_estimate_mm, 10 * error_mm) << order;
    }
  }
}

}  // namespace
