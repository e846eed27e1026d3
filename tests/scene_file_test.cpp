// The scene file: what is read is what was written, and every rule refuses with file, path, value and rule.
#include "scene/scene_file.h"
#include "support.h"

#include <gtest/gtest.h>

#include <sstream>

namespace {

// The example of the format's page, every kind of load in it.
const std::string every_kind = R"({
  "title": "catheter with gravity and one contact",
  "rod": {
    "sections": [
      { "length_mm": 30, "stiffness": { "bending_Nmm2": 750, "torsion_Nmm2": 500, "axial_N": 333.4, "shear_N": 99.3,
                                        "mass_per_length_kg_per_m": 0.03 } },
      { "length_mm": 10, "geometry": { "outer_diameter_mm": 2.14, "inner_diameter_mm": 1.56 },
        "material": { "youngs_modulus_MPa": 1592.3, "poissons_ratio": 0.395, "density_kg_per_m3": 1100 },
        "rest_curvature_per_mm": [0, 0, 0.01] }
    ]
  },
  "loads": [
    { "kind": "force",  "at": "tip", "frame": "follower", "value_N":   [0, 1, 0] },
    { "kind": "moment", "at": 25.0,  "frame": "fixed",    "value_Nmm": [0, 0, 12] },
    { "kind": "distributed_force", "from_mm": 0, "to_mm": 40, "frame": "fixed", "value_N_per_mm": [0, 0, -0.01] },
    { "kind": "gravity", "acceleration_m_per_s2": [0, 0, -9.81] },
    { "kind": "tendon", "offset_mm": [0, 1.0], "tension_N": 3.0, "to_mm": 40 }
  ]
})";

scene::Scene read(const std::string& text) {
  std::istringstream input(text);
  return scene::read_scene(input, "bend.json");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "(accepted)";
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = every_kind;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(SceneFile, ReadsEveryKind) {
  const scene::Scene scene = read(every_kind);
  EXPECT_EQ(scene.title, "catheter with gravity and one contact");
  ASSERT_EQ(scene.sections.size(), 2u);
  const auto& first = std::get<scene::Stiffness>(scene.sections[0].cross_section);
  EXPECT_EQ(first.bending_Nmm2, Eigen::Vector2d(750, 750));
  EXPECT_EQ(*first.shear_N, Eigen::Vector2d(99.3, 99.3));
  EXPECT_EQ(*first.axial_N, 333.4);
  EXPECT_EQ(first.mass_per_length_kg_per_m, 0.03);
  EXPECT_EQ(std::get<scene::CircularSection>(scene.sections[1].cross_section).inner_diameter_mm, 1.56);
  EXPECT_EQ(scene.sections[1].rest_curvature_per_mm, Eigen::Vector3d(0, 0, 0.01));
  ASSERT_EQ(scene.loads.size(), 5u);
  EXPECT_EQ(std::get<scene::Force>(scene.loads[0]).at_mm, 40);
  EXPECT_EQ(std::get<scene::Moment>(scene.loads[1]).frame, scene::Frame::fixed);
  EXPECT_EQ(std::get<scene::DistributedForce>(scene.loads[2]).to_mm, 40);
  EXPECT_EQ(std::get<scene::Gravity>(scene.loads[3]).acceleration_m_per_s2[2], -9.81);
  EXPECT_EQ(std::get<scene::Tendon>(scene.loads[4]).offset_mm, Eigen::Vector2d(0, 1));
}

TEST(SceneFile, WritesWhatItReads) {
  const std::string once = scene::write_scene(read(every_kind));
  EXPECT_EQ(scene::write_scene(read(once)), once);
  EXPECT_NE(once.find("\"at\": \"tip\""), std::string::npos);
  EXPECT_NE(once.find("\"density_kg_per_m3\": 1100"), std::string::npos);
}

TEST(SceneFile, Defaults) {
  const scene::Scene scene = read(R"({"rod": {"sections": [{"length_mm": 7, "geometry": {"outer_diameter_mm": 6},
    "material": {"youngs_modulus_MPa": 10, "poissons_ratio": 0.5}}]},
    "loads": [{"kind": "distributed_force", "frame": "follower", "value_N_per_mm": [0, 1, 0]}]})");
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(std::get<scene::CircularSection>(scene.sections[0].cross_section).inner_diameter_mm, 0);
  const auto& force = std::get<scene::DistributedForce>(scene.loads[0]);
  EXPECT_EQ(force.from_mm, 0);
  EXPECT_EQ(force.to_mm, 7);
  EXPECT_TRUE(read(R"({"rod": {"sections": [{"length_mm": 1, "stiffness": {"bending_Nmm2": [1, 2], "torsion_Nmm2": 1}}
    ]}})")
                  .loads.empty());
}

// A place that rounding puts just beyond the tip is the tip: 0.7 + 0.1 + 0.2 < 1.
TEST(SceneFile, TipWithinRounding) {
  const std::string section = R"(, "stiffness": {"bending_Nmm2": 1, "torsion_Nmm2": 1}})";
  const scene::Scene scene =
      read(R"({"rod": {"sections": [{"length_mm": 0.7)" + section + R"(, {"length_mm": 0.1)" + section +
           R"(, {"length_mm": 0.2)" + section +
           R"(]}, "loads": [{"kind": "force", "at": 1, "frame": "fixed", "value_N": [1, 0, 0]}]})");
  EXPECT_EQ(scene.loads.size(), 1u);
}

struct Refusal {
  std::string text;  // a scene
  std::string path;  // "path = value" in the message
  std::string rule;  // a part of the rule
};

TEST(SceneFile, RefusesWithFilePathValueAndRule) {
  const std::vector<Refusal> refusals = {
      {"", "(top level) = (unreadable)", "not JSON"},
      {"{\"rod\": {", "rod = (unreadable)", "not JSON"},
      {"[]", "(top level) = []", "must be an object"},
      {"{}", "rod = (missing)", "required"},
      {R"({"rod": 3})", "rod = 3", "must be an object"},
      {R"({"rod": {"sections": []}, "loads": []})", "rod.sections = 0", "at least one section"},
      {R"({"rod": {"sections": {}}})", "rod.sections = {}", "must be an array"},
      {R"({"rod": {"sections": [7]}})", "rod.sections[0] = 7", "must be an object"},
      {replaced("\"length_mm\": 10", "\"length_mm\": -4"), "rod.sections[1].length_mm = -4", "must be > 0"},
      {replaced("\"length_mm\": 10", "\"length_mm\": 0"), "rod.sections[1].length_mm = 0", "must be > 0"},
      {replaced("\"length_mm\": 10", "\"length_mm\": \"ten\""), "rod.sections[1].length_mm = \"ten\"", "a number"},
      {replaced("\"length_mm\": 10", "\"length_mm\": true"), "rod.sections[1].length_mm = true", "a number"},
      {replaced("\"length_mm\": 10", "\"length_mm\": NaN"), "rod.sections[1].length_mm = (unreadable)", "not JSON"},
      {replaced("\"length_mm\": 10", "\"length_mm\": 1e999"), "rod.sections[1].length_mm = 1e999", "finite"},
      {replaced("\"length_mm\": 10", "\"length_mm\": 10, \"length_mm\": 11"), "rod.sections[1].length_mm =", "twice"},
      {replaced("\"length_mm\": 10", "\"lenght_mm\": 10"), "rod.sections[1].lenght_mm = 10", "unknown key"},
      {replaced("\"length_mm\": 10, ", ""), "rod.sections[1].length_mm = (missing)", "required"},
      {replaced("\"bending_Nmm2\": 750", "\"bending_Nmm2\": -1"), "rod.sections[0].stiffness.bending_Nmm2", "> 0"},
      {replaced("\"bending_Nmm2\": 750", "\"bending_Nmm2\": [1, 2, 3]"), "stiffness.bending_Nmm2 = [1,2,3]",
       "2 numbers"},
      {replaced("\"bending_Nmm2\": 750", "\"bending_Nmm2\": \"stiff\""), "stiffness.bending_Nmm2", "2 numbers"},
      {replaced("\"torsion_Nmm2\": 500", "\"torsion_Nmm2\": 0"), "stiffness.torsion_Nmm2 = 0", "> 0"},
      {replaced("\"axial_N\": 333.4", "\"axial_N\": -1"), "stiffness.axial_N = -1", "> 0"},
      {replaced("\"shear_N\": 99.3", "\"shear_N\": [1, 0]"), "stiffness.shear_N = [1, 0]", "> 0"},
      {replaced("0.03", "-0.03"), "stiffness.mass_per_length_kg_per_m = -0.03", ">= 0"},
      {replaced("2.14", "0"), "rod.sections[1].geometry.outer_diameter_mm = 0", "> 0"},
      {replaced("1.56", "2.14"), "rod.sections[1].geometry.inner_diameter_mm = 2.14", "< outer_diameter_mm = 2.14"},
      {replaced("1.56", "-1"), "rod.sections[1].geometry.inner_diameter_mm = -1", ">= 0"},
      {replaced("1592.3", "0"), "rod.sections[1].material.youngs_modulus_MPa = 0", "> 0"},
      {replaced("0.395", "0.51"), "rod.sections[1].material.poissons_ratio = 0.51", "(-1, 0.5]"},
      {replaced("0.395", "-1"), "rod.sections[1].material.poissons_ratio = -1", "(-1, 0.5]"},
      {replaced("1100", "-1"), "rod.sections[1].material.density_kg_per_m3 = -1", ">= 0"},
      {replaced("2.14", "1e200"), "rod.sections[1].geometry.outer_diameter_mm = 1e+200", "positive double"},
      {replaced("[0, 0, 0.01]", "[0, 0.01]"), "rod.sections[1].rest_curvature_per_mm = [0,0.01]", "3 numbers"},
      {replaced("\"geometry\": { \"outer_diameter_mm\": 2.14, \"inner_diameter_mm\": 1.56 },", ""),
       "rod.sections[1].geometry = (missing)", "required"},
      {replaced("\"stiffness\": {", "\"geometry\": {}, \"stiffness\": {"), "rod.sections[0]", "either stiffness"},
      {replaced("\"kind\": \"force\"", "\"kind\": \"push\""), "loads[0].kind = \"push\"", "must be force, moment"},
      {replaced("\"kind\": \"force\", ", ""), "loads[0].kind = (missing)", "required"},
      {replaced("\"at\": \"tip\"", "\"at\": 41"), "loads[0].at = 41", "0 < s <= 40 mm"},
      {replaced("\"at\": \"tip\"", "\"at\": 0"), "loads[0].at = 0", "0 < s <= 40 mm"},
      {replaced("\"at\": \"tip\"", "\"at\": \"base\""), "loads[0].at = \"base\"", "a number or \"tip\""},
      {replaced("\"frame\": \"follower\", ", ""), "loads[0].frame = (missing)", "required"},
      {replaced("\"frame\": \"follower\"", "\"frame\": \"global\""), "loads[0].frame = \"global\"", "\"follower\""},
      {replaced("[0, 1, 0]", "[0, null, 0]"), "loads[0].value_N[1] = null", "a number"},
      {replaced("\"value_N\":", "\"value_Nmm\":"), "loads[0].value_Nmm", "unknown key"},
      {replaced("\"from_mm\": 0", "\"from_mm\": 40"), "loads[2].from_mm = 40", "0 <= s < 40 mm"},
      {replaced("\"from_mm\": 0, \"to_mm\": 40", "\"from_mm\": 20, \"to_mm\": 10"), "loads[2].from_mm = 20", "< to_mm"},
      {replaced("\"tension_N\": 3.0", "\"tension_N\": -3"), "loads[4].tension_N = -3", ">= 0"},
      {replaced("3.0, \"to_mm\": 40", "3.0, \"to_mm\": 50"), "loads[4].to_mm = 50", "0 < s <= 40 mm"},
      {replaced("[0, 1, 0]", "[0, 1, 0], \"offset_mm\": [1]"), "loads[0].offset_mm = [1]", "2 numbers"},
      {replaced("[0, 1, 0]", "[0, 1, 0], \"offset_mm\": [1, 1e999]"), "loads[0].offset_mm", "finite"},
      {replaced("\"tension_N\": 3.0", "\"tension_N\": 3.0, \"at\": 3"), "loads[4].at", "unknown key"},
      {R"({"rod": {"sections": [{"length_mm": 1, "stiffness": {"bending_Nmm2": 1, "torsion_Nmm2": 1}}]},
           "loads": [{"kind": "gravity", "acceleration_m_per_s2": [0, 0, -9.81]}]})",
       "loads[0].acceleration_m_per_s2 = [0, 0, -9.81]", "needs a section with a mass"},
      {std::string(40, '['), " = {...", "nested too deeply"},
      {"{\"title\": \"\xff\"}", "(unreadable)", "not JSON"},
  };
  for (const Refusal& expected : refusals) {
    const std::string message = refusal(expected.text);
    EXPECT_EQ(message.rfind("bend.json: ", 0), 0u) << message;
    EXPECT_NE(message.find(expected.path), std::string::npos) << message << "\n  expected " << expected.path;
    EXPECT_NE(message.find(expected.rule), std::string::npos) << message << "\n  expected " << expected.rule;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(SceneFile, NamesAFileThatCannotBeRead) {
  try {
    scene::read_scene_file("no/such/file.json");
    FAIL() << "accepted";
  } catch (const scene::SceneError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("no/such/file.json: ", 0), 0u);
  }
}

// Circle of 6 mm, nu = 0.5: GJ = 2 EI / 3, EA = EI 64/(4 d^2) = EI/2.25, kGA = 9/10 GA (Cowper: 6(1+nu)/(7+6nu)).
TEST(Section, SolidCircle) {
  const scene::Stiffness s = stiffness_of(support::study1_scene("P1", "follower").sections[0]);
  EXPECT_NEAR(s.bending_Nmm2[0], 750, 1e-10);
  EXPECT_NEAR(s.torsion_Nmm2, 500, 1e-10);
  EXPECT_NEAR(*s.axial_N, 750 / 2.25, 1e-10);
  EXPECT_NEAR((*s.shear_N)[1], 0.9 * 750 / 2.25 / 3, 1e-10);
}

// The catheter of the paper's Study II; EI, GJ and area 1.6854645 mm^2 by hand from its diameters.
TEST(Section, Tube) {
  const scene::Stiffness s = stiffness_of(read(every_kind).sections[1]);
  EXPECT_NEAR(s.bending_Nmm2[0], 1176.4, 0.05);
  EXPECT_NEAR(s.torsion_Nmm2, 843.3, 0.05);
  EXPECT_NEAR(s.mass_per_length_kg_per_m, 1100 * 1.6854645e-6, 1e-9);
}

}  // namespace
