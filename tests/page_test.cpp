// The strict filler of pages, the answers, and what a long command says.
#include "studies/report/page.h"
#include "studies/report/output_file.h"
#include "studies/report/progress.h"
#include "studies/report/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace {

using namespace studies;

std::string error_of(const Page& page, const std::string& words) {
  try {
    page.fill_text(words, "page.md");
  } catch (const PageError& error) {
    return error.what();
  }
  return "";
}

TEST(Page, FillsNamesAndChecks) {
  Page page;
  page.set("n", "12");
  page.check("large", true);
  page.check("small", false);
  EXPECT_EQ(page.fill_text("{{n}} arcs{{?large}} are many{{:}} are few{{/}}{{?small}}, {{n}} too few{{/}}.", "page.md"),
            "12 arcs are many.");
}

TEST(Page, MarksWhatWasTimed) {
  Page page;
  page.set_time("t", "1.2 µs");
  page.set_time("table", "| a |\n");
  page.check_time("fast", true);
  EXPECT_EQ(page.fill_text("In {{t}}{{?fast}}, fast{{/}}\n{{table}}", "page.md"),
            "In <!--t-->1.2 µs<!--/t--><!--t-->, fast<!--/t-->\n<!--t-->\n| a |\n<!--/t-->\n");
}

TEST(Page, IsStrict) {
  Page page;
  page.set("known", "1");
  page.check("holds", true);
  const std::string both = "{{known}}{{?holds}}x{{/}}";
  EXPECT_EQ(error_of(page, both), "");
  EXPECT_EQ(error_of(page, "one\n" + both + "{{unknown}}"), "page.md:2: nobody set {{unknown}}");
  EXPECT_EQ(error_of(page, both + "{{?other}}x{{/}}"), "page.md:1: nobody set {{?other}}");
  EXPECT_EQ(error_of(page, "{{known}}"), "page.md: {{?holds}} is set but not used");
  EXPECT_EQ(error_of(page, "{{?holds}}x{{/}}"), "page.md: {{known}} is set but not used");
  EXPECT_EQ(error_of(page, "{{known}}{{?holds}}x"), "page.md:1: a check without its {{/}}");
  EXPECT_EQ(error_of(page, both + "{{/}}"), "page.md:1: {{/}} outside a check");
  EXPECT_EQ(error_of(page, both + "{{known"), "page.md:1: {{ without }}");
  EXPECT_EQ(error_of(page, "{{?holds}}{{?holds}}{{/}}{{known}}"), "page.md:1: a check within a check: {{?holds}}");
  EXPECT_THROW(page.set("known", "2"), PageError);
  EXPECT_THROW(page.fill("no such page.md"), PageError);
}

// A name in the words of the branch that is not shown counts as used.
TEST(Page, KnowsNamesOfHiddenWords) {
  Page page;
  page.set("n", "1");
  page.check("shown", false);
  EXPECT_EQ(page.fill_text("{{?shown}}{{n}}{{/}}", "page.md"), "");
}

TEST(Answers, RoundTrip) {
  const auto file = std::filesystem::path(testing::TempDir()) / "answers" / "answers.json";
  const Answers answers{{"how_many", "12 arcs: 0.1 mm; \"quoted\""}, {"speed", timed("0.2 µs")}};
  write_file(file, answers_json(answers));
  EXPECT_EQ(read_answers(file), answers);
  EXPECT_TRUE(read_answers(file.parent_path() / "none.json").empty());
}

TEST(Numbers, ForReaders) {
  EXPECT_EQ(for_reader("| -0.27 | 1.2e-07 | a-b | (-3) | 2e+04 | -1.5e-3 | 2.7e+00 |"),
            "| −0.27 | 1.2e-7 | a-b | (−3) | 2e4 | −1.5e-3 | 2.7 |");
  EXPECT_EQ(significant(0.21449, 3), "0.214");
  EXPECT_EQ(significant(12.345, 3), "12.3");
  EXPECT_EQ(significant(1244.4, 3), "1240");
  EXPECT_EQ(significant(0.09996, 3), "0.100");
  EXPECT_EQ(significant(-99.96, 3), "-100");
  EXPECT_EQ(significant(0, 3), "0");
  EXPECT_EQ(time_text(0.2), "0.200 µs");
  EXPECT_EQ(time_text(37'123), "37.1 ms");
  EXPECT_EQ(time_text(2.5e6), "2.50 s");
  EXPECT_EQ(time_text(NAN), "–");
}

TEST(Table, QuotesCommas) {
  Table table({"a, b", "c"});
  table.add({"1", "say \"x\""});
  EXPECT_EQ(table.csv(), "\"a, b\",c\n1,\"say \"\"x\"\"\"\n");
}

// What a progress of three steps writes to a file.
std::string written(Progress::Style style) {
  const std::string path = testing::TempDir() + "progress.txt";
  std::FILE* file = std::fopen(path.c_str(), "w");
  {
    Progress progress("study", 3, style, file);
    for (const char* what : {"one", "two", "three"}) progress.step(what);
  }
  std::fclose(file);
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Progress, LinesTerminalAndQuiet) {
  EXPECT_EQ(written(Progress::Style::lines), "study: 1 of 3: one\nstudy: 2 of 3: two\nstudy: 3 of 3: three\n");
  EXPECT_EQ(written(Progress::Style::quiet), "");
  const std::string terminal = written(Progress::Style::terminal);
  EXPECT_EQ(terminal.rfind("\r\033[Kstudy: 1 of 3: one (0:00)", 0), 0u) << terminal;
  EXPECT_NE(terminal.find("study: 2 of 3: two (0:00, 0:00 left)"), std::string::npos) << terminal;
  EXPECT_EQ(terminal.back(), '\n');
  EXPECT_EQ(clock_text(67), "1:07");
  EXPECT_EQ(clock_text(3723), "1:02:03");
}

}  // namespace
