// The slopes of an arc in the plane are those of the same arc taken as one in space; so are a rod's derivatives.
#include "fam/arc_law.h"
#include "fam/arc_slopes.h"
#include "fam/poses_in_arc.h"
#include "fam/solver.h"
#include "response_support.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>

using Eigen::Vector3d;

namespace {

struct PlanarArc {
  fam::BasicArcConstants<3> constants;
  fam::ArcForces<double, 3> forces;
  fam::SectionWrench wrench;
};

PlanarArc random_arc(std::mt19937& random) {
  std::uniform_real_distribution<double> one(-1, 1);
  const auto compliance = [&](double scale) -> Vector3d {
    return scale * Vector3d(1.1 + one(random), 1.1 + one(random), 1.1);
  };
  PlanarArc arc;
  arc.constants.length_mm = 20;
  arc.constants.angular_compliance = compliance(1e-3);
  arc.constants.linear_compliance = compliance(0.05);
  arc.constants.rest_rotation = {0, 0, 0.3 * one(random)};
  arc.constants.rest_translation_mm = {20, 0, 0};
  arc.forces = {{2 * one(random), 2 * one(random), 0}, {2 * one(random), 2 * one(random), 0}};
  arc.wrench = {{20 * one(random), 20 * one(random), 0}, {0, 0, 400 * one(random)}};
  return arc;
}

template <int N>
void expect_same(fam::RodModel model, bool with_forces) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const PlanarArc arc = random_arc(random);
    const fam::ArcForces<double, 3>* forces = with_forces ? &arc.forces : nullptr;
    const auto planar = fam::vary_planar_arc<N>(model, arc.constants, forces, arc.wrench);
    const auto spatial =
        fam::vary_arc(fam::Law::sixth_order, model, arc.constants, forces, arc.wrench, fam::unit_changes<N>());
    for (int row = 0; row < 12; row += 3) {
      const Eigen::Matrix<double, 3, N> expected = spatial.slopes.template middleRows<3>(row);
      EXPECT_LE((planar.slopes.template middleRows<3>(row) - expected).norm(), 1e-13 * expected.norm()) << i << row;
    }
    EXPECT_LE((planar.way_D_mm - spatial.way_D_mm).norm(), 1e-13 * 20);
    EXPECT_LE((planar.motion.rotation - spatial.motion.rotation).norm(), 1e-14);
    EXPECT_LE((planar.gain_D.force_N - spatial.gain_D.force_N).norm(), 1e-12);
    EXPECT_LE((planar.gain_D.moment_Nmm - spatial.gain_D.moment_Nmm).norm(), 1e-11);
  }
}

TEST(PlanarSlopes, OfAnArcAreThoseInSpace) {
  for (const fam::RodModel model : {fam::RodModel::kirchhoff, fam::RodModel::reissner}) {
    expect_same<6>(model, false);
    expect_same<9>(model, true);
  }
}

// Whatever the processor has: two changes at a time, or four by other instructions. A change more or less does not
// matter to the others.
template <int N>
void expect_same_of_units(fam::RodModel model, bool with_forces, std::span<const fam::BasicTendon<3>> tendons) {
  std::mt19937 random(8);
  for (int i = 0; i < 50; ++i) {
    PlanarArc arc = random_arc(random);
    arc.wrench.force_N[2] = 5;
    arc.wrench.moment_Nmm[0] = 50;
    arc.forces.fixed_D_N[2] = 1;
    arc.constants.tendons = tendons;
    const fam::ArcForces<double, 3>* forces = with_forces ? &arc.forces : nullptr;
    const auto by = [&]<int M>(fam::VectorUnit unit) {
      return fam::vary_arc(fam::Law::sixth_order, model, arc.constants, forces, arc.wrench, fam::unit_changes<M>(),
                           unit);
    };
    const auto two = by.template operator()<N>(fam::VectorUnit::portable);
    const auto four = by.template operator()<N>(fam::widest_unit());
    const auto wrench_alone = by.template operator() < N == 8 ? 9 : N > (fam::VectorUnit::portable);
    for (int row = 0; row < 12; row += 3) {
      const Eigen::Matrix<double, 3, N> expected = two.slopes.template middleRows<3>(row);
      const double allowed = 1e-12 * expected.norm();
      EXPECT_LE((four.slopes.template middleRows<3>(row) - expected).norm(), allowed) << i << row;
      EXPECT_LE(
          (wrench_alone.slopes.template middleRows<3>(row).template leftCols<6>() - expected.template leftCols<6>())
              .norm(),
          allowed);
    }
    EXPECT_LE((four.way_D_mm - two.way_D_mm).norm(), 1e-13 * 20);
    EXPECT_LE((four.motion.rotation - two.motion.rotation).norm(), 1e-14);
  }
}

TEST(ArcSlopes, OfEveryVectorUnitAreTheSame) {
  const std::array<fam::BasicTendon<3>, 2> tendons{{{{0, 2, 1}, 3}, {{0, -1, 2}, 5}}};
  for (const fam::RodModel model : {fam::RodModel::kirchhoff, fam::RodModel::reissner}) {
    for (const std::size_t count : {0, 2}) {
      const std::span<const fam::BasicTendon<3>> some(tendons.data(), count);
      expect_same_of_units<6>(model, false, some);
      expect_same_of_units<8>(model, true, some);
      expect_same_of_units<9>(model, true, some);
    }
  }
}

struct Stepped {
  fam::SectionWrench wrench;
  fam::Screw screw;
  fam::RigidMotion motion;
  bool collapsed = false;
};
template <bool with_shear>
Stepped step(const PlanarArc& arc, const fam::ArcForces<double, 3>* forces, fam::VectorUnit unit) {
  Stepped result{arc.wrench, {}, {}};
  const fam::Law law = fam::Law::sixth_order;
  result.motion = arc.constants.tendons.empty()
                      ? fam::elastic_step<with_shear>(law, arc.constants, forces, result.wrench, result.screw, unit)
                      : fam::tendon_step<with_shear>(law, arc.constants, forces, result.wrench, result.screw,
                                                     result.collapsed, unit);
  return result;
}

template <bool with_shear>
void expect_same_step(const PlanarArc& arc, const fam::ArcForces<double, 3>* forces) {
  const Stepped narrow = step<with_shear>(arc, forces, fam::VectorUnit::portable);
  const Stepped wide = step<with_shear>(arc, forces, fam::widest_unit());
  EXPECT_EQ(narrow.collapsed, wide.collapsed);
  if (narrow.collapsed) return;
  const auto expect_near = [](const Vector3d& a, const Vector3d& b) { EXPECT_LE((a - b).norm(), 1e-13 * b.norm()); };
  expect_near(wide.wrench.force_N, narrow.wrench.force_N);
  expect_near(wide.wrench.moment_Nmm, narrow.wrench.moment_Nmm);
  expect_near(wide.screw.rotation, narrow.screw.rotation);
  expect_near(wide.screw.translation_mm, narrow.screw.translation_mm);
  expect_near(wide.motion.rotation, narrow.motion.rotation);
  expect_near(wide.motion.position_mm, narrow.motion.position_mm);
  expect_near({wide.motion.A, wide.motion.B, 1}, {narrow.motion.A, narrow.motion.B, 1});
}

// With 300 N half of the sections with shear are beyond Newton's method alone; most of those have no strain at all.
void expect_same_part(const PlanarArc& arc, const fam::ArcForces<double, 3>* forces, double part) {
  const auto series = fam::elastic_series<true, 7>(arc.constants, forces, arc.wrench, fam::VectorUnit::portable);
  fam::SectionWrench narrow = arc.wrench, wide = arc.wrench;
  const fam::RigidMotion a =
      fam::step_of_part<true>(series, part, forces != nullptr, narrow, fam::VectorUnit::portable);
  const fam::RigidMotion b = fam::step_of_part<true>(series, part, forces != nullptr, wide, fam::widest_unit());
  EXPECT_LE((b.position_mm - a.position_mm).norm(), 1e-13 * a.position_mm.norm());
  EXPECT_LE((b.rotation - a.rotation).norm(), 1e-13 * a.rotation.norm());
  EXPECT_LE((wide.moment_Nmm - narrow.moment_Nmm).norm(), 1e-13 * narrow.moment_Nmm.norm());
  // Of the whole the arc itself, of none nothing.
  fam::SectionWrench wrench = arc.wrench;
  fam::Screw screw;
  const fam::RigidMotion whole =
      fam::elastic_step<true>(fam::Law::sixth_order, arc.constants, forces, wrench, screw, fam::VectorUnit::portable);
  EXPECT_EQ((a.position_mm - whole.position_mm).norm() < 1e-13 * whole.position_mm.norm(), part == 1);
}

TEST(ArcSteps, PartsOfEveryVectorUnitAreTheSame) {
  std::mt19937 random(10);
  for (int i = 0; i < 50; ++i) {
    PlanarArc arc = random_arc(random);
    arc.wrench.force_N[2] = 5;
    arc.wrench.moment_Nmm[0] = 50;
    arc.forces.fixed_D_N[2] = 1;
    for (const double part : {0.3, 1.}) {
      expect_same_part(arc, nullptr, part);
      expect_same_part(arc, &arc.forces, part);
    }
  }
}

// Each pose, moved on by the part of the arc beyond it, is that of the distal end.
TEST(ArcSteps, PosesInAnArcLeadOnToItsEnd) {
  std::mt19937 random(12);
  const fam::SectionPose distal = fam::SectionPose{}.then(fam::exponential(fam::Screw{{0.3, -2, 1}, {10, -20, 30}}));
  const fam::PlacesAtOnce fractions{0, 0.2, 0.7, 1};
  for (int i = 0; i < 50; ++i) {
    PlanarArc arc = random_arc(random);
    arc.wrench.force_N[2] = 5;
    arc.wrench.moment_Nmm[0] = 50;
    const auto series = fam::elastic_series<true, 7>(arc.constants, &arc.forces, arc.wrench);
    for (const fam::VectorUnit unit : {fam::VectorUnit::portable, fam::widest_unit()}) {
      fam::PosesAtOnce<3> poses;
      ASSERT_TRUE(fam::poses_in_arc<true>(series, fractions, distal, poses, unit));
      for (std::size_t k = 0; k < fractions.size(); ++k) {
        fam::SectionWrench wrench = arc.wrench;
        const fam::SectionPose end = poses[k].then(fam::step_of_part<true>(series, 1 - fractions[k], true, wrench));
        EXPECT_LE((end.position_B_mm - distal.position_B_mm).norm(), 1e-13 * 40);
        EXPECT_LE((end.rotation_BS - distal.rotation_BS).norm(), 1e-14);
        const fam::SectionPose twin = poses[k].then(fam::step_of_part<true>(series, 1.01 - fractions[k], true, wrench));
        EXPECT_GT((twin.position_B_mm - distal.position_B_mm).norm(), 0.1);
      }
    }
  }
}

// A rod that is bent at rest turns by any angle in one arc.
TEST(ArcSteps, PosesInAnArcThatTurnsFarAreLeftToOthers) {
  fam::RodSeries<double, 2, 7> series;
  for (std::size_t k = 0; k < 7; ++k) series.rotation[k].setZero(), series.translation_mm[k].setZero();
  series.translation_mm[0] = {20, 0};
  for (const double turn_rad : {1.9, 2.1}) {
    series.rotation[0][0] = turn_rad;
    fam::PosesAtOnce<2> poses;
    ASSERT_EQ((fam::poses_in_arc<false>(series, {0, 0.5, 0.5, 1}, fam::BasicPose<2>{}, poses)), turn_rad < 2);
    if (turn_rad > 2) continue;
    // A circle's chord, and where the arc begins as its distal end sees it.
    const double radius_mm = 20 / turn_rad;
    EXPECT_NEAR(poses[1].position_B_mm.norm(), 2 * radius_mm * std::sin(turn_rad / 4), 1e-13);
    EXPECT_NEAR(poses[0].position_B_mm[0], -radius_mm * std::sin(turn_rad), 1e-13);
    EXPECT_NEAR(poses[0].position_B_mm[1], radius_mm * (1 - std::cos(turn_rad)), 1e-13);
  }
}

TEST(ArcSteps, OfEveryVectorUnitAreTheSame) {
  std::mt19937 random(9);
  for (const double tension_N : {0., 3., 300.}) {
    const std::array<fam::BasicTendon<3>, 2> tendons{{{{0, 2, 1}, tension_N}, {{0, 0, -2}, tension_N / 3}}};
    for (int i = 0; i < 100; ++i) {
      PlanarArc arc = random_arc(random);
      arc.wrench.force_N[2] = 5;
      arc.wrench.moment_Nmm[0] = 50;
      arc.forces.fixed_D_N[2] = 1;
      if (tension_N > 0) arc.constants.tendons = std::span(tendons).first(1 + static_cast<std::size_t>(i % 2));
      for (const fam::ArcForces<double, 3>* forces : {static_cast<fam::ArcForces<double, 3>*>(nullptr), &arc.forces}) {
        expect_same_step<true>(arc, forces);
        expect_same_step<false>(arc, forces);
      }
    }
  }
}

// A rod with every kind of load but tendons, in the plane of the x axis and this direction.
scene::Scene planar_rod(scene::Stiffness stiffness, const Vector3d& along) {
  using namespace scene;
  stiffness.mass_per_length_kg_per_m = 2e-3;
  const Vector3d across = Vector3d::UnitX().cross(along);
  Scene scene = support::uniform_rod(100, stiffness,
                                     {Force{100, Frame::fixed, -0.1 * Vector3d::UnitX() + 0.2 * along},
                                      Force{60, Frame::follower, 0.1 * along}, Moment{60, Frame::fixed, -6 * across},
                                      DistributedForce{20, 80, Frame::follower, 2e-3 * along}, Gravity{981 * along}});
  scene.sections[0].rest_curvature_per_mm = 4e-3 * across;
  return scene;
}

TEST(PlanarSlopes, OfARodAreThoseInSpace) {
  using What = fam::Response::What;
  const scene::Stiffness slender = support::slender(600, 450);
  scene::Stiffness soft = slender, strip = slender;
  soft.axial_N = 300;
  soft.shear_N = Eigen::Vector2d(90, 90);
  strip.bending_Nmm2[0] *= 7;
  for (const auto& [stiffness, along] :
       {std::pair(soft, Vector3d(0, 0.6, -0.8)), std::pair(strip, Vector3d(0, 0, 1)),
        std::pair(strip, Vector3d(0, -1, 0)), std::pair(slender, Vector3d(0, 0, -1))}) {
    const scene::Scene scene = planar_rod(stiffness, along);
    fam::Options options;
    options.arcs = 30;
    auto made = fam::Solver::make(scene, options);
    auto& planar = std::get<fam::Solver>(made);
    ASSERT_TRUE(planar.solve().converged());
    support::SolvedRod spatial(scene, 30);
    ASSERT_TRUE(spatial.converged());
    for (const double s_mm : {47.0, 100.0}) {
      const auto compliance = spatial.response().compliance(s_mm, What::pose);
      EXPECT_LE((planar.compliance(s_mm) - compliance).norm(), 1e-9 * compliance.norm());
      for (std::size_t load = 0; load < scene.loads.size(); ++load) {
        const auto expected = spatial.response().by_load(load, s_mm, What::wrench);
        EXPECT_LE((planar.wrench_by_load(load, s_mm) - expected).norm(), 1e-9 * expected.norm()) << load;
      }
    }
  }
}

}  // namespace
