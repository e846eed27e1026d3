// Cables, columns far beyond Euler's load, soft torsion, coils: against the elastica in closed form and the limit of
// the half-infinite elastica. And whether the error estimate is what it says.
#include "exact_reference/elastica.h"
#include "exact_scenes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <chrono>
#include <cmath>
#include <numbers>

using namespace exact_test;
using exact_reference::Elastica;
using exact_reference::Way;
using std::numbers::pi;

namespace {

// Largest distance from a closed form in the plane of the x axis and `side`, mm; infinite if not converged.
double largest_distance_mm(const Elastica& elastica, const scene::Equilibrium& result, const Vector3d& side) {
  if (!result.converged()) return HUGE_VAL;
  double largest = 0;
  for (const scene::Station& station : result.stations) {
    const Vector2d p = elastica.at(station.s_mm).position_B_mm;
    largest = std::max(largest, (station.X_BS.position_B_mm - p[0] * Vector3d::UnitX() - p[1] * side).norm());
  }
  return largest;
}

double distance_under_force_mm(const scene::Scene& rod, const Vector3d& force_N, double EI) {
  const Vector3d side = Vector3d(0, force_N[1], force_N[2]).normalized();
  const auto elastica =
      Elastica::with_fixed_load({scene::length_mm(rod), EI, {force_N[0], force_N.tail<2>().norm()}, 0});
  return elastica ? largest_distance_mm(*elastica, solve(rod), side) : HUGE_VAL;
}

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

// A taut cable is straight but for a layer at the clamp, that of a half-infinite elastica (first integral
// psi' = -2/e sin(psi/2), e^2 = EI/F): the tip is set back by 2 e (1 - cos(psi0/2)) along the force and moved by
// 2 e sin(psi0/2) across; the base moment is 2 EI/e sin(psi0/2). Exact but for exp(-1/e) under a force at the tip; of a
// heavy cable, with its whole weight for F, what is left out is of order e^2.
struct TautCable {
  Vector3d tip_mm;
  double base_moment_Nmm;
};

TautCable taut_cable(const Vector3d& force_N) {  // EI = L = 1
  const Vector3d along = force_N.normalized(), x = Vector3d::UnitX();
  const Vector3d across = (x - x.dot(along) * along).normalized();
  const double half = std::atan2(x.cross(along).norm(), x.dot(along)) / 2, e = 1 / std::sqrt(force_N.norm());
  return {(1 - 2 * e * (1 - std::cos(half))) * along + 2 * e * std::sin(half) * across, 2 / e * std::sin(half)};
}

TEST(ExactExtreme, CablesUnderATipForce) {  // F L^2/EI to 1e6, oblique, in space
  for (const double size : {1e4, 1e5, 1e6}) {
    for (const Vector3d& direction : {Vector3d(-0.3, 0.8, 0.6), Vector3d(-0.95, 0.3, 0.1), Vector3d(-1, 1e-3, 2e-3)}) {
      const Vector3d force = size * direction.normalized();
      const TautCable wanted = taut_cable(force);
      const scene::Scene rod = tip_force(uniform_rod(1, 1, 0.7), Frame::fixed, force);
      const Clock clock;
      const scene::Equilibrium result = solve(rod);
      EXPECT_LT(clock.seconds(), 20);
      ASSERT_TRUE(result.converged()) << result.message;
      EXPECT_LT((tip_mm(result) - wanted.tip_mm).norm(), 1e-12) << size << " " << direction.transpose();
      EXPECT_NEAR(result.base().moment_B_Nmm.norm() / wanted.base_moment_Nmm, 1, 1e-11);
      EXPECT_EQ(result.stable, true);
      EXPECT_GT((tip_mm(solve(stiffer(rod))) - wanted.tip_mm).norm(), 1e-12);
    }
  }
}

TEST(ExactExtreme, HeavyCables) {
  for (const double weight : {1e4, 1e5, 1e6}) {
    for (const Vector3d& down : {Vector3d(-0.3, 0.8, 0.6), Vector3d(-0.95, 0.3, 0.1), Vector3d(0.3, 0.8, -0.6)}) {
      const Vector3d force = weight * down.normalized();
      const TautCable wanted = taut_cable(force);
      const double e = 1 / std::sqrt(weight);
      const auto difference = [&](const scene::Scene& rod) { return (tip_mm(solve(rod)) - wanted.tip_mm).norm(); };
      const scene::Scene rod = with(uniform_rod(1, 1, 0.7), scene::DistributedForce{0, 1, Frame::fixed, force});
      EXPECT_LT(difference(rod), 3 * e * e) << weight << " " << down.transpose();
      EXPECT_GT(difference(stiffer(rod)), 3 * e * e);
      const scene::Equilibrium result = solve(rod);
      EXPECT_NEAR(result.base().moment_B_Nmm.norm(), wanted.base_moment_Nmm, 3);
      EXPECT_EQ(result.stable, true);
    }
  }
}

TEST(ExactExtreme, ColumnsToAThousandTimesEulersLoad) {  // side forces to 1e-12 EI/L^2, GJ/EI from 1e-6
  for (const double times : {1.5, 10.0, 100.0, 1000.0}) {
    for (const double aside : {1e-3, 1e-6, 1e-9, 1e-12}) {
      for (const double torsion : {0.7, 1e-6}) {
        if (torsion < 0.1 && aside != 1e-9) continue;
        const Vector3d force(-times * pi * pi / 4, 0.6 * aside, 0.8 * aside);
        const scene::Scene rod = tip_force(uniform_rod(1, 1, torsion), Frame::fixed, force);
        const Clock clock;
        EXPECT_LT(distance_under_force_mm(rod, force, 1), 1e-11) << times << " " << aside << " " << torsion;
        EXPECT_LT(clock.seconds(), 30);
        EXPECT_NE(solve(rod).stable, false) << times << " " << aside << " " << torsion;
        if (torsion > 0.1) {
          EXPECT_GT(distance_under_force_mm(stiffer(rod), force, 1), 1e-11);
        }
      }
    }
  }
}

// A rod of uniform rest curvature k under a fixed force in its plane is a straight one with the moment EI k at its tip
// besides; a tendon that does not tilt is the curvature T y/EI. Twenty turns.
TEST(ExactExtreme, CoilsUnderAFixedForce) {
  const double L = 100, EI = 1500, offset = 0.2;
  for (const double turns : {2.0, 10.0, 20.0}) {
    const double curvature = 2 * pi * turns / L;
    const Vector2d force(0.10413498, 0.08231014);
    const auto elastica = Elastica::with_fixed_load({L, EI, force, EI * curvature});
    ASSERT_TRUE(elastica.has_value());
    const scene::Scene straight = tip_force(uniform_rod(L, EI, 1153.846), Frame::fixed, {force[0], force[1], 0});
    scene::Scene coiled = straight;
    coiled.sections[0].rest_curvature_per_mm = {0, 0, curvature};
    const scene::Scene pulled = with(straight, scene::Tendon{{offset, 0}, EI * curvature / offset, L});
    for (const scene::Scene& rod : {coiled, pulled}) {
      const Clock clock;
      const scene::Equilibrium result = solve(rod);
      EXPECT_LT(largest_distance_mm(*elastica, result, Vector3d::UnitY()), 1e-10 * L) << turns << result.message;
      EXPECT_LT(clock.seconds(), 30);
      EXPECT_NEAR(result.tip_angle_rad, elastica->tip().angle_rad, 1e-9);
      for (std::size_t k = 1; k < result.stations.size(); ++k) {
        const double ds = result.stations[k].s_mm - result.stations[k - 1].s_mm;
        EXPECT_LT(ds * curvature, 0.55);
      }
      EXPECT_GT(largest_distance_mm(*elastica, solve(stiffer(rod)), Vector3d::UnitY()), 1e-10 * L);
    }
  }
}

// Twenty turns in space, by rest curvature and by a tendon that tilts: what is left of the balance at the clamp.
TEST(ExactExtreme, CoilsInSpaceBalance) {
  const double L = 100, EI = 1500, offset = 0.2, curvature = 2 * pi * 20 / L;
  const Vector3d force(0.10413498, 0.08231014, 0.19127422);
  const scene::Scene straight = tip_force(uniform_rod(L, EI, 1153.846), Frame::fixed, force);
  scene::Scene coiled = straight;
  coiled.sections[0].rest_curvature_per_mm = {0, 0, curvature};
  const scene::Equilibrium result = solve(coiled);
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_LT((result.base().force_B_N - force).norm(), 1e-12);
  EXPECT_LT((result.base().moment_B_Nmm - tip_mm(result).cross(force)).norm(), 1e-10);
  EXPECT_GT((result.base().moment_B_Nmm - 1.05 * tip_mm(result).cross(force)).norm(), 1e-10);

  const double tension = EI * curvature / offset;
  const scene::Equilibrium pulled = solve(with(straight, scene::Tendon{{offset, 0}, tension, L}));
  ASSERT_TRUE(pulled.converged()) << pulled.message;
  const Vector3d m = pulled.base().moment_B_Nmm, r(0, offset, 0);
  const Vector3d t = Vector3d::UnitX() + m.cwiseQuotient(Vector3d(1153.846, EI, EI)).cross(r);
  const Vector3d pull = tension * t.normalized();
  EXPECT_LT((pulled.base().force_B_N + pull - force).norm(), 1e-9);
  EXPECT_LT((m + r.cross(pull) - tip_mm(pulled).cross(force)).norm(), 1e-8);
}

TEST(ExactExtreme, WorkLimitIsAStatus) {  // a thin strip twisted by a hundred thousand turns
  const scene::Scene rod =
      tip_moment(tip_force(uniform_rod(1, 1, 1e-6), Frame::fixed, {0, 1, 1}), Frame::fixed, {1, 0.1, 0});
  const scene::Equilibrium result = solve(rod);
  EXPECT_EQ(result.status, scene::Status::work_limit) << result.message;
  EXPECT_TRUE(result.stations.empty());
}

// The estimate bounds the largest error of any station, and is no smaller than it says: the change of the whole shape
// between two meshes, the coarser one's error, 2^8 times the answer's; between two marches of ten times the tolerance.
TEST(ExactExtreme, EstimateIsThatOfTheWholeShape) {
  const Vector3d side = Vector3d::UnitY();
  double bound = HUGE_VAL, march = HUGE_VAL;  // least estimate over error
  for (const double w : {2.0, 5.0, 12.0, 25.0}) {
    for (const double direction : {0.9, 1.6, 2.5}) {
      const Vector2d force = w * w * Vector2d(std::cos(direction), std::sin(direction));
      const scene::Scene fixed = tip_force(uniform_rod(1, 1, 1), Frame::fixed, {force[0], force[1], 0});
      const auto boundary = exact_reference::solve(fixed, {exact_reference::RodModel::reissner, 1e-5, Way::automatic});
      const double error = largest_distance_mm(*Elastica::with_fixed_load({1, 1, force, 0}), boundary, side);
      if (error > 1e-12) bound = std::min(bound, boundary.error_estimate_mm / error);
      EXPECT_GT(boundary.error_estimate_mm, error) << w << " " << direction;
    }
    const scene::Scene follower = tip_force(uniform_rod(1, 1, 1), Frame::follower, {-w, w, 0});
    const auto marched = exact_reference::solve(follower, {exact_reference::RodModel::reissner, 1e-6, Way::automatic});
    const double error = largest_distance_mm(Elastica::with_follower_load({1, 1, {-w, w}, 0}), marched, side);
    march = std::min(march, marched.error_estimate_mm / error);
  }
  std::printf("least estimate over error: boundary value %.3g, march %.3g\n", bound, march);
  EXPECT_GT(bound, 10);
  EXPECT_LT(bound, 1e4);
  EXPECT_GT(march, 1);
  EXPECT_LT(march, 100);
}
