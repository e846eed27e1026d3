// The balance of the returned shapes: what acts from a station to the tip is what the rod and its tendons carry there.
#include "exact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace exact_test;

namespace {

// Internal force and moment at a station, the tendons' pulls included, less what acts from there to the tip.
struct Imbalance {
  double force_N, moment_Nmm;
};

Vector3d tendon_pull_S(const scene::Scene& rod, const scene::Station& station, Vector3d& moment_S) {
  const scene::Stiffness k = scene::stiffness_of(rod.sections[0]);
  const Vector3d n = station.X_BS.rotation_BS.transpose() * station.force_B_N;
  const Vector3d m = station.X_BS.rotation_BS.transpose() * station.moment_B_Nmm;
  const Vector3d u = rod.sections[0].rest_curvature_per_mm +
                     m.cwiseQuotient(Vector3d(k.torsion_Nmm2, k.bending_Nmm2[0], k.bending_Nmm2[1]));
  Vector3d v = Vector3d::UnitX();
  if (k.axial_N) v[0] += n[0] / *k.axial_N;
  if (k.shear_N) v.tail<2>() += n.tail<2>().cwiseQuotient(*k.shear_N);
  Vector3d force_S = Vector3d::Zero();
  moment_S = Vector3d::Zero();
  for (const scene::Load& load : rod.loads) {
    const auto* tendon = std::get_if<scene::Tendon>(&load);
    if (tendon == nullptr || tendon->to_mm < station.s_mm - 1e-9) continue;
    const Vector3d r(0, tendon->offset_mm[0], tendon->offset_mm[1]);
    const Vector3d pull = tendon->tension_N * (v + u.cross(r)).normalized();
    force_S += pull;
    moment_S += r.cross(pull);
  }
  return force_S;
}

// Boole's weights on stations k L/40 from `first` on; only for loads on the whole rod and a multiple of 4 stretches.
double weight_mm(std::size_t k, std::size_t first, double length_mm) {
  const double h = length_mm / 40;
  if (k == first || k == 40) return h * 14 / 45;
  switch ((k - first) % 4) {
    case 0: return h * 28 / 45;
    case 2: return h * 24 / 45;
    default: return h * 64 / 45;
  }
}

Imbalance imbalance(const scene::Scene& rod, const scene::Equilibrium& result, std::size_t index) {
  const scene::Station& here = result.stations[index];
  const double L = scene::length_mm(rod);
  Vector3d moment_S;
  Vector3d force = here.X_BS.rotation_BS * tendon_pull_S(rod, here, moment_S) + here.force_B_N;
  Vector3d moment = here.X_BS.rotation_BS * moment_S + here.moment_B_Nmm;
  const auto subtract = [&](const scene::Station& at, const Vector3d& arm_S, const Vector3d& F_B, const Vector3d& M_B) {
    const Vector3d arm = at.X_BS.position_B_mm + at.X_BS.rotation_BS * arm_S - here.X_BS.position_B_mm;
    force -= F_B;
    moment -= arm.cross(F_B) + M_B;
  };
  const auto in_base = [&](const scene::Station& at, Frame frame, const Vector3d& value) -> Vector3d {
    return frame == Frame::fixed ? value : Vector3d(at.X_BS.rotation_BS * value);
  };
  for (const scene::Load& load : rod.loads) {
    for (std::size_t k = index; k < result.stations.size(); ++k) {
      const scene::Station& at = result.stations[k];
      if (const auto* f = std::get_if<scene::Force>(&load); f && std::abs(f->at_mm - at.s_mm) < 1e-9) {
        subtract(at, {0, f->offset_mm[0], f->offset_mm[1]}, in_base(at, f->frame, f->value_N), Vector3d::Zero());
      } else if (const auto* m = std::get_if<scene::Moment>(&load); m && std::abs(m->at_mm - at.s_mm) < 1e-9) {
        subtract(at, Vector3d::Zero(), Vector3d::Zero(), in_base(at, m->frame, m->value_Nmm));
      } else if (const auto* d = std::get_if<scene::DistributedForce>(&load)) {
        subtract(at, Vector3d::Zero(), weight_mm(k, index, L) * in_base(at, d->frame, d->value_N_per_mm),
                 Vector3d::Zero());
      }
    }
  }
  return {force.norm(), moment.norm() / L};
}

// Uniform rods; places are multiples of L/40, so that the stations are k L/40 where the rod turns little.
std::vector<scene::Scene> varied_scenes() {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto direction = [&] { return Vector3d(uniform(engine), uniform(engine), uniform(engine)); };
  std::vector<scene::Scene> scenes;
  for (int i = 0; i < 14; ++i) {
    scene::Scene rod = uniform_rod(40, 750, 400 + 300 * uniform(engine));
    if (i % 2 == 1) stiffness(rod).axial_N = 300;
    if (i % 3 == 1) stiffness(rod).shear_N = Vector2d(90, 150);
    if (i % 4 == 1) rod.sections[0].rest_curvature_per_mm = 0.01 * direction();
    const Frame frame = i % 5 == 1 ? Frame::follower : Frame::fixed;
    rod = with(rod, scene::Force{40, frame, direction(), {2 * uniform(engine), 2 * uniform(engine)}});
    if (i % 2 == 0) rod = with(rod, scene::Force{22, Frame::fixed, direction(), {uniform(engine), uniform(engine)}});
    if (i % 3 == 0) rod = with(rod, scene::Moment{30, Frame::fixed, 5 * direction()});
    if (i % 3 != 1) rod = with(rod, scene::Tendon{{2 * uniform(engine), 1}, 4, i % 2 == 0 ? 40.0 : 26.0});
    if (i % 3 != 1) rod = with(rod, scene::Tendon{{-1, 2 * uniform(engine)}, 3, 40});
    if (i % 4 == 3) rod = with(rod, scene::DistributedForce{0, 40, Frame::follower, 0.02 * direction()});
    if (i % 4 == 2) rod = with(rod, scene::DistributedForce{0, 40, Frame::fixed, 0.02 * direction()});
    scenes.push_back(rod);
  }
  return scenes;
}

}  // namespace

TEST(ExactReference, ReturnedShapesBalance) {  // at every station without distributed loads, else at each fourth
  for (const scene::Scene& rod : varied_scenes()) {
    const scene::Equilibrium result = solve(rod);
    ASSERT_TRUE(result.converged()) << result.message;
    ASSERT_EQ(result.stations.size(), 41u);
    const bool distributed = std::holds_alternative<scene::DistributedForce>(rod.loads.back());
    const double limit = distributed ? 2e-5 : 1e-10;  // of Boole's rule across the loads inside; N
    scene::Scene twin = rod;                          // loads 5 % larger than those that were solved
    std::get<scene::Force>(twin.loads[0]).value_N *= 1.05;
    for (std::size_t k = 0; k < 40; k += distributed ? 4 : 1) {
      const Imbalance left = imbalance(rod, result, k), wrong = imbalance(twin, result, k);
      EXPECT_LT(left.force_N, limit) << k;
      EXPECT_LT(left.moment_Nmm, limit) << k;
      EXPECT_GT(wrong.force_N, 1e-3) << k;
    }
  }
}
