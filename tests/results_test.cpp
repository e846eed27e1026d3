// The committed results: what a study writes now is what stands in results/, but for the last printed digit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// One unit of the last printed digit of a number: 0.01 for "3.14", 1e-9 for "2.3e-08".
double last_place(const std::string& number) {
  const std::size_t exponent = number.find_first_of("eE");
  const std::string mantissa = number.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point) - 1;
  const int power = exponent == std::string::npos ? 0 : std::atoi(number.c_str() + exponent + 1);
  return std::pow(10, power - decimals);
}

// Where two texts differ by more than one unit in the last place of a number (numbers below 1e-9 are round-off and
// all the same), as a line of both; empty where they do not.
std::string first_difference(const std::string& a, const std::string& b) {
  static const std::regex number(R"(-?\d+(\.\d+)?([eE][-+]?\d+)?)");
  std::sregex_iterator in_a(a.begin(), a.end(), number), in_b(b.begin(), b.end(), number);
  const std::sregex_iterator end;
  for (; in_a != end && in_b != end; ++in_a, ++in_b) {
    const std::string text_a = in_a->str(), text_b = in_b->str();
    if (in_a->prefix() != in_b->prefix()) return in_a->prefix().str().append(" | ").append(in_b->prefix().str());
    const double value_a = std::stod(text_a), value_b = std::stod(text_b);
    const double allowed = 1.01 * std::max({last_place(text_a), last_place(text_b), 1e-9});
    if (std::abs(value_a - value_b) > allowed) return text_a + " | " + text_b + " after " + in_a->prefix().str();
  }
  return in_a == end && in_b == end ? "" : "one of the two is longer";
}

TEST(Results, ComparisonSeesAChangedDigit) {
  EXPECT_EQ(first_difference("a,1.234,2e-3", "a,1.235,2e-3"), "");
  EXPECT_NE(first_difference("a,1.234", "a,1.236"), "");
  EXPECT_NE(first_difference("a,1.234", "b,1.234"), "");
  EXPECT_NE(first_difference("a,1.234", "a,1.234,1"), "");
  EXPECT_NE(first_difference("2.3e-03", "2.5e-03"), "");
  EXPECT_EQ(first_difference("5.9e-14", "3.0e-13"), "");
}

bool is_accuracy_file(const fs::path& path) {
  const std::string name = path.filename().string();
  return name != "provenance.json" && name.rfind("timing", 0) != 0;
}

TEST(Results, AreWhatTheStudiesWrite) {
  const fs::path folder = fs::temp_directory_path() / ("fam_results_test_" + std::to_string(getpid()));
  const std::string command =
      std::string(FAM_STUDIES_COMMAND) + " " RESULTS_STUDY " --quick --output " + folder.string() + " 2>/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(RESULTS_DIR) / RESULTS_STUDY)) {
    if (!is_accuracy_file(entry.path())) continue;
    const fs::path again = folder / RESULTS_STUDY / entry.path().filename();
    EXPECT_EQ(first_difference(contents(entry.path()), contents(again)), "") << entry.path();
    ++compared;
  }
  EXPECT_GE(compared, 3);
  fs::remove_all(folder);
}

}  // namespace
