// Tables, pictures, error measures, files.
#include "studies/compare/error_measures.h"
#include "studies/compare/stopwatch.h"
#include "studies/report/chart.h"
#include "studies/report/output_file.h"
#include "studies/report/table.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>

namespace {

using namespace studies;

TEST(Table, CsvAndMarkdown) {
  Table table({"a", "b"});
  table.add({"x", "1"});
  EXPECT_EQ(table.csv({"head"}), "# head\na,b\nx,1\n");
  EXPECT_EQ(table.markdown(), "| a | b |\n|---|---:|\n| x | 1 |\n");
}

TEST(Table, Numbers) {
  EXPECT_EQ(fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed(-0.0006, 3), "-0.001");
  EXPECT_EQ(fixed(2.5, 1), "2.5");
  EXPECT_EQ(scientific(1.234e-7, 1), "1.2e-07");
  EXPECT_EQ(scientific(0, 1), "0");
}

// By hand: e = 1, -2, 4: mean 1, SD sqrt(18/2) = 3, MAE 7/3, SD of 1, 2, 4 sqrt(7/3), RMS sqrt(7).
TEST(ErrorMeasures, Statistics) {
  const Statistics s = statistics({1, -2, 4});
  EXPECT_DOUBLE_EQ(s.mean, 1);
  EXPECT_DOUBLE_EQ(s.standard_deviation, 3);
  EXPECT_DOUBLE_EQ(s.mean_absolute, 7 / 3.);
  EXPECT_DOUBLE_EQ(s.absolute_deviation, std::sqrt(7 / 3.));
  EXPECT_DOUBLE_EQ(s.root_mean_square, std::sqrt(7));
}

scene::Equilibrium circle(double radius_mm, double length_mm, int intervals) {
  scene::Equilibrium result;
  for (int i = 0; i <= intervals; ++i) {
    const double s = length_mm * i / intervals;
    const double angle = s / radius_mm;
    scene::Station station{s, {}};
    station.X_BS.rotation_BS = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    station.X_BS.position_B_mm = radius_mm * Eigen::Vector3d(std::sin(angle), 1 - std::cos(angle), 0);
    result.stations.push_back(station);
  }
  return result;
}

// Hermite interpolation of a circle: h^4/384 / R^3 off, here 1/384 * 50 / 50^4 * ... below 1e-7 mm.
TEST(ErrorMeasures, PositionBetweenStations) {
  const scene::Equilibrium coarse = circle(50, 40, 40);
  const Eigen::Vector3d exact = 50 * Eigen::Vector3d(std::sin(0.25), 1 - std::cos(0.25), 0);
  EXPECT_LT((position_at_mm(coarse, 12.5) - exact).norm(), 1e-7);
  EXPECT_LT((position_at_mm(coarse, 12) - 50 * Eigen::Vector3d(std::sin(0.24), 1 - std::cos(0.24), 0)).norm(), 1e-14);
  EXPECT_LT(shape_difference(coarse, circle(50, 40, 7)).largest_mm, 1e-4);
  EXPECT_GT(shape_difference(coarse, circle(52.5, 40, 40)).largest_mm, 0.1);
}

TEST(Chart, Ticks) {
  EXPECT_EQ(ticks({"", 0, 10, false}), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks({"", -0.06, 0.11, false}).size(), 9u);  // -0.06, -0.04, ..., 0.1
  EXPECT_EQ(ticks({"", 1e-2, 1e2, true}).size(), 5u);
}

TEST(Chart, EqualScale) {
  Axis x{"", 0, 10, false}, y{"", 0, 1, false};
  equal_scale(x, y, 200, 100);
  EXPECT_DOUBLE_EQ((x.high - x.low) / 200, (y.high - y.low) / 100);
  EXPECT_LE(x.low, 0);
  EXPECT_GE(x.high, 10);
}

TEST(Svg, IsDeterministicAndEscapes) {
  Svg svg(10, 10, "title", "description");
  svg.text({1, -0.001}, "a < b & c");
  svg.cross({5, 5}, 2, {});
  EXPECT_NE(svg.str().find("y=\"0.00\""), std::string::npos);
  EXPECT_NE(svg.str().find("a &lt; b &amp; c"), std::string::npos);
  // XML 1.0, 2.2: no character below U+0020 but tab, line feed and carriage return, and neither U+FFFE nor U+FFFF.
  svg.text({1, 1}, std::string("a\x01") + "b\tc\x1b\xEF\xBF\xBF d\xEF\xBC\x81");
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_NE(svg.str().find("a" + unknown + "b\tc" + unknown + unknown + " d\xEF\xBC\x81"), std::string::npos);
}

TEST(OutputFile, WritesWholeOrNotAtAll) {
  const auto folder = std::filesystem::temp_directory_path() / ("fam_output_test_" + std::to_string(getpid()));
  write_file(folder / "deep" / "file.txt", "text\n");
  std::ifstream file(folder / "deep" / "file.txt");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "text\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "deep"), {}), 1);  // no partial file left
  EXPECT_THROW(write_file(folder / "deep" / "file.txt" / "below_a_file", "x"), OutputError);
  std::filesystem::remove_all(folder);
}

// One of the files cannot be written: the others stay as they were, and nothing is left beside them.
TEST(OutputFile, WritesAllFilesOrNone) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "fam_files_test";
  std::filesystem::remove_all(folder);
  write_files(folder, {{"a", "before"}});
  std::filesystem::create_directories(folder / "b");
  EXPECT_THROW(write_files(folder, {{"a", "after"}, {"b", "text"}}), OutputError);
  std::string text;
  std::ifstream(folder / "a") >> text;
  EXPECT_EQ(text, "before");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.partial"));
  std::filesystem::remove(folder / "b");
  write_files(folder, {{"a", "after"}, {"b", "text"}});
  std::ifstream(folder / "a") >> text;
  EXPECT_EQ(text, "after");
  EXPECT_TRUE(std::filesystem::exists(folder / "b"));
  std::filesystem::remove_all(folder);
}

TEST(Stopwatch, MeasuresSleeplessWork) {
  volatile double sink = 0;
  const Timing timing = measure(
      [&] {
        for (int i = 0; i < 1000; ++i) sink = sink + i;
      },
      0.001);
  EXPECT_GT(timing.median_us, 0);
  EXPECT_LE(timing.lower_quartile_us, timing.median_us);
  EXPECT_LE(timing.median_us, timing.upper_quartile_us);
  EXPECT_GE(timing.repeats, 3);
}

}  // namespace
