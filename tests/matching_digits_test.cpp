// The measure of the benchmarks: digits of a printed value that a computed one matches.
#include "studies/compare/matching_digits.h"

#include "exact_reference/solve.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace studies;

double digits(double value, const std::string& text) {
  const Printed p = printed(text);
  return matching_digits({value}, {p}, std::abs(p.value));
}

TEST(MatchingDigits, PrintedNumbers) {
  EXPECT_EQ(printed("0.05643").decimals, 5);
  EXPECT_EQ(printed("-12").decimals, 0);
  EXPECT_EQ(printed("1.25e-03").decimals, 5);
  EXPECT_DOUBLE_EQ(printed("1.25e-03").value, 1.25e-3);
  EXPECT_EQ(shifted(printed("0.508"), 3).decimals, 0);
  EXPECT_DOUBLE_EQ(shifted(printed("0.508"), 3, -1).value, -508);
}

TEST(MatchingDigits, CarriedCountsFromTheLeadingPlace) {
  EXPECT_EQ(carried_digits({printed("0.05643")}, 0.05643), 4);
  EXPECT_EQ(carried_digits({printed("12.000"), printed("0.000")}, 12), 5);
  EXPECT_EQ(carried_digits({printed("32.144")}, 100), 6);
}

TEST(MatchingDigits, AValueThatRoundsToThePrintMatchesAllOfIt) {
  EXPECT_EQ(digits(0.301724, "0.30172"), 5);
  EXPECT_LT(digits(0.301726, "0.30172"), 5);
  EXPECT_NEAR(digits(1.01, "1.00000"), 2, 1e-12);
  EXPECT_NEAR(digits(1.0001, "1.00000"), 4, 1e-9);
  EXPECT_EQ(digits(-5, "1.00000"), 0);
  EXPECT_EQ(digits(1 + 1e-12, "1.000"), 4);  // never more than is printed
}

TEST(MatchingDigits, OfAVectorByItsNorm) {  // error 3e-3, 4e-3 of a vector of length 1
  EXPECT_NEAR(matching_digits({0.603, 0.804}, {printed("0.6000"), printed("0.8000")}, 1), -std::log10(5e-3), 1e-12);
}

TEST(MatchingDigits, NoMoreThanTheSourceIsWorth) {  // read off a curve whose axis is 100 long
  EXPECT_EQ(matching_digits({32.2}, {printed("32.144")}, 100, 2), 2);
  EXPECT_NEAR(matching_digits({42.144}, {printed("32.144")}, 100, 2), 1, 1e-12);
}

// Mattiasson 1981 at F L^2/EI = 5; the twin is a rod that is 5 % stiffer.
TEST(MatchingDigits, AStifferRodLosesDigits) {
  const auto digits_with = [](double bending_Nmm2) {
    scene::Section section;
    section.length_mm = 1;
    section.cross_section = scene::Stiffness{1, Eigen::Vector2d::Constant(bending_Nmm2), {}, {}, 0};
    const scene::Scene scene{"", {section}, {scene::Force{1, scene::Frame::fixed, {0, 5, 0}}}};
    const Eigen::Vector3d tip = exact_reference::solve(scene).tip().position_B_mm;
    const std::vector<Printed> published = {printed("0.38763"), printed("0.71379")};
    return matching_digits({1 - tip.x(), tip.y()}, published, norm(published));
  };
  EXPECT_EQ(digits_with(1), 5);
  EXPECT_LT(digits_with(1.05), 2);
}

TEST(DataFile, LastColumnMayHoldCommas) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("fam_data_" + std::to_string(getpid()) + ".csv");
  std::ofstream(file) << "# comment\na,b,note\n1,,x (2,3)\n4,5,\n";
  const std::vector<DataRow> rows = data_rows(file);
  std::filesystem::remove(file);
  ASSERT_EQ(rows.size(), 2);
  EXPECT_EQ(rows[0].at("note"), "x (2,3)");
  EXPECT_EQ(rows[0].at("b"), "");
  EXPECT_EQ(rows[1].at("b"), "5");
  EXPECT_THROW(data_rows(file), std::runtime_error);
}

}  // namespace
