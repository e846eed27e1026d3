// The committed results: what a study writes now is what stands in results/, but for the last printed digit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

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

struct Token {
  std::string text;  // a number, or one character
  bool is_number;
};

std::vector<Token> tokens(const std::string& text) {
  std::vector<Token> list;
  for (const char* at = text.c_str(); *at != 0;) {
    char* end = nullptr;
    const bool sign = *at == '-' && std::isdigit(static_cast<unsigned char>(at[1]));
    if (sign || std::isdigit(static_cast<unsigned char>(*at))) std::strtod(at, &end);
    const bool is_number = end != nullptr && at[1] != 'x';
    if (!is_number) end = const_cast<char*>(at) + 1;
    list.push_back({std::string(at, static_cast<const char*>(end)), is_number});
    at = end;
  }
  return list;
}

// Where two texts differ by more than one unit in the last place of a number (numbers below 1e-9 are round-off and
// all the same), as that place in both; empty where they do not.
std::string first_difference(const std::string& a, const std::string& b) {
  const std::vector<Token> in_a = tokens(a), in_b = tokens(b);
  for (std::size_t i = 0; i < std::min(in_a.size(), in_b.size()); ++i) {
    const std::string &of_a = in_a[i].text, &of_b = in_b[i].text;
    if (of_a == of_b) continue;
    const bool numbers = in_a[i].is_number && in_b[i].is_number;
    const double allowed = 1.01 * std::max({last_place(of_a), last_place(of_b), 1e-9});
    if (numbers && std::abs(std::stod(of_a) - std::stod(of_b)) <= allowed) continue;
    std::string place;
    for (std::size_t k = i > 60 ? i - 60 : 0; k < i; ++k) place += in_a[k].text;
    return place.append(" >>> ").append(of_a).append(" | ").append(of_b);
  }
  return in_a.size() == in_b.size() ? "" : "one of the two is longer";
}

TEST(Results, ComparisonSeesAChangedDigit) {
  EXPECT_EQ(first_difference("a,1.234,2e-3", "a,1.235,2e-3"), "");
  EXPECT_NE(first_difference("a,1.234", "a,1.236"), "");
  EXPECT_NE(first_difference("a,1.234", "b,1.234"), "");
  EXPECT_NE(first_difference("a,1.234", "a,1.234,1"), "");
  EXPECT_NE(first_difference("2.3e-03", "2.5e-03"), "");
  EXPECT_EQ(first_difference("5.9e-14", "3.0e-13"), "");
}

// Without what was timed, which pages mark (studies/report/page.h).
std::string untimed(const std::string& text) {
  const std::string open = "<!--t-->", close = "<!--/t-->";
  std::string rest;
  std::size_t at = 0;
  for (std::size_t from; (from = text.find(open, at)) != std::string::npos;) {
    rest += text.substr(at, from - at);
    const std::size_t end = text.find(close, from);
    if (end == std::string::npos) return rest + "a mark without its end";
    at = end + close.size();
  }
  return rest + text.substr(at);
}

TEST(Results, TimesAreNotCompared) {
  EXPECT_EQ(untimed("a <!--t-->1.2 µs<!--/t--> b"), "a  b");
  EXPECT_NE(untimed("a 1 <!--t-->2<!--/t-->"), untimed("a 3 <!--t-->2<!--/t-->"));
}

bool is_accuracy_file(const fs::path& path) {
  const std::string name = path.filename().string();
  return name != "provenance.json" && name.rfind("timing", 0) != 0;
}

// Of the study that the environment names.
TEST(Results, AreWhatTheStudyWrites) {
  const char* given = std::getenv("RESULTS_STUDY");
  ASSERT_TRUE(given);
  const std::string study = given;
  std::string as_command = study;
  std::replace(as_command.begin(), as_command.end(), '_', '-');
  const fs::path folder = fs::temp_directory_path() / ("fam_results_test_" + std::to_string(getpid()));
  const std::string command =
      FAM_STUDIES_COMMAND " " + as_command + " --quick --quiet --output " + folder.string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(RESULTS_DIR) / study)) {
    if (entry.is_directory() || !is_accuracy_file(entry.path())) continue;
    const fs::path again = folder / study / entry.path().filename();
    EXPECT_EQ(first_difference(untimed(contents(entry.path())), untimed(contents(again))), "") << entry.path();
    ++compared;
  }
  EXPECT_GE(compared, 3);
  fs::remove_all(folder);
}

}  // namespace
