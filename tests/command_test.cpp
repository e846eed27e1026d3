// The commands as a user runs them: output, exit status, nothing half-written.
#include "commands.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace commands;

// Every key of the contract, with both methods.
TEST(Command, SolveJson) {
  for (const auto& [command, options] : {std::pair{fam, ""}, std::pair{fam_studies, " --method fem"}}) {
    const Outcome outcome = run(command, "solve " + case_file("study1/S4_follower") + " --format json" + options);
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    const json result = json::parse(outcome.out);
    EXPECT_EQ(result["status"], "converged");
    EXPECT_EQ(result["method"], command == fam ? "fam" : "fem");
    const Eigen::Vector3d exact_mm = support::study1_tip_mm("S4", "follower", "reissner");
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(result["tip"]["position_mm"][i].get<double>(), exact_mm[i], 0.04);
    EXPECT_EQ(result["tip"]["rotation"].size(), 3u);
    EXPECT_GT(result["tip"]["angle_rad"].get<double>(), 0.4);
    EXPECT_EQ(result["base"]["force_N"].size(), 3u);
    EXPECT_EQ(result["base"]["moment_Nmm"].size(), 3u);
    EXPECT_GE(result["centreline"].size(), 41u);
    EXPECT_EQ(result["centreline"].back()["s_mm"], 40);
    EXPECT_EQ(result["centreline"].back()["position_mm"], result["tip"]["position_mm"]);
    EXPECT_GT(result["error_estimate_mm"].get<double>(), 0);
    EXPECT_LT(result["error_estimate_mm"].get<double>(), 0.04);
    EXPECT_GT(result["time_us"].get<double>(), 0);
    EXPECT_TRUE(result["stable"].is_null());
    for (const char* key : command == fam ? std::array{"law", "arcs", "planar", "torsion", "shear", "solver", "reason"}
                                          : std::array{"elements", "order", "load_steps", "newton_iterations",
                                                       "elements", "elements", "elements"}) {
      EXPECT_TRUE(result["model"].contains(key)) << key;
    }
  }
}

TEST(Command, CheckValueThroughTheCommand) {
  const std::string scene =
      R"({"rod":{"sections":[{"length_mm":40,"stiffness":{"bending_Nmm2":1500,"torsion_Nmm2":1000}}]},
    "loads":[{"kind":"force","at":"tip","frame":"follower","value_N":[-0.5,0.8,0.6]},
             {"kind":"moment","at":"tip","frame":"follower","value_Nmm":[10,20,-15]}]})";
  const Outcome outcome = run(fam, "solve - --law fourth_order --arcs 128 --format json", scene);
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const json tip = json::parse(outcome.out)["tip"]["position_mm"];
  EXPECT_NEAR(tip[0].get<double>(), 39.801266166031, 1e-8);
  EXPECT_NEAR(tip[1].get<double>(), 3.068161908374, 1e-8);
  EXPECT_NEAR(tip[2].get<double>(), 0.175073477554, 1e-8);
}

TEST(Command, TextCsvAndPicture) {
  const Outcome text = run(fam, "solve " + case_file("study1/P4_follower"));
  EXPECT_EQ(text.exit_status, 0);
  EXPECT_NE(text.out.find("tip position, mm"), std::string::npos);
  EXPECT_NE(text.out.find("reason"), std::string::npos);

  const fs::path svg = scratch() / "shape.svg";
  const Outcome csv = run(fam, "solve " + case_file("study1/P4_follower") + " --format csv --svg " + svg.string());
  EXPECT_EQ(csv.out.rfind("s_mm,x_mm,y_mm,z_mm,R11,", 0), 0u);
  EXPECT_GE(std::count(csv.out.begin(), csv.out.end(), '\n'), 42);
  EXPECT_EQ(contents(svg).rfind("<svg ", 0), 0u);
}

TEST(Command, UnsupportedIsExitStatusOneAndNoTip) {
  const Outcome text = run(fam, "solve " + case_file("study1/S4_fixed") + " --law published");
  EXPECT_EQ(text.exit_status, 1);
  EXPECT_EQ(text.out, "");
  EXPECT_NE(text.err.find("unsupported: loads[0]"), std::string::npos) << text.err;
  const Outcome piped = run(fam, "solve - --law published", contents(case_file("study1/S4_fixed")));
  EXPECT_EQ(piped.err.rfind("(standard input): unsupported: ", 0), 0u) << piped.err;

  const fs::path svg = scratch() / "never.svg";
  const Outcome outcome =
      run(fam, "solve " + case_file("study1/S4_fixed") + " --law published --format json --svg " + svg.string());
  EXPECT_EQ(outcome.exit_status, 1);
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result["status"], "unsupported");
  EXPECT_TRUE(result["tip"].is_null());
  EXPECT_TRUE(result["centreline"].empty());
  EXPECT_FALSE(fs::exists(svg));
}

TEST(Command, WrongInputIsExitStatusTwoOneLineNothingPrinted) {
  const std::string rod = R"({"rod":{"sections":[{"length_mm":-4,"stiffness":{"bending_Nmm2":1,"torsion_Nmm2":1}}]}})";
  for (const std::string& command : {fam, fam_studies}) {
    const fs::path svg = scratch() / "never.svg";
    const Outcome outcome = run(command, "solve - --format json --svg " + svg.string(), rod);
    EXPECT_EQ(outcome.exit_status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "(standard input): rod.sections[0].length_mm = -4: must be > 0\n");
    EXPECT_FALSE(fs::exists(svg));
    EXPECT_EQ(run(command, "solve no_such_file.json").exit_status, 2);
  }
}

TEST(Command, WrongUsageIsExitStatusTwo) {
  const std::string scene = case_file("study1/P1_follower");
  for (const std::string& arguments :
       {std::string(""), std::string("solve"), "solve " + scene + " --arcs 0", "solve " + scene + " --arcs 1000001",
        "solve " + scene + " --tolerance-mm 0", "solve " + scene + " --tolerance-mm nan",
        "solve " + scene + " --arcs 3 --tolerance-mm 1", "solve " + scene + " --law euler",
        "solve " + scene + " --model cosserat", "solve " + scene + " --format xml", "solve " + scene + " --colour"}) {
    const Outcome outcome = run(fam, arguments);
    EXPECT_EQ(outcome.exit_status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
  }
  EXPECT_EQ(run(fam, "--help").exit_status, 0);
}

TEST(Command, BothSolveWithTheSameOptions) {
  const std::string scene = case_file("study1/P1_fixed"), vtu = (scratch() / "both.vtu").string();
  for (const std::string& options :
       {std::string(" --after-snap"), std::string(" --format json --derivatives"), " --vtu " + vtu}) {
    const Outcome one = run(fam, "solve " + scene + options), other = run(fam_studies, "solve " + scene + options);
    EXPECT_EQ(one.exit_status, 0) << options;
    EXPECT_EQ(other.exit_status, 0) << options << other.err;
  }
  EXPECT_EQ(run(fam_studies, "solve " + scene + " --method exact --vtu " + vtu).exit_status, 0);
}

TEST(Command, WrongUsageNamesWhatIsWrong) {
  const std::string scene = case_file("study1/P1_follower");
  const auto refused = [](const std::string& command, const std::string& arguments) {
    const Outcome outcome = run(command, arguments);
    EXPECT_EQ(outcome.exit_status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    return outcome.err.substr(0, outcome.err.find('\n'));
  };
  EXPECT_EQ(refused(fam, "slove"), "The following argument was not expected: slove");
  EXPECT_EQ(refused(fam_studies, "random scenes"), "The following argument was not expected: scenes");
  EXPECT_NE(refused(fam_studies, "random scene 99999999999999999999"), "");
  EXPECT_EQ(refused(fam, ""), "A subcommand is required");
  EXPECT_EQ(refused(fam, "solve " + scene + " --twist-order twist_bend"), "--twist-order: needs --law published");
  EXPECT_EQ(refused(fam, "solve " + scene + " --svg \"\""), "--svg: must name a file");
  EXPECT_EQ(refused(fam, "solve " + scene + " --svg rod.xml --vtu rod.xml"), "--vtu: names the file of --svg");
  const std::string own = (scratch() / "own.json").string(), values = (scratch() / "own.csv").string();
  fs::copy_file(scene, own, fs::copy_options::overwrite_existing);
  std::ofstream(values) << "0.y\n0.1\n";
  const std::string again = (scratch() / "." / "own.json").string(), link = (scratch() / "link.json").string();
  fs::remove(link);
  fs::create_symlink(own, link);
  EXPECT_EQ(refused(fam, "solve " + own + " --vtu " + own), "--vtu: names the file of the scene");
  EXPECT_EQ(refused(fam, "solve " + own + " --svg " + again), "--svg: names the file of the scene");
  EXPECT_EQ(refused(fam, "solve " + link + " --svg " + own), "--svg: names the file of the scene");
  EXPECT_EQ(refused(fam, "path " + own + " --svg " + own), "--svg: names the file of the path file");
  EXPECT_EQ(refused(fam, "batch " + own + " --values " + values + " --output " + values),
            "--output: names the file of --values");
  fs::current_path(scratch());
  EXPECT_EQ(refused(fam, "batch " + own + " --values " + values + " --output rods.pvd --pvd ./rods.pvd"),
            "--pvd: names the file of --output");
  EXPECT_EQ(refused(fam_studies, "export " + own + " --format abaqus --output " + own),
            "--output: names the file of the scene");
  EXPECT_EQ(contents(own), contents(scene));
  const std::string long_name(300, 'a');  // of which the file system knows no place
  EXPECT_NE(refused(fam, "solve " + long_name + ".json --svg " + long_name + ".svg").find("must be a readable"),
            std::string::npos);
  EXPECT_EQ(run(fam, "solve " + own + " --svg /dev/null --vtu /dev/null").exit_status, 0);
  const std::string nowhere = (scratch() / "nowhere").string();
  EXPECT_EQ(refused(fam_studies, "random sum " + nowhere + " out"), nowhere + ": No such file or directory");
  for (const auto& [method, option] :
       {std::pair{"fem", "--arcs"}, {"exact", "--law"}, {"rk4", "--elements"}, {"fam", "--steps"}, {"fe", "--order"}}) {
    const std::string value = option == std::string("--law") ? " midpoint" : " 2";
    EXPECT_EQ(refused(fam_studies, "solve " + scene + " --method " + method + " " + option + value),
              std::string(option) + ": is no option of --method " + method);
  }
  EXPECT_EQ(run(fam, "solve " + scene + " --law published --twist-order twist_bend").exit_status, 0);
  EXPECT_EQ(run(fam_studies, "solve " + scene + " --method fam_midpoint --arcs 8").exit_status, 0);
}

TEST(Command, VersionIsTheProjects) {
  EXPECT_EQ(run(fam, "--version").out, "fam " FAM_VERSION "\n");
  EXPECT_EQ(run(fam_studies, "--version").out, "fam-studies " FAM_VERSION "\n");
  EXPECT_NE(std::string(FAM_VERSION), "");
}

// From a stability map to the failing cell: plain shooting on a branch that is far from the others' answer.
TEST(Command, ACellOfAStabilityMapIsSolvedAgain) {
  const Outcome cell = run(fam_studies, "cell direction 170 10");
  ASSERT_EQ(cell.exit_status, 0) << cell.err;
  std::map<std::string, json> tips;
  for (const std::string options : {"fam", "exact", "rk4 --steps 16"}) {
    const Outcome solved = run(fam_studies, "solve - --format json --method " + options, cell.out);
    ASSERT_EQ(solved.exit_status, 0) << solved.err;
    tips[options] = json::parse(solved.out)["tip"]["position_mm"];
  }
  EXPECT_NEAR(tips["fam"][0].get<double>(), tips["exact"][0].get<double>(), 0.1);
  EXPECT_GT(std::abs(tips["rk4 --steps 16"][0].get<double>() - tips["exact"][0].get<double>()), 10);
  const Outcome unknown = run(fam_studies, "cell nowhere 1");
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_EQ(unknown.err, "no stability map is called \"nowhere\"\n");
  EXPECT_EQ(run(fam_studies, "cell follower nan").exit_status, 2);
}

TEST(Command, UnwritablePictureIsExitStatusOne) {
  const Outcome outcome = run(fam, "solve " + case_file("study1/P1_follower") + " --svg /dev/null/shape.svg");
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("cannot be written"), std::string::npos);
}

}  // namespace
