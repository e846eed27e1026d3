// `fam batch` as a user runs it.
#include "commands.h"

#include "fam/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using commands::contents;
using commands::Outcome;
using commands::run;
using commands::scratch;

// Two tendons and a force on the tip.
const std::string scene_text =
    R"({"rod":{"sections":[{"length_mm":40,"stiffness":{"bending_Nmm2":1500,"torsion_Nmm2":1000}}]},
"loads":[{"kind":"force","at":"tip","frame":"fixed","value_N":[0,0.1,0.2]},
         {"kind":"tendon","offset_mm":[1,0],"tension_N":1},{"kind":"tendon","offset_mm":[0,1],"tension_N":1}]})";

fs::path scene_file() {
  const fs::path path = scratch() / "batch.json";
  std::ofstream(path) << scene_text;
  return path;
}

Outcome batch(const std::string& values, const std::string& options = "") {
  return run(commands::fam, "batch " + scene_file().string() + " --values - " + options, values);
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

const std::string header = "x_mm,y_mm,z_mm,qw,qx,qy,qz,error_estimate_mm,status";

// Every digit of what solve_batch gives, in the order of the rows.
TEST(BatchCommand, RowsAreThoseOfTheLibrary) {
  const Outcome outcome = batch("0.y,2.tension\n0.1,1\n-0.3,2\n1e-3,0\n");
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, header.size() + 1), header + "\n");
  EXPECT_EQ(outcome.err.rfind("3 rods in ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find(" rods/s\n"), std::string::npos);

  const scene::Scene scene = support::uniform_rod(40, support::slender(1500, 1000),
                                                  {scene::Force{40, scene::Frame::fixed, {0, 0.1, 0.2}, {0, 0}},
                                                   scene::Tendon{{1, 0}, 1, 40}, scene::Tendon{{0, 1}, 1, 40}});
  fam::RowMajorMatrix values(3, 2);
  values << 0.1, 1, -0.3, 2, 1e-3, 0;
  const std::vector<fam::BatchColumn> columns{{0, 1}, {2, 0}};
  const fam::BatchResult expected = fam::solve_batch(scene, columns, values);
  const auto rows = rows_of(outcome.out);
  ASSERT_EQ(rows.size(), 4u);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto& row = rows[static_cast<std::size_t>(k) + 1];
    ASSERT_EQ(row.size(), 9u);
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_EQ(std::stod(row[static_cast<std::size_t>(i)]), expected.position_mm(k, i));
    for (Eigen::Index i = 0; i < 4; ++i)
      EXPECT_EQ(std::stod(row[static_cast<std::size_t>(i) + 3]), expected.rotation_wxyz(k, i));
    EXPECT_EQ(std::stod(row[7]), expected.error_estimate_mm[k]);
    EXPECT_EQ(row[8], "converged");
  }
}

// The tip of `fam solve` with the same values, both within the tolerance of 0.04 mm.
TEST(BatchCommand, TipIsThatOfSolve) {
  const Outcome outcome = batch("0.y\n0.1\n");
  const Outcome solved = run(commands::fam, "solve " + scene_file().string() + " --format csv");
  ASSERT_EQ(outcome.exit_status + solved.exit_status, 0) << outcome.err << solved.err;
  const auto rows = rows_of(outcome.out);
  const auto tip = rows_of(solved.out).back();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(std::stod(rows[1][i]), std::stod(tip[i + 1]), 0.08);
}

TEST(BatchCommand, WhatDoesNotMatterInAFileOfValues) {
  const std::string plain = batch("0.y,2.tension\n0.1,1\n-0.3,2\n").out;
  ASSERT_NE(plain, "");
  for (const char* same : {"0.y,2.tension\r\n0.1,1\r\n-0.3,2\r\n",
                           "\xef\xbb\xbf"
                           "0.y,2.tension\n0.1,1\n-0.3,2",
                           "\n\n 0.y , 2.tension\t\n\n0.1, 1\n   \n\n-0.3 ,2 \n\n",
                           "\"0.y\",\"2.tension\"\n1e-1,+1.0\n-3E-1,2e0\n", "0.y,2.tension\n.1,1.\n-.3,0002\n"}) {
    EXPECT_EQ(batch(same).out, plain) << same;
  }
  EXPECT_EQ(batch("2.tension,0.y\n1,0.1\n2,-0.3\n").out, plain);
  EXPECT_EQ(batch("0.y,2.tension\n").out, header + "\n");
  EXPECT_EQ(batch("0.x\n1e-400\n").exit_status, 0);  // no double is that small: zero, as in a scene
}

TEST(BatchCommand, WrongValuesAreOneLineAndNothingIsWritten) {
  const auto refused = [](const std::string& values) {
    const fs::path output = scratch() / "never.csv";
    const Outcome outcome = batch(values, "--output " + output.string());
    EXPECT_EQ(outcome.exit_status, 2) << values;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(output)) << values;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const std::string source = "(standard input): ";
    EXPECT_EQ(outcome.err.rfind(source, 0), 0u) << outcome.err;
    return outcome.err.substr(std::min(source.size(), outcome.err.size()));
  };
  EXPECT_EQ(refused(""), "line 1 = (nothing): must name the columns, such as 0.x or 2.tension\n");
  EXPECT_EQ(refused("x,y\n"), "line 1, column 1 = x: must be <load>.<component>, such as 0.x or 2.tension\n");
  EXPECT_EQ(refused("0.y,\n"), "line 1, column 2 = (nothing): must be <load>.<component>, such as 0.x or 2.tension\n");
  EXPECT_EQ(refused("0\n"), "line 1, column 1 = 0: must be <load>.<component>, such as 0.x or 2.tension\n");
  EXPECT_EQ(refused("\n0.y,3.x\n"), "line 2, column 2 = 3.x: must name one of the scene's 3 loads, counted from 0\n");
  EXPECT_EQ(refused("99999999999999999999.x\n"),
            "line 1, column 1 = 99999999999999999999.x: must name one of the scene's 3 loads, counted from 0\n");
  EXPECT_EQ(refused("0.w\n"), "line 1, column 1 = 0.w: the component of a force must be x, y or z\n");
  EXPECT_EQ(refused("0.tension\n"), "line 1, column 1 = 0.tension: the component of a force must be x, y or z\n");
  EXPECT_EQ(refused("1.x\n"), "line 1, column 1 = 1.x: the component of a tendon must be tension\n");
  EXPECT_EQ(refused("0.x,1.tension,0.x\n"), "line 1, column 3 = 0.x: the column is given twice\n");
  EXPECT_EQ(refused("0.x,0.y\n1,2\n\n1,2,3\n"), "line 4 = 3 values: must have 2, one for each column\n");
  EXPECT_EQ(refused("0.x,0.y\n1\n"), "line 2 = 1 values: must have 2, one for each column\n");
  EXPECT_EQ(refused("0.x,0.y\n1,\n"), "line 2, column 2 (0.y) = (nothing): must be a number\n");
  EXPECT_EQ(refused("0.x,0.y\n1,2 3\n"), "line 2, column 2 (0.y) = 2 3: must be a number\n");
  EXPECT_EQ(refused("0.x\n0x10\n"), "line 2, column 1 (0.x) = 0x10: must be a number\n");
  EXPECT_EQ(refused("0.x\n1;5\n"), "line 2, column 1 (0.x) = 1;5: must be a number\n");
  EXPECT_EQ(refused("0.x\n\x01\xff\n"), "line 2, column 1 (0.x) = \\x01\\xff: must be a number\n");
  EXPECT_EQ(refused("0.x\nnan\n"), "line 2, column 1 (0.x) = nan: must be finite\n");
  EXPECT_EQ(refused("0.x\n1e999\n"), "line 2, column 1 (0.x) = 1e999: must be finite\n");
  EXPECT_EQ(refused("1.tension\n-1\n"), "line 2, column 1 (1.tension) = -1: must be >= 0\n");
  EXPECT_EQ(refused(std::string(5000, '7')).size(), refused(std::string(500, '7')).size());
}

TEST(BatchCommand, WrongUsageIsExitStatusTwo) {
  const std::string scene = scene_file().string();
  const auto refused = [](const std::string& arguments) {
    const Outcome outcome = run(commands::fam, arguments, "0.x\n1\n");
    EXPECT_EQ(outcome.exit_status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    return outcome.err.substr(0, outcome.err.find('\n'));
  };
  EXPECT_EQ(refused("batch " + scene), "--values is required");
  EXPECT_EQ(refused("batch - --values -"), "--values: standard input is the scene already");
  EXPECT_EQ(refused("batch " + scene + " --values - --output \"\""), "--output: must name a file");
  EXPECT_EQ(refused("batch " + scene + " --values nowhere.csv"),
            "nowhere.csv: (file) = (unreadable): must be a readable file of values");
  EXPECT_EQ(refused("batch nowhere.json --values -"),
            "nowhere.json: (file) = (unreadable): must be a readable scene file");
  refused("batch " + scene + " --values - --arcs 3 --tolerance-mm 1");
  refused("batch " + scene + " --values - --law euler");
  refused("batch " + scene + " --values - --format json");
}

TEST(BatchCommand, ARowThatFailsKeepsItsStatusAndItsPlace) {
  const fs::path output = scratch() / "failed.csv";
  const Outcome outcome = batch("0.y\n0.1\n1e20\n0.2\n", "--output " + output.string());
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_NE(outcome.err.find("1 of 3 rods not converged; their status says why\n"), std::string::npos) << outcome.err;
  std::istringstream lines(contents(output));
  std::string title, first, second, third;
  std::getline(lines, title), std::getline(lines, first), std::getline(lines, second), std::getline(lines, third);
  EXPECT_EQ(title, header);
  EXPECT_TRUE(first.ends_with(",converged"));
  EXPECT_EQ(second.rfind(",,,,,,,,", 0), 0u) << second;
  EXPECT_FALSE(second.ends_with(",converged"));
  EXPECT_TRUE(third.ends_with(",converged"));
  EXPECT_FALSE(fs::exists(output.string() + ".partial"));
}

TEST(BatchCommand, OptionsReachTheSolver) {
  const auto cell = [](const std::string& options, std::size_t column) {
    return std::stod(rows_of(batch("0.y\n0.1\n", options).out).at(1).at(column));
  };
  EXPECT_GT(cell("--arcs 4", 7), 0);
  EXPECT_EQ(cell("--arcs 4 --no-estimate", 7), 0);
  EXPECT_EQ(cell("--arcs 4 --no-estimate", 0), cell("--arcs 4", 0));
  EXPECT_LE(cell("--tolerance-mm 1e-6", 7), 1e-6);
  EXPECT_GT(cell("--arcs 4 --law midpoint", 7), cell("--arcs 4 --law fourth_order", 7));
  EXPECT_EQ(batch("0.y\n0.1\n", "--law published").exit_status, 1);
  EXPECT_NE(batch("0.y\n0.1\n", "--law published").out.find(",unsupported\n"), std::string::npos);
}

TEST(BatchCommand, UnwritableOutputIsExitStatusOne) {
  const Outcome outcome = batch("0.y\n0.1\n", "--output /dev/null/rods.csv");
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_NE(outcome.err.find("/dev/null/rods.csv: cannot be written"), std::string::npos) << outcome.err;
}

}  // namespace
