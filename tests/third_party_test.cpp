// Decks for other programs: what stands in them, what is refused, and what CalculiX makes of them.
#include "commands.h"

#include "scene/scene_file.h"
#include "studies/third_party/data.h"
#include "studies/third_party/deck.h"

#include <gtest/gtest.h>

#include <sstream>

namespace {

using commands::Outcome;
using commands::run;

const std::string tube =
    R"({"length_mm":30,"geometry":{"outer_diameter_mm":2,"inner_diameter_mm":1},
"material":{"youngs_modulus_MPa":2000,"poissons_ratio":0.3,"density_kg_per_m3":1200}})";
const std::string circle =
    R"({"length_mm":10,"geometry":{"outer_diameter_mm":3},
"material":{"youngs_modulus_MPa":1000,"poissons_ratio":0.4,"density_kg_per_m3":0}})";

std::string scene_text(const std::string& sections, const std::string& loads) {
  return R"({"title":"rod","rod":{"sections":[)" + sections + R"(]},"loads":[)" + loads + "]}";
}

std::string force(const std::string& at, const std::string& value, const std::string& more = "") {
  return R"({"kind":"force","at":)" + at + R"(,"value_N":)" + value +
         (more.find("frame") == std::string::npos ? R"(,"frame":"fixed")" : "") + more + "}";
}

Outcome exported(const std::string& scene, const std::string& options) {
  return run(commands::fam_studies, "export - " + options, scene);
}

std::string moment(const std::string& value, const std::string& frame = "fixed", const std::string& at = "\"tip\"") {
  return R"({"kind":"moment","at":)" + at + R"(,"frame":")" + frame + R"(","value_Nmm":)" + value + "}";
}

// A line that begins with a star is a keyword of both programs.
TEST(Deck, ATitleIsNoKeyword) {
  const std::string scene =
      R"({"title":"*STEP","rod":{"sections":[)" + circle + R"(]},"loads":[)" + force("\"tip\"", "[0,1,0]") + "]}";
  for (const std::string format : {"abaqus", "calculix"})
    EXPECT_EQ(exported(scene, "--format " + format).out.rfind("*HEADING\n *STEP\n", 0), 0u) << format;
}

// Written by hand from the manuals of both programs; that CalculiX's CIRC takes diameters was measured, see below. The
// pressure: 4 M over the square of two diameters, and over the side of the square in the circle.
TEST(Deck, SaysWhatTheSceneSays) {
  const std::string scene = scene_text(
      tube + "," + circle, force("30", "[0,1,0]") + "," + force("30", "[0.5,2,0]") + "," + moment("[0,0,-9]") +
                               R"(,{"kind":"gravity","acceleration_m_per_s2":[0,-9.81,0]})");
  const std::string calculix = exported(scene, "--format calculix --elements 4").out;
  EXPECT_EQ(calculix,
            "*HEADING\nrod\n** mm, N, MPa, t; CalculiX\n*NODE, NSET=ALL\n1, 0, 0, 0\n2, 0.25, 0, 0\n3, 0.5, 0, 0\n4, "
            "5.41666666666667, 0, 0\n5, 10.3333333333333, 0, 0\n6, 15.25, 0, 0\n7, 20.1666666666667, 0, 0\n8, "
            "25.0833333333333, 0, 0\n9, 30, 0, 0\n10, 35, 0, 0\n11, 40, 0, 0\n*ELEMENT, TYPE=B32R, ELSET=SPAN1\n1, 1, "
            "2, 3\n2, 3, 4, 5\n3, 5, 6, 7\n4, 7, 8, 9\n*ELEMENT, TYPE=B32, ELSET=SPAN2\n5, 9, 10, 11\n*NSET, "
            "NSET=TIP\n11\n*NODE\n12, 41.5, 0, 0\n13, 43, 0, 0\n14, 44.5, 0, 0\n15, 46, 0, 0\n*ELEMENT, TYPE=B32, "
            "ELSET=NEAR\n6, 11, 12, 13\n*ELEMENT, TYPE=B32, ELSET=FAR\n7, 13, 14, 15\n*MATERIAL, "
            "NAME=SECTION1\n*ELASTIC\n2000, 0.3\n*DENSITY\n1.2e-09\n*MATERIAL, NAME=SECTION2\n*ELASTIC\n1000, "
            "0.4\n*BEAM SECTION, ELSET=SPAN1, MATERIAL=SECTION1, SECTION=PIPE\n1, 0.5\n0, 0, -1\n*BEAM SECTION, "
            "ELSET=SPAN2, MATERIAL=SECTION2, SECTION=CIRC\n3, 3\n0, 0, -1\n*MATERIAL, NAME=END\n*ELASTIC\n1000000, "
            "0.4\n*BEAM SECTION, ELSET=NEAR, MATERIAL=END, SECTION=CIRC\n3, 3\n0, 0, -1\n*BEAM SECTION, ELSET=FAR, "
            "MATERIAL=END, SECTION=CIRC\n3, 3\n0, 0, -1\n*BOUNDARY\n1, 1, 6\nTIP, 3, 3\n*STEP, NLGEOM, "
            "INC=200\n*STATIC\n0.1, 1, 1e-6, 1\n*CLOAD\n9, 1, 0.5\n9, 2, 3\n*DLOAD\nSPAN1, GRAV, 9810, 0, -1, 0\n** "
            "The moment at the tip: a couple of pressures, which follows the section\n*DLOAD\nNEAR, P2, "
            "0.471404520791032\nFAR, P2, -0.471404520791032\n*NODE PRINT, NSET=TIP, FREQUENCY=1000\nU\n*END STEP\n");
  const std::string abaqus = exported(scene, "--format abaqus --elements 4").out;
  EXPECT_NE(abaqus.find("*ELEMENT, TYPE=B32, ELSET=SPAN1\n"), std::string::npos);
  EXPECT_NE(abaqus.find("SECTION=THICK PIPE\n1, 0.5\n"), std::string::npos);
  EXPECT_NE(abaqus.find("SECTION=CIRC\n1.5\n"), std::string::npos);
  const std::string follows = scene_text(circle, force("\"tip\"", "[0,1,0]", R"(,"frame":"follower")"));
  EXPECT_NE(exported(follows, "--format abaqus").out.find("*CLOAD, FOLLOWER\n101, 2, 1\n"), std::string::npos);
}

TEST(Deck, RefusesWhatItCannotSay) {
  const std::string stiff = R"({"length_mm":10,"stiffness":{"bending_Nmm2":10,"torsion_Nmm2":10}})";
  std::string curved = circle, soft = circle;
  curved.replace(curved.size() - 1, 1, R"(,"rest_curvature_per_mm":[0,0,0.01]})");
  soft.replace(soft.find("0.4"), 3, "0.499");
  struct Refused {
    std::string scene, format, message;
  };
  const Refused refused[] = {
      {scene_text(circle + "," + stiff, ""), "abaqus",
       "rod.sections[1] = stiffness: a deck for Abaqus needs geometry and material"},
      {scene_text(curved, ""), "abaqus",
       "rod.sections[0].rest_curvature_per_mm = not zero: a deck for Abaqus has a rod that is straight at rest"},
      {scene_text(soft, ""), "calculix",
       "rod.sections[0].material.poissons_ratio = 0.499: a deck for CalculiX needs one <= 0.495, its beams being "
       "solids"},
      {scene_text(circle, force("5", "[0,1,0]", R"(,"frame":"follower")")), "calculix",
       "loads[0].frame = follower: a deck for CalculiX has fixed forces alone"},
      {scene_text(circle, moment("[0,0,1]", "fixed", "5")), "calculix",
       "loads[0].at = 5: a deck for CalculiX has moments at the tip alone"},
      {scene_text(circle, moment("[3,0,1]", "follower")), "calculix",
       "loads[0].value_Nmm[0] = 3: a deck for CalculiX has no moment about the rod's axis"},
      {scene_text(circle, moment("[0,2,1]") + "," + force("5", "[0,1,0]")), "calculix",
       "loads[0].frame = fixed: a deck for CalculiX keeps the axis of a moment in a plane alone: this scene leaves it"},
      {scene_text(circle, force("5", "[0,1,0]", R"(,"offset_mm":[0,1])")), "abaqus",
       "loads[0].offset_mm = not zero: a deck for Abaqus has its forces on the centreline"},
      {scene_text(circle, R"({"kind":"tendon","offset_mm":[0,1],"tension_N":1})"), "calculix",
       "loads[0].kind = tendon: a deck for CalculiX has none"},
      {scene_text(circle, R"({"kind":"distributed_force","frame":"fixed","value_N_per_mm":[0,1,0]})"), "abaqus",
       "loads[0].kind = distributed_force: a deck for Abaqus has none"}};
  for (const auto& [scene, format, message] : refused) {
    const Outcome outcome = exported(scene, "--format " + format);
    EXPECT_EQ(outcome.exit_status, 2);
    EXPECT_EQ(outcome.err, "(standard input): " + message + "\n");
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(exported(scene_text(soft, ""), "--format abaqus").exit_status, 0);
  EXPECT_EQ(exported(scene_text(circle, ""), "").exit_status, 2);
  EXPECT_EQ(exported(scene_text(circle, ""), "--format ansys").exit_status, 2);
}

// Displacement of the tip that CalculiX prints, mm.
Eigen::Vector3d by_calculix(const std::string& scene) {
  const std::string job = (commands::scratch() / "job").string();
  EXPECT_EQ(exported(scene, "--format calculix --elements 20 --output " + job + ".inp").exit_status, 0);
  EXPECT_EQ(run("cd " + commands::scratch().string() + " && ccx", "job").exit_status, 0);  // leaves files where it is
  std::istringstream words(commands::contents(job + ".dat"));
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  if (all.size() < 3) return {NAN, NAN, NAN};
  return {std::stod(all[all.size() - 3]), std::stod(all[all.size() - 2]), std::stod(all.back())};
}

// Displacement of the tip by the exact reference, of a rod of 90 mm.
Eigen::Vector3d exactly(const std::string& scene) {
  const std::string csv = run(commands::fam_studies, "solve - --method exact --format csv", scene).out;
  std::istringstream last(csv.substr(csv.rfind('\n', csv.size() - 2) + 1));
  std::vector<double> cells;
  for (std::string cell; std::getline(last, cell, ',');) cells.push_back(std::stod(cell));
  return Eigen::Vector3d(cells.at(1) - 90, cells.at(2), cells.at(3));
}

// Within 1 % of the way of the tip by the exact reference. Twin: the same rod 5 % stiffer is not.
TEST(Deck, CalculixBendsItsRodAsTheExactReference) {
  if (std::system("command -v ccx >/dev/null") != 0) GTEST_SKIP() << "ccx is not installed";
  std::string wire = circle;  // at 0.4 its solids are 2.6 % too stiff
  wire.replace(wire.find("0.4"), 3, "0.3");
  const auto slender = [](std::string section, const std::string& length, const char* modulus) {
    section.replace(section.find(length), 2, "90");
    section.replace(section.find("000,") - 1, 4, modulus);
    return section;
  };
  struct Bent {
    std::string section, length, modulus, stiffer, loads;
  };
  const Bent bent[] = {
      // Measured: 0.12 %.
      {tube, "30", "2000", "2100",
       force("\"tip\"", "[0,0.1,0]") + R"(,{"kind":"gravity","acceleration_m_per_s2":[0,0,-9.81]})"},
      // Beyond 90 degrees: 0.16 %, and of a tube, whose faces are wider, 0.05 %.
      {wire, "10", "1000", "1050", moment("[0,0,-80]")},
      {tube, "30", "2000", "2100", moment("[0,-30,0]")},
      // In space a couple of pressures follows the section: 0.12 %.
      {wire, "10", "1000", "1050", moment("[0,-25,0]", "follower") + "," + force("\"tip\"", "[0,0.3,0]")}};
  for (const Bent& rod : bent) {
    const std::string scene = scene_text(slender(rod.section, rod.length, rod.modulus.c_str()), rod.loads);
    const std::string stiffer = scene_text(slender(rod.section, rod.length, rod.stiffer.c_str()), rod.loads);
    const Eigen::Vector3d exact_mm = exactly(scene), ccx_mm = by_calculix(scene);
    EXPECT_LT((ccx_mm - exact_mm).norm(), 0.01 * exact_mm.norm()) << rod.loads;
    EXPECT_GT((ccx_mm - exactly(stiffer)).norm(), 0.01 * exact_mm.norm()) << rod.loads;
  }
}

// What CalculiX cuts back to nothing is no tip, and has the share of the load that it reached.
TEST(Deck, CalculixSaysHowFarItCame) {
  if (!studies::calculix_is_there()) GTEST_SKIP() << "ccx is not installed";
  const auto pulled_across = [](const char* value_N) {
    std::istringstream text(scene_text(tube, force("\"tip\"", value_N)));
    return studies::solve_by_calculix(scene::read_scene(text, "scene"), 5);
  };
  const studies::ThirdPartyTip most = pulled_across("[0,100,0]"), none = pulled_across("[0,1e6,0]");
  EXPECT_EQ(most.status, "not_converged");
  EXPECT_GT(most.load_share, 0.5);
  EXPECT_LT(most.load_share, 1);
  EXPECT_EQ(none.status, "not_converged");
  EXPECT_EQ(none.load_share, 0);
}

// Of two scenes that were compared one's tip moves away with more elements; a third was left out.
TEST(ThirdPartyPage, NamesWhatGrowsAndWhatIsLeftOut) {
  studies::ThirdPartyData data;
  data.has_calculix = true;
  const auto add = [&](const char* name, const char* method, int elements, const char* status, double error_over_L) {
    data.tips.push_back({name, method, elements, status, 1, Eigen::Vector3d::Zero(), error_over_L, 1});
  };
  for (const char* name : {"NEARER", "AWAY", "SPACE"}) add(name, "exact", 0, "converged", 0);
  add("SPACE", "calculix", 0, "left_out", 0);
  for (const int n : {5, 10, 20, 40}) {
    add("NEARER", "calculix", n, "converged", 0.08 / n);
    add("AWAY", "calculix", n, "converged", 1e-4 * n);
  }
  const auto page = [&] {
    return studies::third_party_files(data, PROJECT_FOLDER "/studies/third_party/page.md").at("README.md");
  };
  EXPECT_NE(page().find("It grows on: AWAY."), std::string::npos);
  EXPECT_NE(page().find("Left out by name: SPACE;"), std::string::npos);
  EXPECT_NE(page().find("0.0030 L from the exact tip in the median and 0.0040 L at most, on\n2 of the 2 scenes"),
            std::string::npos);
  EXPECT_EQ(page().find("cuts its"), std::string::npos);
  data.tips.back().status = "not_converged";
  data.tips.back().load_share = 0.25;
  EXPECT_NE(page().find("AWAY at 25 %"), std::string::npos);
  EXPECT_NE(page().find("It grows on no scene."), std::string::npos);
}

}  // namespace
