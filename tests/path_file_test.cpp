// Path files: what is read, what is refused and how, and the scene at a value of each parameter.
#include "scene/path_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {

using scene::PathParameter;
using scene::PathRequest;

const std::string path_rod = R"({"length_mm": 100, "stiffness": {"bending_Nmm2": 1000, "torsion_Nmm2": 800},
                            "rest_curvature_per_mm": [0, 0.01, 0]})";
const std::string fixed_force = R"({"kind": "force", "at": "tip", "frame": "fixed", "value_N": [0, 2, 0]})";
const std::string follower_moment = R"({"kind": "moment", "at": "tip", "frame": "follower", "value_Nmm": [0, 0, 3]})";
const std::string one_tendon = R"({"kind": "tendon", "offset_mm": [1, 0], "tension_N": 5})";

PathRequest read_path_text(const std::string& path, const std::string& loads) {
  std::istringstream file(R"({"scene": {"rod": {"sections": [)" + path_rod + R"(]}, "loads": [)" + loads +
                          R"(]}, "path": )" + path + "}");
  return scene::read_path(file, "f");
}

std::string path_refusal(const std::string& path,
                         const std::string& loads = fixed_force + "," + follower_moment + "," + one_tendon) {
  try {
    read_path_text(path, loads);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(PathFile, IsRead) {
  const PathRequest request = read_path_text(
      R"({"parameter": "turn_rad", "axis": [0, 0, 2], "from": 1, "to": 3, "stop_at": [2], "branches": 4, "largest_step": 0.5})",
      fixed_force);
  EXPECT_EQ(request.parameter, PathParameter::turn_rad);
  EXPECT_EQ(request.axis_B, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(request.from, 1);
  EXPECT_EQ(request.to, 3);
  EXPECT_EQ(request.stop_at, std::vector<double>{2});
  EXPECT_EQ(request.branches, 4);
  EXPECT_EQ(request.largest_step, 0.5);
  const PathRequest value =
      read_path_text(R"({"parameter": "value", "load": 1, "component": "tension", "from": 0, "to": 1})",
                     fixed_force + "," + one_tendon);
  EXPECT_EQ(value.loads, std::vector<std::size_t>{1});
  EXPECT_EQ(value.component, 0);
}

TEST(PathFile, SaysWhatIsWrong) {
  const std::string range = R"("from": 0, "to": 1)";
  EXPECT_EQ(path_refusal(R"({"parameter": "load", )" + range + "}"),
            R"(f: path.parameter = "load": must be "load_factor", "turn_rad", "rest_curvature_factor" or "value")");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "loads": [3], )" + range + "}"),
            "f: path.loads = 3: there is no such load; the first is 0, the last 2");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "loads": [0, 0], )" + range + "}"),
            "f: path.loads = 0: must not be there twice");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "from": 1, "to": 1})"),
            "f: path.to = 1: must be finite and another than from");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "from": -1, "to": 1})"),
            "f: path.from = -1: must be >= 0: a tendon's tension is");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "loads": [0], "from": -1, "to": 1})"), "");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "load": 0, )" + range + "}"),
            "f: path.load = 0: is for the parameter value alone");
  EXPECT_EQ(path_refusal(R"({"parameter": "value", "load": 2, "component": "x", )" + range + "}"),
            R"(f: path.component = "x": must be "tension")");
  EXPECT_EQ(path_refusal(R"({"parameter": "value", "load": 0, "component": "tension", )" + range + "}"),
            R"(f: path.component = "tension": must be "x", "y" or "z")");
  EXPECT_EQ(path_refusal(R"({"parameter": "value", "load": 9, "component": "x", )" + range + "}"),
            "f: path.load = 9: there is no such load; the first is 0, the last 2");
  EXPECT_EQ(path_refusal(R"({"parameter": "turn_rad", "axis": [0, 0, 0], )" + range + "}"),
            "f: path.axis = [0, 0, 0]: must be finite and not zero");
  EXPECT_EQ(path_refusal(R"({"parameter": "turn_rad", "axis": [1, 0, 0], )" + range + "}", follower_moment),
            R"(f: path.parameter = "turn_rad": a turn needs a fixed load or gravity)");
  EXPECT_EQ(path_refusal(R"({"parameter": "turn_rad", )" + range + "}"),
            "f: path.axis = (missing): the key is required");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", )" + range + "}", ""),
            R"(f: path.parameter = "load_factor": a load factor needs a load)");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "stop_at": [2], )" + range + "}"),
            "f: path.stop_at = 2: must lie between from and to");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "largest_step": 0, )" + range + "}"),
            "f: path.largest_step = 0: must be > 0");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", "branches": 0.5, )" + range + "}"),
            "f: path.branches = 0.5: must be a whole number from 0 to 1000");
  EXPECT_EQ(path_refusal(R"({"parameter": "load_factor", )" + range + "}",
                         R"({"kind": "force", "at": 200, "frame": "fixed", "value_N": [0, 2, 0]})"),
            "f: scene.loads[0].at = 200: must lie on the rod, 0 < s <= 100 mm");
}

TEST(Path, SceneAtAValueOfEachParameter) {
  const auto scene_at = [](const std::string& path, const std::string& loads, double value) {
    return scene::scene_at(read_path_text(path, loads), value);
  };
  const std::string both = fixed_force + "," + follower_moment;
  const scene::Scene grown = scene_at(R"({"parameter": "load_factor", "loads": [1], "from": 0, "to": 1})", both, 1.5);
  EXPECT_EQ(std::get<scene::Force>(grown.loads[0]).value_N, Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(std::get<scene::Moment>(grown.loads[1]).value_Nmm, Eigen::Vector3d(0, 0, 4.5));
  const scene::Scene turned =
      scene_at(R"({"parameter": "turn_rad", "axis": [3, 0, 0], "from": 0, "to": 1})", both, std::acos(0.));
  EXPECT_LE((std::get<scene::Force>(turned.loads[0]).value_N - Eigen::Vector3d(0, 0, 2)).norm(), 1e-15);
  EXPECT_EQ(std::get<scene::Moment>(turned.loads[1]).value_Nmm, Eigen::Vector3d(0, 0, 3));
  const scene::Scene coiled = scene_at(R"({"parameter": "rest_curvature_factor", "from": 0, "to": 1})", both, 2);
  EXPECT_EQ(coiled.sections[0].rest_curvature_per_mm, Eigen::Vector3d(0, 0.02, 0));
  const scene::Scene valued =
      scene_at(R"({"parameter": "value", "load": 0, "component": "z", "from": 0, "to": 1})", both, -7);
  EXPECT_EQ(std::get<scene::Force>(valued.loads[0]).value_N, Eigen::Vector3d(0, 2, -7));
}

// A snap from y = 1 at parameter 0.8 to the stable point between 3 and 5.
TEST(Path, LandingOfASnap) {
  using Kind = scene::PathPoint::Kind;
  const auto point = [](double parameter, double y, bool stable, Kind kind = Kind::regular) {
    scene::PathPoint p;
    p.parameter = parameter;
    p.tip_position_B_mm = {0, y, 0};
    p.stable = stable;
    p.kind = kind;
    return p;
  };
  scene::Path path;
  path.points = {
      point(0, 0, true, Kind::start),     point(0.5, 0.5, true), point(0.8, 1, false, Kind::fold), point(0.6, 2, false),
      point(0.5, 2.5, false, Kind::fold), point(0.7, 3, true),   point(0.9, 5, true, Kind::end)};
  const std::optional<scene::PathPoint> there = scene::landing(path, 2);
  ASSERT_TRUE(there);
  EXPECT_DOUBLE_EQ(there->parameter, 0.8);
  EXPECT_DOUBLE_EQ(there->tip_position_B_mm[1], 4);
  EXPECT_FALSE(scene::landing(path, 4));  // an unstable rod meets it
  path.points.back().branch = 1;
  EXPECT_FALSE(scene::landing(path, 2));
}

}  // namespace
