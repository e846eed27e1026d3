// What an estimation problem may not say, in a file or in code.
#include "fam/estimator.h"
#include "scene/estimation_file.h"
#include "support.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <tuple>

namespace {

using fam::Estimator;
using scene::EstimationProblem;

std::string refusal_of(const std::string& unknowns, const std::string& measurements) {
  std::istringstream input(
      R"({"scene":{"rod":{"sections":[{"length_mm":40,"stiffness":{"bending_Nmm2":750,)"
      R"("torsion_Nmm2":500,"mass_per_length_kg_per_m":0.1}}]},"loads":[{"kind":"force","at":"tip","frame":"fixed",)"
      R"("value_N":[0,0,0]},{"kind":"gravity","acceleration_m_per_s2":[0,0,-9.81]}]},"unknowns":)" +
      unknowns + R"(,"measurements":)" + measurements + "}");
  try {
    scene::read_estimation(input, "file");
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(EstimationRules, WrongProblemsAreRefusedInOneLine) {
  const std::string x = R"([{"load":0,"component":"x"}])";
  const std::string good = R"([{"kind":"position","at":"tip","value_mm":[40,0,0],"sd_mm":0.1}])";
  const auto measured = [](const std::string& rest) { return "[{" + rest + "}]"; };
  const std::tuple<std::string, std::string, std::string> cases[] = {
      {"[]", good, "file: unknowns = []: must hold an unknown"},
      {R"([{"load":0,"component":"q"}])", good, "unknowns[0].component"},
      {R"([{"load":7,"component":"x"}])", good, "unknowns[0].load = 7"},
      {R"([{"load":1,"at_mm":true}])", good, "unknowns[0].load"},
      {R"([{"section":1,"bending_factor":true}])", good, "unknowns[0].section = 1"},
      {R"([{"section":0,"shear_factor":true}])", good, "must name bending_factor"},
      {R"([{"load":0,"component":"x","prior_sd":-1}])", good, "unknowns[0].prior_sd = -1"},
      {R"([{"load":0,"component":"x","prior_mean":1}])", good, "needs a prior_sd"},
      {R"([{"load":0,"component":"x"},{"load":0,"component":"x"}])", good, "unknowns[1]"},
      {x, "[]", "measurements = []"},
      {x, measured(R"("kind":"position","at":41,"value_mm":[1,2,3],"sd_mm":1)"), "measurements[0].at = 41"},
      {x, measured(R"("kind":"position","at":4,"value_mm":[1,2,3],"sd_mm":0)"), "measurements[0].sd_mm = 0"},
      {x, measured(R"("kind":"rotation","at":4,"value":[[1,0,0],[0,1,0],[0,0,2]],"sd_rad":1)"), "R^T R = 1"},
      {x, measured(R"("kind":"smell","at":4)"), "measurements[0].kind"},
  };
  EXPECT_EQ(refusal_of(x, good), "");
  for (const auto& [unknowns, measurements, rule] : cases) {
    const std::string line = refusal_of(unknowns, measurements);
    EXPECT_NE(line.find(rule), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

std::string refusal_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

// What a file may not say, a problem made in C++ may not either; nor may a new measurement be another one.
TEST(EstimationRules, WrongValuesAreRefusedInCode) {
  constexpr double length_mm = 40;
  const scene::Scene rod = support::uniform_rod(length_mm, support::slender(1500, 1000),
                                                {scene::Force{length_mm, scene::Frame::fixed, {0, 0.1, 0}}});
  const scene::Measurement tip{length_mm, scene::PositionMeasurement{{39, 5, 0}, 0.1}};
  const scene::Unknown y{scene::Unknown::Kind::component, 0, 0, 1, 0.1};
  const EstimationProblem good{{{rod, {tip}}, {rod, {tip}}}, {y}};
  EXPECT_EQ(refusal_of([&] { scene::validate(good); }), "");
  const auto refused = [&](const std::function<void(EstimationProblem&)>& spoil) {
    EstimationProblem bad = good;
    spoil(bad);
    return refusal_of([&] { Estimator estimator(bad); });
  };
  EXPECT_EQ(
      refused([](auto& p) { p.scenes[1].scene.sections[0].length_mm = 50; }),
      "estimation: scenes[1].scene.rod.sections[0] = another one: must be that of the first scene: the rod is one");
  EXPECT_EQ(refused([](auto& p) { p.unknowns[0].index = 1; }),
            "estimation: unknowns[0].load = 1: there are 1 loads, counted from 0");
  EXPECT_EQ(refused([](auto& p) { p.unknowns[0].component = 3; }),
            "estimation: unknowns[0].component = 3: the component of a force must be below 3");
  EXPECT_EQ(refused([](auto& p) { p.unknowns[0].prior_sd = -1; }),
            "estimation: unknowns[0].prior_sd = -1: a standard deviation must be > 0");
  EXPECT_EQ(refused([](auto& p) { p.scenes[0].measurements[0].s_mm = 41; }),
            "estimation: scenes[0].measurements[0].at = 41: must be on the rod, 0 ... 40 mm");

  Estimator estimator(good);
  EXPECT_EQ(refusal_of([&] { estimator.set_measurement(1, 0, tip); }), "");
  EXPECT_NE(refusal_of([&] { estimator.set_measurement(2, 0, tip); }), "");
  EXPECT_NE(refusal_of([&] { estimator.set_measurement(0, 1, tip); }), "");
  EXPECT_NE(refusal_of([&] { estimator.set_measurement(0, 0, {41, tip.value}); }), "");
  EXPECT_NE(
      refusal_of([&] {
        estimator.set_measurement(0, 0, {length_mm, scene::RotationMeasurement{Eigen::Matrix3d::Identity(), 0.1}});
      }),
      "");
  EXPECT_EQ(refusal_of([&] {
              estimator.set_measurement(0, 0, {length_mm, scene::PositionMeasurement{{39, 5, 0}, 0}});
            }),
            "estimation: measurement.sd_mm = 0: a standard deviation must be > 0");
}

}  // namespace
