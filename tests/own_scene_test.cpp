// `fam-studies compare`: distances, the most accurate answer, the gate, somebody's own centreline.
#include "commands.h"

#include "scene/scene_file.h"
#include "scene/span.h"
#include "studies/own_scene/comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using commands::contents;
using commands::Outcome;
using commands::run;
using commands::scratch;

constexpr double length_mm = 40, moment_Nmm = 60;

// Bent by a moment at its tip: a circle, in closed form.
scene::Scene circle(double bending_Nmm2) {
  return support::uniform_rod(length_mm, support::slender(bending_Nmm2, 1000),
                              {scene::Moment{length_mm, scene::Frame::fixed, {0, 0, moment_Nmm}}});
}

std::string circle_file() {
  const fs::path path = scratch() / "circle.json";
  std::ofstream(path) << scene::write_scene(circle(1500));
  return path.string();
}

// The circle of a rod of this stiffness at places that no method has by itself.
std::string circle_csv(double bending_Nmm2, double error_at_27_mm = 0) {
  std::ostringstream csv;
  csv.precision(17);
  csv << "s_mm,x,y,z\n";
  for (const double s_mm : {0.0, 1.7, 13.1, 27.0, 39.99, 40.0}) {
    const double curvature = moment_Nmm / bending_Nmm2;
    csv << s_mm << "," << std::sin(curvature * s_mm) / curvature << ","
        << (1 - std::cos(curvature * s_mm)) / curvature + (s_mm == 27.0 ? error_at_27_mm : 0) << ",0\n";
  }
  return csv.str();
}

Outcome compare(const std::string& options, const std::string& input = "") {
  return run(commands::fam_studies, "compare " + options + " --output " + (scratch() / "compare").string(), input);
}

// Limit 1e-9 mm, measured 2e-13: expected from the closed form of the circle. Twin: 5 % stiffer.
TEST(Against, ClosedFormOfACirclePassesAndAStifferRodFails) {
  const std::string options = circle_file() + " --methods fam,exact --against - --gate-mm ";
  EXPECT_EQ(compare(options + "1e-9", circle_csv(1500)).exit_status, 0);
  const Outcome twin = compare(options + "1e-9", circle_csv(1.05 * 1500));
  EXPECT_EQ(twin.exit_status, 1);
  EXPECT_NE(twin.err.find("(standard input): "), std::string::npos) << twin.err;
}

// The station, its distance and the limit, in one line.
TEST(Against, NamesTheStationThatFails) {
  const Outcome outcome =
      compare(circle_file() + " --methods exact --against - --gate-mm 0.01", circle_csv(1500, 0.25));
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.err,
            "(standard input): 0.25 mm from exact at s_mm = 27: must be <= 0.01 mm (1 of 6 stations fail, the first at "
            "s_mm = 27)\n");
}

// The file alone is gated: a method that is farther away does not matter.
TEST(Against, MethodsAreNotGated) {
  const std::string file = commands::case_file("study1/S4_follower");
  const std::string csv = run(commands::fam, "solve " + file + " --tolerance-mm 1e-9 --format csv").out;
  EXPECT_EQ(compare(file + " --against - --gate-mm 1e-6", csv).exit_status, 0);
  EXPECT_EQ(compare(file + " --gate-mm 1e-6").exit_status, 1);
}

TEST(Against, RefusesWhatIsNoCentreline) {
  const std::pair<std::string, std::string> wrong[] = {
      {"", "line 1 = (nothing): must name the columns s_mm, x, y, z"},
      {"0,0,0,0\n", "line 1 = 0,0,0,0: must name a column s_mm"},
      {"s_mm,x,y\n0,0,0\n", "line 1 = s_mm,x,y: must name a column z"},
      {"s_mm,x,y,z,x_mm\n", "line 1 = s_mm,x,y,z,x_mm: must name the column x once"},
      {"s_mm,x,y,z\n", "line 2 = (nothing): must be a row of s_mm, x, y, z"},
      {"s_mm,x,y,z\n0,0,0\n", "line 2 = 3 values: must have 4, one for each column"},
      {"s_mm,x,y,z\n0,0,0,nan\n", "line 2, z = nan: must be finite"},
      {"s_mm,x,y,z\n0,0,a,0\n", "line 2, y = a: must be a number"},
      {"s_mm,x,y,z\n-1,0,0,0\n", "line 2, s_mm = -1: must be >= 0, the clamp"},
      {"s_mm,x,y,z\n\n40.1,0,0,0\n", "line 3, s_mm = 40.1: must be <= 40, the rod's length"},
      {"s_mm,x,y,z\n2,2,0,0\n2,2,0,0\n", "line 3, s_mm = 2: must be > 2, the row before"},
      {"s_mm,x,y,z\n2,2,0,0\n1,1,0,0\n", "line 3, s_mm = 1: must be > 2, the row before"}};
  fs::remove_all(scratch() / "compare");
  for (const auto& [csv, message] : wrong) {
    const Outcome outcome = compare(circle_file() + " --against -", csv);
    EXPECT_EQ(outcome.exit_status, 2) << csv;
    EXPECT_EQ(outcome.err, "(standard input): " + message + "\n");
  }
  EXPECT_EQ(compare(circle_file() + " --against nowhere.csv").err,
            "nowhere.csv: (file) = (unreadable): must be a readable file of a centreline\n");
  EXPECT_FALSE(fs::exists(scratch() / "compare"));
}

// Order of the columns, others beside them, a byte order mark, blank lines; s a rounding beyond the tip.
TEST(Against, TakesWhatOthersWrite) {
  const scene::Scene rod = circle(1500);
  const fs::path path = scratch() / "mine.csv";
  std::ofstream(path) << "\xef\xbb\xbfz, note,\"y\",x_mm,s_mm\r\n\r\n3,a,2,1,0\r\n6,,5,4,40.00000003\r\n";
  const auto points = studies::read_centreline(path.string(), rod);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position_B_mm, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(points[1].position_B_mm, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(points[1].s_mm, 40);
}

// Every place becomes a station, none twice, and the rod stays what it was.
TEST(Against, CutsTheRodAtEveryPlace) {
  const scene::Scene rod = scene::read_scene_file(commands::case_file("robots/catheter_three_contacts"));
  const double length = scene::length_mm(rod);
  std::vector<studies::CentrelinePoint> places;
  for (int i = 0; i <= 30; ++i) places.push_back({length * i / 30, Eigen::Vector3d::Zero()});
  places[7].s_mm = places[6].s_mm * (1 + 1e-14);
  const scene::Scene cut = studies::cut_at(rod, places);
  EXPECT_NEAR(scene::length_mm(cut), length, 1e-12 * length);
  const auto before = scene::spans_of(rod), after = scene::spans_of(cut);
  double shortest_mm = length;
  for (const scene::Span& span : after) shortest_mm = std::min(shortest_mm, span.length_mm());
  EXPECT_GT(shortest_mm, 1e-9 * length);
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_TRUE(std::any_of(after.begin(), after.end(), [&](const scene::Span& span) {
      return std::abs(span.end_mm - places[i].s_mm) <= 1e-9 * length;
    })) << places[i].s_mm;
  }
  EXPECT_EQ(after.back().stiffness.bending_Nmm2, before.back().stiffness.bending_Nmm2);
  EXPECT_EQ(after.front().stiffness.bending_Nmm2, before.front().stiffness.bending_Nmm2);
}

TEST(Compare, MostAccurateIsTheReference) {
  const scene::Scene rod = scene::read_scene_file(commands::case_file("study1/S4_follower"));
  const auto key = [&](const std::vector<std::string>& methods) {
    return studies::compare("", rod, methods).truth()->key;
  };
  EXPECT_EQ(key({"fam", "exact", "fem"}), "exact");
  EXPECT_EQ(key({"published", "fem"}), "fem");
  EXPECT_EQ(key({"published"}), "published");
}

// Of the published law on case S4: gate of Study I at the tip, 0.0622 mm without shear and stretch; the whole shape
// differs more than its tip does.
TEST(Compare, ShapeIsJudgedNotTheTipAlone) {
  const scene::Scene rod = scene::read_scene_file(commands::case_file("study1/S4_follower"));
  const studies::Comparison comparison = studies::compare("S4", rod, {"published", "exact"});
  const studies::ComparedMethod& published = comparison.methods[0];
  const double tip_mm = published.distances.back().mm;
  const studies::Distance most = studies::farthest(published.distances);
  EXPECT_EQ(published.distances.back().s_mm, 40);
  EXPECT_GT(most.mm, 1.5 * tip_mm);
  EXPECT_LT(most.s_mm, 40);
  const double between_mm = (tip_mm + most.mm) / 2;  // the tip passes, the shape does not
  const auto failures = studies::gate_failures(comparison, between_mm);
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0].rfind("S4: published: ", 0), 0u);
  EXPECT_TRUE(studies::gate_failures(comparison, 1.001 * most.mm).empty());
}

// A method that cannot is no failure; one that could and did not solve is.
TEST(Compare, GateTellsUnsolvedFromUnsupported) {
  const std::string fixed = commands::case_file("study1/P4_fixed");
  const Outcome unsupported = compare(fixed + " --methods published,exact --gate-mm 1e-9");
  EXPECT_EQ(unsupported.exit_status, 0) << unsupported.err;
  EXPECT_NE(unsupported.out.find("| unsupported |"), std::string::npos);
  const Outcome none = compare(fixed + " --methods published");
  EXPECT_EQ(none.exit_status, 1);
  EXPECT_EQ(none.err, fixed + ": no method solved it\n");
  std::ofstream(scratch() / "wild.json")
      << R"({"rod":{"sections":[{"length_mm":500,"stiffness":{"bending_Nmm2":100,"torsion_Nmm2":80}}]},
"loads":[{"kind":"force","at":"tip","frame":"fixed","value_N":[-3,2,1]}]})";
  const Outcome wild = compare((scratch() / "wild.json").string() + " --methods rk4,exact --gate-mm 1");
  EXPECT_EQ(wild.exit_status, 1);
  EXPECT_NE(wild.err.find("rk4: not_"), std::string::npos) << wild.err;
}

// Four files; a row a method and scene; every number of the JSON that `solve` prints.
TEST(Compare, WritesTableCsvJsonAndPicture) {
  const std::string other = commands::case_file("study1/S4_follower");
  const Outcome outcome = compare(circle_file() + " " + other);
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const fs::path folder = scratch() / "compare";
  EXPECT_EQ(outcome.out, contents(folder / "compare.md"));
  std::istringstream rows(contents(folder / "compare.csv"));
  int lines = 0;
  for (std::string line; std::getline(rows, line);) ++lines;
  EXPECT_EQ(lines, 1 + 2 * 4);
  const auto json = nlohmann::json::parse(contents(folder / "compare.json"));
  ASSERT_EQ(json["scenes"].size(), 2u);
  const auto& methods = json["scenes"][1]["methods"];
  ASSERT_EQ(methods.size(), 4u);
  const auto solved =
      nlohmann::json::parse(run(commands::fam_studies, "solve " + other + " --method exact --format json").out);
  EXPECT_EQ(methods[3]["tip"], solved["tip"]);
  EXPECT_EQ(methods[3]["centreline"], solved["centreline"]);
  const std::string svg = contents(folder / "compare.svg");
  for (const std::string label :
       {"x, mm", "y, mm", "z, mm", "s, mm", "distance from exact, mm", "FAM published, 12 arcs"})
    EXPECT_NE(svg.find(">" + label + "<"), std::string::npos) << label;
}

TEST(Compare, RefusesWrongUsage) {
  const std::string file = circle_file();
  fs::remove_all(scratch() / "compare");
  for (const std::string options : {"", "nowhere.json", " --gate-mm 0", " --gate-mm nan", " --methods fam,fam",
                                    " --methods fam,abaqus", " FILE --against mine.csv", " --against ''"}) {
    std::string line = options.empty() || options[0] != ' ' ? options : file + options;
    if (const auto at = line.find("FILE"); at != std::string::npos) line.replace(at, 4, file);
    EXPECT_EQ(compare(line).exit_status, 2) << options;
  }
  EXPECT_EQ(compare("- --against -").exit_status, 2);
  EXPECT_FALSE(fs::exists(scratch() / "compare"));
  EXPECT_EQ(run(commands::fam_studies, "compare " + file + " --output /dev/null/x").exit_status, 1);
}

// The example workflow's own line, run.
TEST(Compare, WorkflowOfTheDocumentsRuns) {
  const std::string workflow = contents(fs::path(PROJECT_FOLDER) / "docs/compare_workflow.yml");
  const std::string start = "run: fam-studies ";
  const std::size_t at = workflow.find(start);
  ASSERT_NE(at, std::string::npos);
  const std::string arguments = workflow.substr(at + start.size(), workflow.find('\n', at) - at - start.size());
  std::ofstream(scratch() / "rod.json") << contents(circle_file());
  const auto gate = [&](double bending_Nmm2) {
    std::ofstream(scratch() / "centreline.csv") << circle_csv(bending_Nmm2);
    return run("cd " + scratch().string() + " && " + commands::fam_studies, arguments).exit_status;
  };
  EXPECT_EQ(gate(1500), 0);
  EXPECT_EQ(gate(1.05 * 1500), 1);
}

}  // namespace
