// One arc: its Bezier form, and the published law against its definition.
#include "fam/arc_law.h"
#include "fam/dual.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace fam;
using Eigen::Vector2d;

Vector2d bezier_point(const std::array<Vector2d, 4>& p, double t) {
  const double u = 1 - t;
  return u * u * u * p[0] + 3 * u * u * t * p[1] + 3 * u * t * t * p[2] + t * t * t * p[3];
}

TEST(Bezier, EndsOnTheCircleWithItsTangents) {
  for (const double angle : {0.0, 1e-8, 0.1, 1.0, 3.0, -2.0}) {
    const auto p = bezier_control_points(2, angle);
    const Vector2d tip = angle == 0
                             ? Vector2d(2, 0)
                             : Vector2d(2 / angle * std::sin(angle), 4 / angle * std::pow(std::sin(angle / 2), 2));
    EXPECT_LT((p[3] - tip).norm(), 1e-15) << angle;
    EXPECT_EQ(p[0], Vector2d(0, 0));
    EXPECT_EQ(p[1][1], 0);
    const Vector2d handle = p[3] - p[2];
    EXPECT_NEAR(handle[0] * std::sin(angle) - handle[1] * std::cos(angle), 0, 1e-15);
    EXPECT_NEAR(handle.norm(), p[1][0], 1e-15);
  }
}

// The header's bound for a quarter turn, and a twin: handles 1 % longer break it.
TEST(Bezier, DistanceFromTheCircle) {
  const double quarter = std::numbers::pi / 2;  // length of a quarter circle of radius 1, centre (0, 1)
  const auto largest_distance = [](const std::array<Vector2d, 4>& p) {
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      largest = std::max(largest, std::abs((bezier_point(p, i / 1000.) - Vector2d(0, 1)).norm() - 1));
    }
    return largest;
  };
  auto p = bezier_control_points(quarter, quarter);
  EXPECT_LT(largest_distance(p), 2.8e-4);
  p[1] *= 1.01;
  p[2] = p[3] - 1.01 * (p[3] - p[2]);
  EXPECT_GT(largest_distance(p), 2.8e-4);
}

TEST(Bezier, TangentRatioAndItsSlope) {
  EXPECT_EQ(tangent_ratio(0).value, 1);
  EXPECT_EQ(tangent_ratio(0).derivative, 0);
  for (const double x : {1e-8, 1e-3, 0.0499, 0.0501, 0.3, 1.2}) {
    EXPECT_NEAR(tangent_ratio(x).value, std::tan(x) / x, 1e-15 * tangent_ratio(x).value);
    const double h = 1e-5 * (0.1 + x);
    const double slope = (tangent_ratio(x + h).value - tangent_ratio(x - h).value) / (2 * h);
    EXPECT_NEAR(tangent_ratio(x).derivative, slope, 1e-8 + 1e-7 * slope) << x;
  }
}

// Pi(theta) by its definition: Simpson's rule over the sampled Bezier curve, the force turned with the arc; h = EI = 1.
double moment_functional(const PlaneLoad& load, double angle) {
  const auto p = bezier_control_points(1, angle);
  const Vector2d force(load.axial * std::cos(angle) - load.normal * std::sin(angle),
                       load.axial * std::sin(angle) + load.normal * std::cos(angle));
  constexpr int intervals = 200;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const Vector2d arm = p[3] - bezier_point(p, static_cast<double>(i) / intervals);
    const double residual = angle - (load.moment + arm[0] * force[1] - arm[1] * force[0]);
    sum += residual * residual * (i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2);
  }
  return sum / (3 * intervals);
}

TEST(PublishedLaw, AngleMinimisesTheMomentResidual) {
  for (const PlaneLoad& load : {PlaneLoad{0.1, 0, 0}, PlaneLoad{0, 0, 0.3}, PlaneLoad{0.2, -0.4, 0.5},
                                PlaneLoad{-0.3, 0.8, 0.6}, PlaneLoad{1.5, 0.3, -1.2}, PlaneLoad{1e-6, 2e-6, 3e-6}}) {
    double angle = 0;
    ASSERT_TRUE(published_angle(load, angle));
    const double h = 1e-3 * (std::abs(load.moment) + std::abs(load.normal));
    const double slope = moment_functional(load, angle + h) - moment_functional(load, angle - h);
    const double curvature =
        moment_functional(load, angle + h) - 2 * moment_functional(load, angle) + moment_functional(load, angle - h);
    EXPECT_GT(curvature, 0);
    EXPECT_NEAR(slope / curvature * h / 2, 0, h * h + 1e-6 * h) << load.moment;  // a Newton step from the angle found
    // A twin that must fail: an angle 5 % off does not minimise.
    EXPECT_GT(moment_functional(load, 1.05 * angle), moment_functional(load, angle));
  }
}

TEST(PublishedLaw, PureMomentIsExact) {
  double angle = 0;
  ASSERT_TRUE(published_angle({3 * std::numbers::pi, 0, 0}, angle));
  EXPECT_NEAR(angle, 3 * std::numbers::pi, 1e-14);
  ASSERT_TRUE(published_angle({0, 5, 0}, angle));  // a straight arc under pure tension
  EXPECT_EQ(angle, 0);
}

TEST(PublishedLaw, SaysWhenItFindsNoAngle) {
  double angle = 0;
  EXPECT_FALSE(published_angle({std::nan(""), 1, 1}, angle));
}

TEST(LawList, NamesLeadBackToTheirLaws) {
  for (const fam::Law law : fam::all_laws()) {
    EXPECT_EQ(fam::law_named(fam::name(law)), law);
    EXPECT_EQ(fam::chosen(law), law);
    EXPECT_EQ(fam::facts_of(law).law, law);
  }
  EXPECT_EQ(fam::law_named(fam::name(fam::Law::automatic)), fam::Law::automatic);
  EXPECT_NE(fam::chosen(fam::Law::automatic), fam::Law::automatic);
  EXPECT_EQ(fam::law_named("seventh_order"), std::nullopt);
}

template <int D>
BasicArcConstants<D> soft_arc() {
  BasicArcConstants<D> arc;
  arc.length_mm = 20;
  arc.angular_compliance = 20 * angular_part<D>(Eigen::Vector3d(1 / 150., 1 / 400., 1 / 300.));
  arc.rest_rotation = 20 * angular_part<D>(Eigen::Vector3d(0.01, -0.02, 0.015));
  arc.linear_compliance = 20 * linear_part<D>(Eigen::Vector3d(1 / 300., 1 / 90., 1 / 80.));
  arc.rest_translation_mm = 20 * linear_part<D>(Eigen::Vector3d(1, 0, 0));
  return arc;
}

// One tendon, or two of half its tension at the same place: the same arc, though its strain is found in other unknowns.
// The largest of the two's differences, of the turn in rad and of the rest over the arc's length or the wrench.
template <bool with_shear, class T, int D>
double difference_to_halves(const BasicTendon<D>& tendon, const BasicArcConstants<D>& of_arc,
                            const BasicWrench<T, D>& distal, const ArcForces<T, D>* forces) {
  const std::array<BasicTendon<D>, 2> halves{
      {{tendon.arm_mm, tendon.tension_N / 2}, {tendon.arm_mm, tendon.tension_N / 2}}};
  const auto proximal = [&](std::span<const BasicTendon<D>> tendons) {
    BasicArcConstants<D> arc = of_arc;
    arc.tendons = tendons;
    BasicWrench<T, D> wrench = distal;
    BasicScrew<T, D> screw;
    bool collapsed = false;
    tendon_step<with_shear>(Law::sixth_order, arc, forces, wrench, screw, collapsed);
    EXPECT_FALSE(collapsed);
    return std::pair{wrench, screw};
  };
  const auto [one, one_screw] = proximal({&tendon, 1});
  const auto [two, two_screw] = proximal(halves);
  double largest = 0;
  const auto compare = [&largest](const auto& a, const auto& b, double unit) {
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      if constexpr (std::is_same_v<T, double>) {
        largest = std::max(largest, std::abs(a[i] - b[i]) / unit);
      } else {
        largest = std::max(largest, std::abs(a[i].value - b[i].value) / unit);
        largest = std::max(largest, (a[i].slope - b[i].slope).abs().maxCoeff() / unit);
      }
    }
  };
  compare(one_screw.rotation, two_screw.rotation, 1);
  compare(one_screw.translation_mm, two_screw.translation_mm, of_arc.length_mm);
  compare(one.force_N, two.force_N, 10);
  compare(one.moment_Nmm, two.moment_Nmm, 100);
  return largest;
}

// With 25 N some tendons are pressed together to a fifth of the arc.
TEST(OneTendon, IsAsTwoOfHalfTheTension) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> one(-1, 1);
  for (const double tension_N : {0.0, 3.0, 10.0, 25.0}) {
    for (int i = 0; i < 50; ++i) {
      const auto some = [&](double size) {
        return Eigen::Vector3d(size * one(random), size * one(random), size * one(random));
      };
      const Eigen::Vector3d force_N = some(2), moment_Nmm = some(20), arm_mm(0, 2 * one(random), 2 * one(random));
      const ArcForces<double, 3> forces{some(1), some(1)};
      const BasicWrench<double, 3> wrench{force_N, moment_Nmm};
      const BasicTendon<3> tendon{arm_mm, tension_N};
      for (const ArcForces<double, 3>* along : {static_cast<const ArcForces<double, 3>*>(nullptr), &forces}) {
        EXPECT_LT((difference_to_halves<true>(tendon, soft_arc<3>(), wrench, along)), 1e-12) << tension_N << ' ' << i;
        EXPECT_LT((difference_to_halves<false>(tendon, soft_arc<3>(), wrench, along)), 1e-12) << tension_N << ' ' << i;
      }
      using Number = Dual<4>;
      const auto unknown = [](double value, int direction) {
        Number number(value);
        number.slope[direction] = 1;
        return number;
      };
      BasicWrench<Number, 2> planar;
      planar.force_N << unknown(force_N[0], 0), unknown(force_N[1], 1);
      planar.moment_Nmm << unknown(moment_Nmm[2], 2);
      const BasicTendon<2> planar_tendon{arm_mm.head<2>(), tension_N};
      const ArcForces<Number, 2>* none = nullptr;
      EXPECT_LT((difference_to_halves<true>(planar_tendon, soft_arc<2>(), planar, none)), 1e-11)
          << tension_N << ' ' << i;
    }
  }
}

// By blocks of Wide numbers, or by a search for the least energy and elimination: the same arc.
template <bool with_shear>
double difference_to_least_energy(const ArcConstants& arc, const SectionWrench& distal,
                                  const ArcForces<double, 3>* forces, double stiffer = 1) {
  SectionWrench searched = distal, wrench = distal;
  Screw searched_screw, screw;
  ArcConstants searched_arc = arc;
  searched_arc.angular_compliance /= stiffer;
  TendonSection<with_shear, double, 3> section(searched_arc);
  law_step(Law::sixth_order, section, forces, searched, searched_screw);
  bool collapsed = false;
  tendon_step<with_shear>(Law::sixth_order, arc, forces, wrench, screw, collapsed);
  EXPECT_EQ(collapsed, section.collapsed());
  if (collapsed) return 0;
  return std::max({(screw.rotation - searched_screw.rotation).norm(),
                   (screw.translation_mm - searched_screw.translation_mm).norm() / arc.length_mm,
                   (wrench.force_N - searched.force_N).norm() / 10,
                   (wrench.moment_Nmm - searched.moment_Nmm).norm() / 100});
}

TEST(SeveralTendons, AreAsTheSearchForTheLeastEnergyHasThem) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> one(-1, 1);
  const auto some = [&](double size) -> Eigen::Vector3d {
    const double x = one(random), y = one(random);
    return size * Eigen::Vector3d(x, y, one(random));
  };
  for (const double tension_N : {0.0, 3.0, 10.0, 25.0}) {
    for (int i = 0; i < 50; ++i) {
      std::array<BasicTendon<3>, 3> tendons;
      for (BasicTendon<3>& tendon : tendons) tendon = {some(2), tension_N * std::abs(one(random))};
      ArcConstants arc = soft_arc<3>();
      arc.tendons = tendons;
      const SectionWrench wrench{some(2), some(20)};
      const ArcForces<double, 3> forces{some(1), some(1)};
      for (const ArcForces<double, 3>* along : {static_cast<const ArcForces<double, 3>*>(nullptr), &forces}) {
        EXPECT_LT((difference_to_least_energy<true>(arc, wrench, along)), 1e-12) << tension_N << ' ' << i;
        EXPECT_LT((difference_to_least_energy<false>(arc, wrench, along)), 1e-12) << tension_N << ' ' << i;
        EXPECT_GT((difference_to_least_energy<false>(arc, wrench, along, 1.05)), 1e-4) << "the twin, 5 % stiffer";
      }
    }
  }
}

}  // namespace
