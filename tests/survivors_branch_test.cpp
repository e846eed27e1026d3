// What mutants once survived: branches, stability and load steps of the three methods.
#include "survivors.h"

#include "studies/scenes/random_scene.h"

namespace {

using namespace survivors;

// A column pressed beyond Euler's load and pushed aside by a follower force, without an energy: the elastica with
// k = sin(angle/2), K(k) = sqrt(P L^2/EI), whose tip lies at x = (2 E/K - 1) L, 2 k/K L aside; and with an energy, by
// two small fixed forces that leave no plane of symmetry, the same one, stable.
void pushed_column(const Method& solve, std::vector<double> times_euler = {1.3, 3.0, 30.0}) {
  const auto error = [&](double euler_loads, bool conservative, double factor) {
    double below = 0, above = 1;
    while (above - below > 1e-15) {
      const double k = (below + above) / 2;
      (std::comp_ellint_1(k) < pi / 2 * std::sqrt(euler_loads) ? below : above) = k;
    }
    const double K = std::comp_ellint_1(below), x = 2 * std::comp_ellint_2(below) / K - 1, aside = 2 * below / K;
    const double pressed_N = euler_loads * pi * pi / 4;
    const double push_N = 1e-6 * pressed_N;
    const Load first = Force{1, conservative ? Frame::fixed : Frame::follower, {0, push_N, 0}};
    Scene scene = uniform_rod(1, slender(1, 0.7), {Force{1, Frame::fixed, {-pressed_N, 0, 0}}, first});
    if (conservative) scene.loads.push_back(Force{0.5, Frame::fixed, {0, 0, 1e-3 * push_N}});
    const Equilibrium found = solve(support::stiffer(scene, factor));
    EXPECT_EQ(found.stable, conservative ? std::optional(true) : std::nullopt) << euler_loads;
    const Vector3d at = tip(found);
    return std::hypot(at[0] - x, std::hypot(at[1], at[2]) - aside);
  };
  for (const double euler_loads : times_euler) {
    for (const bool conservative : {false, true}) {
      EXPECT_LT(error(euler_loads, conservative, 1), 5e-5) << euler_loads << conservative;
      EXPECT_GT(error(euler_loads, conservative, 1.05), 5e-5);
    }
  }
}

// Strips beside their lateral buckling loads, 100 mm long: the exact reference, and the finite elements to 1.5e-4 mm,
// on the branch that grows from no load. Its mirrored branch, stable too, is where larger surprises lead.
TEST(SurvivorsFam, StripsBesideLateralBuckling) {
  for (const auto& [seed, exact_mm] : {std::pair(201878u, Vector3d(70.62088, 63.79680, 4.35709)),
                                       std::pair(247970u, Vector3d(86.36205, 2.32958, 45.25790))}) {
    const Scene strip = studies::random_scene(seed);
    EXPECT_LT((tip(by_fam(strip, 1e-3)) - exact_mm).norm(), 1e-3) << seed;
    EXPECT_GT((tip(by_fam(support::stiffer(strip), 1e-3)) - exact_mm).norm(), 0.1) << seed;
  }
}

// Of an audit the one answer of FAM that was wrong, and certified by its signs: a strip loaded on edge, a hundred
// thousandth of the load beside it, buckled to the side that it is not pushed to. Finite elements agree with the exact
// reference.
TEST(SurvivorsFam, StripPushedAsideByNextToNothing) {
  const Scene strip = studies::random_scene(studies::campaign_seed(2, 22'275));
  const double length_mm = scene::length_mm(strip);
  const Vector3d exact_mm = tip(by_exact(strip));
  EXPECT_LT((tip(by_fem(strip, 48, 2)) - exact_mm).norm(), 1e-4 * length_mm);
  for (const double tolerance : {1e-3, 1e-5}) {
    EXPECT_LT((tip(by_fam(strip, tolerance * length_mm)) - exact_mm).norm(), tolerance * length_mm);
    EXPECT_GT((tip(by_fam(support::stiffer(strip), tolerance * length_mm)) - exact_mm).norm(), 2e-3 * length_mm);
  }
}

// A taut strip, pulled and loaded on edge, falls out of its plane beyond 0.55 of the load. Beside the plane it lies
// in equilibrium under the full load, too, 0.2 um off, but with two unstable directions: the determinant has its sign
// and, taut as the strip is, its size.
TEST(SurvivorsFam, TautStripFallsOutOfItsPlane) {
  scene::Stiffness stiffness = slender(0.2, 200);
  stiffness.bending_Nmm2[1] = 1000;
  const Scene strip = uniform_rod(100, stiffness, {Force{100, Frame::fixed, {4e-3, 0.02, 1e-8}}});
  const Vector3d exact_mm = tip(by_exact(strip));
  for (const double tolerance_mm : {0.1, 1e-2, 1e-4}) {
    EXPECT_LT((tip(by_fam(strip, tolerance_mm)) - exact_mm).norm(), tolerance_mm);
    EXPECT_GT((tip(by_fam(support::stiffer(strip), tolerance_mm)) - exact_mm).norm(), 0.1);
  }
}

// Moments that turn a rod by several rad leave it more than one equilibrium under forces that alone leave one.
TEST(SurvivorsFam, MomentsBesideSmallForces) {
  const Scene rod = uniform_rod(
      38.13, {500, {331.1, 331.1}, {}, {}, 0},
      {Force{38.13, Frame::fixed, {0.0946, 0.0507, -0.1999}}, Moment{38.13, Frame::fixed, {-31.43, 10.84, 22.74}},
       Moment{38.13, Frame::follower, {-38.77, -0.217, -5.309}}});
  const Vector3d exact_mm = tip(by_exact(rod));
  EXPECT_LT((tip(by_fam(rod, 1e-3)) - exact_mm).norm(), 1e-3);
  EXPECT_GT((tip(by_fam(support::stiffer(rod), 1e-3)) - exact_mm).norm(), 0.1);
}

// A couple of forces off the centreline bends a strip on edge by 0.04 rad, and turns it out of its plane.
TEST(SurvivorsFam, CoupleTurnsAStripOutOfItsPlane) {
  const auto pressed = [](double force_N) {
    Scene strip = uniform_rod(100, {100, {5000, 100}, {}, {}, 0}, couple(100, {force_N, 0, 0}, {0, 10}));
    strip.loads.push_back(Force{100, Frame::fixed, {0, 0, 1e-4}});
    return by_fam(strip, 1e-2).stable;
  };
  EXPECT_EQ(pressed(0.05), true);
  EXPECT_EQ(pressed(0.095), false);
}

// A strip under a force along its stiff side that leaves one equilibrium in its plane turns over by a soft torsion.
TEST(SurvivorsFam, StripFallsOutOfItsPlane) {
  for (const double torsion_Nmm2 : {20., 1000.}) {
    const Scene strip =
        uniform_rod(100, {torsion_Nmm2, {700, 1500}, {}, {}, 0}, {Force{100, Frame::fixed, {0, 0.126, 0}}});
    EXPECT_EQ(by_exact(strip).stable, torsion_Nmm2 > 100);
    EXPECT_EQ(by_fam(strip, 0.1).stable, torsion_Nmm2 > 100);
  }
}

// A curved rod in its plane under its weight has one equilibrium there; a soft torsion lets it fall out of it.
TEST(SurvivorsFam, CurvedRodFallsOutOfItsPlane) {
  const auto curved = [](double torsion_Nmm2) {
    Scene rod = uniform_rod(123, {torsion_Nmm2, {755, 755}, {}, {}, 1.7e-3}, {});
    rod.sections.push_back({75, scene::Stiffness{512, {725, 725}, {}, {}, 3e-4}});
    rod.sections.push_back({187, scene::Stiffness{540, {871, 2870}, {}, {}, 9.5e-3}});
    rod.sections[0].rest_curvature_per_mm = {0, 0, -2.1e-3};
    rod.sections[1].rest_curvature_per_mm = {0, 0, -0.0105};
    rod.loads = {scene::Gravity{{1.55, 9.69, 0}}};
    return rod;
  };
  for (const double torsion_Nmm2 : {88.4, 400.}) {
    const Scene rod = curved(torsion_Nmm2);
    EXPECT_EQ(by_exact(rod).stable, torsion_Nmm2 > 100);
    EXPECT_EQ(by_fam(rod, 0.4).stable, torsion_Nmm2 > 100);
  }
}

// Planar rods under opposite fixed forces off the centreline, some of the 1191 such that were drawn: a load step that
// turns a segment end otherwise than predicted, by most of its turn, led to other branches.
TEST(SurvivorsFam, CouplesOffTheCentreline) {
  const auto press = [](Scene& scene, double at_mm, const Vector3d& force_N, double off_mm) {
    for (const Load& load : couple(at_mm, force_N, {off_mm, 0})) scene.loads.push_back(load);
  };
  Scene one = uniform_rod(31.56, {500, {708.4, 337.1}, {}, {}, 0}, {});
  one.sections.push_back({27.19, scene::Stiffness{500, {596.1, 306.7}, {}, {}, 0}});
  one.sections.push_back({39.23, scene::Stiffness{500, {753, 652.3}, {}, {}, 0}});
  press(one, 97.98, {8.164, 10.33, 0}, 5.764);
  press(one, 42.37, {16.3, -22.02, 0}, 2.29);
  Scene two = uniform_rod(15.39, {500, {827.3, 513.6}, {}, {}, 0}, {});
  two.sections.push_back({29.15, scene::Stiffness{500, {826.2, 245.2}, {}, {}, 0}});
  press(two, 44.54, {-9.131, 27.82, 0}, 9.482);
  press(two, 30.03, {-10.09, 4.999, 0}, 7.832);
  Scene three = uniform_rod(30.68, {500, {546.3, 350.3}, {}, {}, 0}, {});
  three.sections.push_back({32.64, scene::Stiffness{500, {807, 763.3}, {}, {}, 0}});
  three.sections.push_back({29.53, scene::Stiffness{500, {335, 364.4}, {}, {}, 0}});
  press(three, 92.85, {12.61, 6.771, 0}, 3.655);
  press(three, 40.747, {-15.35, -17.57, 0}, 9.172);
  Scene four = uniform_rod(27.65, {500, {255.2, 885.1}, {}, {}, 0}, {});
  four.sections.push_back({34.07, scene::Stiffness{500, {800.1, 856.5}, {}, {}, 0}});
  four.sections.push_back({10.98, scene::Stiffness{500, {468.9, 440}, {}, {}, 0}});
  press(four, 72.7, {-12.14, 13.72, 0}, 9.914);
  press(four, 29.669, {16.61, -9.746, 0}, 8.987);
  for (const Scene& rod : {one, two, three, four}) {
    const double tolerance_mm = 1e-4 * scene::length_mm(rod);
    const Vector3d exact_mm = tip(by_exact(rod));
    EXPECT_LT((tip(by_fam(rod, tolerance_mm)) - exact_mm).norm(), tolerance_mm);
    EXPECT_GT((tip(by_fam(support::stiffer(rod), tolerance_mm)) - exact_mm).norm(), 3 * tolerance_mm);
  }
}

// Where the full load ends beside the rest shape no load is grown: a strip under half of Prandtl's load across it, of
// which an eighth would leave it one equilibrium for sure.
TEST(SurvivorsFam, HardlyBentIsSolvedAtOnce) {
  const double prandtl_N = 4.0126 * std::sqrt(0.01);
  const Scene strip = uniform_rod(1, {1, {0.01, 1}, {}, {}, 0}, {Force{1, Frame::fixed, {0, prandtl_N / 2, 1e-4}}});
  const Equilibrium answer = by_fam(strip, 1e-5);
  EXPECT_EQ(fact<int>(answer, "load_steps"), 1);
  EXPECT_EQ(answer.stable, true);
  EXPECT_LT((tip(answer) - tip(by_exact(strip))).norm(), 1e-5);
  EXPECT_GT((tip(by_fam(support::stiffer(strip), 1e-6)) - tip(by_exact(strip))).norm(), 1e-4);
}

// Nor does such a strip, of 3000 times the stiffness in its plane, need the arcs that its weak axis would: 1 and 2 do
// in the place of 7 and 14.
TEST(SurvivorsFam, HardlyBentTakesFewArcs) {
  const Scene strip =
      uniform_rod(1, {1800, {1, 3000}, {}, {}, 0}, {DistributedForce{0, 1, Frame::fixed, {0, 90, 3e-4}}});
  const Equilibrium answer = by_fam(strip, 1e-4);
  EXPECT_LE(fact<int>(answer, "arcs"), 2);
  EXPECT_EQ(answer.stable, true);
  EXPECT_LT((tip(answer) - tip(by_exact(strip))).norm(), 1e-4);
  EXPECT_GT((tip(by_fam(support::stiffer(strip), 1e-5)) - tip(by_exact(strip))).norm(), 1e-4);
}

// Equilibria without a conjugate point, as few arcs see it, beside the rest shape or not far from it, to which the full
// load leads at once, but not those of the branch: under a couple whose tip lies along the clamp, not so what is
// between; under a load so large that a turn of 0.4 rad makes a strip taut which buckles on the way; where three arcs
// do not see the strip's three conjugate points; and under a following load, with which a strip is critical twice on
// the way.
TEST(SurvivorsFam, NotTheEquilibriumBesideTheRestShape) {
  Scene folded = uniform_rod(100, {500, {535.801685, 526.283921}, {}, {}, 0}, {});
  const Vector3d force_N(-6.0291199, 1.78168871, 1.13652915);
  for (const Load& load : couple(84.0298953, force_N, {3.17912061, -0.320791256})) folded.loads.push_back(load);
  Scene taut = uniform_rod(100, {56.6506672, {64.1719665, 1000}, {}, {}, 0},
                           {Force{100, Frame::fixed, {0, 0.112645178, 6.31993009e-8}}});
  taut.sections[0].rest_curvature_per_mm = {0, 0, 0.00536351555};
  const Scene unseen = uniform_rod(100, {0.227515814, {0.239002551, 1000}, {}, {}, 0},
                                   {Force{100, Frame::fixed, {0, 0.000455058589, 5.17507887e-11}}});
  const Scene twice_critical =
      uniform_rod(100, {0.714163454, {0.867193708, 1000}, {}, {}, 0},
                  {Force{100, Frame::follower, {3.59885861e-05, 0.000470005672, 1.77510579e-07}},
                   Force{71.8515993, Frame::fixed, {0, 0.0012111415, 0}}});
  for (const Scene& rod : {folded, taut, unseen, twice_critical}) {
    const Vector3d exact_mm = tip(by_exact(rod));
    EXPECT_LT((tip(by_fam(rod, 1e-2)) - exact_mm).norm(), 1e-2);
    EXPECT_GT((tip(by_fam(support::stiffer(rod), 1e-2)) - exact_mm).norm(), 0.1);
  }
}

// A rod of twelve sections under moments, which has another equilibrium 0.05 L away: Newton's steps of 0.12 and 0.17
// rad led there within the surprise allowed, the determinant far from zero.
TEST(SurvivorsFam, NewtonThatDoesNotContract) {
  const Scene rod = studies::random_scene(studies::campaign_seed(60606, 72));
  const double tolerance_mm = 1e-3 * scene::length_mm(rod);
  const Vector3d exact_mm = tip(by_exact(rod));
  EXPECT_LT((tip(by_fam(rod, tolerance_mm)) - exact_mm).norm(), tolerance_mm);
  EXPECT_GT((tip(by_fam(support::stiffer(rod), tolerance_mm)) - exact_mm).norm(), 3 * tolerance_mm);
}

// Two of 10 000 rods that buckle that a step leads to another branch, where the determinant has the other sign, but for
// that sign: 0.39 L and 0.02 L off.
TEST(SurvivorsFam, TheDeterminantsSign) {
  for (const std::uint64_t seed : {101'647, 101'703}) {
    const Scene rod = studies::random_scene(seed);
    const double tolerance_mm = 1e-3 * scene::length_mm(rod);
    const Vector3d exact_mm = tip(by_exact(rod));
    EXPECT_LT((tip(by_fam(rod, tolerance_mm)) - exact_mm).norm(), tolerance_mm) << seed;
    EXPECT_GT((tip(by_fam(support::stiffer(rod), tolerance_mm)) - exact_mm).norm(), 3 * tolerance_mm) << seed;
  }
}

// Of 630 000 random scenes the three whose answers were wrong, the first two silently: more arcs led a coil to another
// equilibrium, 0.03 L off, and a strip to the unstable one between its two stable ones, where fewer arcs were still
// below the critical load; 2 and 4 arcs of a strip within a thousandth of it were alike by chance.
TEST(SurvivorsFam, MoreArcsBesideACriticalPoint) {
  for (const std::uint64_t index : {550'016, 491'406, 388'566}) {
    const Scene scene = studies::random_scene(studies::campaign_seed(1, index));
    const double tolerance_mm = 1e-4 * scene::length_mm(scene);
    const Equilibrium exact = by_exact(scene), found = by_fam(scene, tolerance_mm);
    EXPECT_LT((tip(found) - tip(exact)).norm(), tolerance_mm) << index;
    EXPECT_EQ(found.stable, exact.stable) << index;
    EXPECT_GT((tip(by_fam(support::stiffer(scene), tolerance_mm)) - tip(exact)).norm(), tolerance_mm) << index;
  }
}

// A rod curved at rest that nearly comes to a fork at three quarters of its load: with three arcs a span it goes the
// other way, which must not lead more arcs. Finite elements end where the exact reference does.
TEST(SurvivorsFam, MoreArcsGoTheirOwnWayPastAFork) {
  scene::Stiffness stiffness = slender(1000, 725.602413);
  stiffness.bending_Nmm2[1] = 4304.559572;
  Scene curved = uniform_rod(100, stiffness, {Force{82.830221, Frame::fixed, {-0.710746, 1.094913, 0.027073}}});
  curved.sections[0].rest_curvature_per_mm = {-0.028398755, 0.009178627, 0.011752364};
  const Vector3d exact_mm = tip(by_exact(curved));
  EXPECT_LT((tip(by_fem(curved, 50, 2)) - exact_mm).norm(), 1e-3);
  for (const double tolerance_mm : {1.0, 0.1, 1e-3}) {
    EXPECT_LT((tip(by_fam(curved, tolerance_mm)) - exact_mm).norm(), tolerance_mm);
    EXPECT_GT((tip(by_fam(support::stiffer(curved), tolerance_mm)) - exact_mm).norm(), 1.0);
  }
}

// At 4 and 16 times Euler's load the determinant of the all but straight rod is that of no load: two unstable
// directions have passed zero, or four.
TEST(SurvivorsFam, PushedColumn) {
  pushed_column([](const Scene& scene) { return by_fam(scene, 1e-6); }, {1.3, 3.0, 4.0, 16.0, 30.0});
}
TEST(SurvivorsFem, PushedColumn) {
  pushed_column([](const Scene& scene) { return by_fem(scene, 24, 2); }, {1.3, 3.0});
}
TEST(SurvivorsExact, PushedColumn) {
  pushed_column([](const Scene& scene) { return by_exact(scene); });
}

// Random columns beside their buckling loads, on which each method once jumped when it did not look at its determinant:
// two methods that share no mechanics end on the same branch.
void same_branch(const Method& solve, const Method& other, const std::vector<std::uint64_t>& seeds) {
  for (const std::uint64_t seed : seeds) {
    const Scene scene = studies::random_scene(seed);
    const double length_mm = scene::length_mm(scene);
    EXPECT_LT((tip(solve(scene)) - tip(other(scene))).norm(), 1e-3 * length_mm) << seed;
    const Equilibrium twin = solve(support::stiffer(scene, 1.1));
    if (!twin.converged()) continue;
    EXPECT_GT((tip(twin) - tip(other(scene))).norm(), 1e-3 * length_mm) << seed;
  }
}

TEST(SurvivorsFam, SameBranch) {
  same_branch([](const Scene& scene) { return by_fam(scene, 1e-4 * scene::length_mm(scene)); },
              [](const Scene& scene) { return by_exact(scene, 1e-8); },
              {131, 202, 100003, 100005, 100015, 100034, 100038});
}
TEST(SurvivorsExact, SameBranch) {
  same_branch([](const Scene& scene) { return by_exact(scene, 1e-8); },
              [](const Scene& scene) { return by_fam(scene, 1e-4 * scene::length_mm(scene)); },
              {100003, 100005, 100015, 100034, 100038});
}

// A column on its axis stays there and is unstable beyond Euler's load, however far beyond.
void column_on_its_axis(const Method& solve) {
  for (const double euler_loads : {0.9, 1.1, 5., 9.5, 12., 30.}) {
    const double pressed_N = euler_loads * pi * pi / 4 * 750 / 1600;
    const Equilibrium found = solve(uniform_rod(40, slender(750, 500), {Force{40, Frame::fixed, {-pressed_N, 0, 0}}}));
    EXPECT_LT((tip(found) - Vector3d(40, 0, 0)).norm(), 1e-9);
    EXPECT_EQ(found.stable, std::optional(euler_loads < 1)) << euler_loads;
  }
}

TEST(SurvivorsFam, ColumnOnItsAxis) {
  column_on_its_axis([](const Scene& scene) { return by_fam(scene, 1e-3); });
}
TEST(SurvivorsFem, ColumnOnItsAxis) {
  column_on_its_axis([](const Scene& scene) { return by_fem(scene); });
}
TEST(SurvivorsExact, ColumnOnItsAxis) {
  column_on_its_axis([](const Scene& scene) { return by_exact(scene); });
}

// Fixed forces of P at arms a that press on each other across the tip's section, and a small torque M: GJ phi/L = 2 a P
// sin(phi) + M. As the loads grow the turn goes from 0 towards pi, and not to one of the roots beyond.
void pressed_across(const Method& solve) {
  const double a = 2, GJ = 500, L = 40, M = 0.01;
  for (const double P : {20., 100.}) {
    double below = 0.1, above = pi;
    while (above - below > 1e-14) {
      const double phi = (below + above) / 2;
      (GJ * phi / L < 2 * a * P * std::sin(phi) + M ? below : above) = phi;
    }
    const auto turn = [&](double factor) {
      std::vector<Load> loads = couple(40, {0, -P, 0}, {a, 0});
      loads.push_back(Moment{40, Frame::follower, {M, 0, 0}});
      const Equilibrium found = solve(support::stiffer(uniform_rod(L, slender(750, GJ), loads), factor));
      EXPECT_LT((tip(found) - Vector3d(40, 0, 0)).norm(), 1e-6) << P;
      return found.converged() ? twist(found.tip().rotation_BS) : NAN;
    };
    EXPECT_NEAR(turn(1), below, 1e-6) << P;
    EXPECT_GT(std::abs(turn(1.05) - below), 1e-4) << P;
  }
}

TEST(SurvivorsFam, PressedAcross) {
  pressed_across([](const Scene& scene) { return by_fam(scene, 1e-7); });
}
TEST(SurvivorsFem, PressedAcross) {
  pressed_across([](const Scene& scene) { return by_fem(scene, 20, 2); });
}
TEST(SurvivorsExact, PressedAcross) {
  pressed_across([](const Scene& scene) { return by_exact(scene); });
}

// No energy, no verdict; with one, Prandtl's and Michell's critical load of a strip, 4.0126 sqrt(EI GJ)/L^2 (Timoshenko
// and Gere), whose stability is a matter of the moments along it.
TEST(SurvivorsFam, StabilityOfAStrip) {
  scene::Stiffness wide = slender(1, 16);
  wide.bending_Nmm2[1] = 1e6;
  const auto pressed = [&](double load) { return uniform_rod(1, wide, {Force{1, Frame::fixed, {0, load, 0}}}); };
  constexpr double critical = 4.0126 * 4;
  const Equilibrium below = by_fam(pressed(0.98 * critical), 1e-4), above = by_fam(pressed(1.02 * critical), 1e-4);
  EXPECT_EQ(below.stable, std::optional(true));
  EXPECT_EQ(above.stable, std::optional(false));
  EXPECT_GT(fact<int>(above, "segments"), 1);
  Scene turned = pressed(1);
  turned.loads.push_back(Moment{1, Frame::fixed, {0, 0, 1}});
  EXPECT_EQ(by_fam(turned, 1e-4).stable, std::nullopt);
}

// A cantilever bent by a quarter turn under F L^2/EI = 30: guesses that go on as the last step did take few load steps.
template <class Solve>
int load_steps(Solve&& solve) {
  return fact<int>(solve(uniform_rod(1, slender(1, 1), {Force{1, Frame::fixed, {0, 30, 0}}})), "load_steps");
}
TEST(SurvivorsFam, FewLoadSteps) {
  EXPECT_LE(load_steps([](const Scene& scene) { return by_fam(scene, 1e-6); }), 13);  // 13; with lines for parabolas 14
}
// The first step goes along the tangent, the second along its parabola: 3 steps of a rod pulled and bent by a radian; 5
// without the tangent, 4 with lines.
TEST(SurvivorsFam, FewLoadStepsFromTheTangentOn) {
  const Scene rod = uniform_rod(40, slender(750, 500),
                                {Force{40, Frame::fixed, {0.8, 0.6, 0}}, Moment{40, Frame::fixed, {0, 0, 15}}});
  EXPECT_LE(fact<int>(by_fam(rod, 1e-5), "load_steps"), 3);
}
TEST(SurvivorsFem, FewLoadSteps) {
  EXPECT_LE(load_steps([](const Scene& scene) { return by_fem(scene); }), 40);
}
TEST(SurvivorsExact, FewLoadSteps) {
  EXPECT_LE(load_steps([](const Scene& scene) { return by_exact(scene); }), 25);
}

// A rod that its symmetry holds passes the load at which it could leave in a step no longer than
// smallest_bifurcation_step = 1e-5, to which halving leads and from which the steps grow again, two- or threefold: at
// least log3(0.1/1e-5) = 8.4 of them. A strip in its plane passes 4.013 sqrt(EI GJ)/L^2 (Prandtl 1899), a column on its
// axis Euler's load; that one FAM solves for at once.
TEST(SurvivorsFam, PrandtlsLoadIsPassedInAShortStep) {
  const Scene strip =
      uniform_rod(1, {0.7, {1, 400}, {}, {}, 0}, {Force{1, Frame::fixed, {0, 1.25 * 4.013 * std::sqrt(0.7), 0}}});
  const Equilibrium held = by_fam(strip, 1e-3);
  EXPECT_GE(fact<int>(held, "load_steps"), 9);
  EXPECT_EQ(held.stable, false);
}
TEST(SurvivorsExact, EulersLoadIsPassedInAShortStep) {
  const Scene column = uniform_rod(1, slender(1, 0.7), {Force{1, Frame::fixed, {-1.25 * pi * pi / 4, 0, 0}}});
  EXPECT_GE(fact<int>(by_exact(column), "load_steps"), 9);
}

// A coil, whose load steps meet the largest turn: each step three times longer than the last was refused and halved
// twice, and the work limit met.
TEST(SurvivorsFam, CoilsGrowWithinTheLargestTurn) {
  const Scene coil = studies::random_scene(studies::campaign_seed(70001, 1319));
  const double tolerance_mm = 1e-3 * scene::length_mm(coil);
  const Vector3d exact_mm = tip(by_exact(coil));
  const auto grown = [tolerance_mm](const Scene& scene) {
    return fam::solve(scene, {.tolerance_mm = tolerance_mm, .locate_limit = false});
  };
  const Equilibrium found = grown(coil);
  ASSERT_TRUE(found.converged()) << found.message;
  EXPECT_LT((tip(found) - exact_mm).norm(), tolerance_mm);
  EXPECT_GT((tip(grown(support::stiffer(coil))) - exact_mm).norm(), 3 * tolerance_mm);
}

// A strip twisted by ten thousand turns: its steps are a half radian each, and too many.
TEST(SurvivorsFam, WorkLimitIsAStatus) {
  const Equilibrium found = by_fam(
      uniform_rod(1, strip(), {Moment{1, Frame::fixed, {2e4 * pi, 0, 0}}, Force{1, Frame::fixed, {0, 0.1, 0.1}}}),
      1e-2);
  EXPECT_EQ(found.status, scene::Status::work_limit) << found.message;
}

}  // namespace
