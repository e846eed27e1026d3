// CSV files that a user wrote. Blank lines, blanks and quotes around a cell, a byte order mark and carriage returns do
// not matter.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace studies {

// All of a file, or of standard input where path is "-". Throws scene::SceneError: it must be a readable file of
// `what`.
std::string text_of_file(const std::string& path, const std::string& what);

struct CsvLine {
  std::size_t number;  // from 1
  std::vector<std::string_view> cells;
};

// Hands over the lines that are not blank, one by one; the cells view into the text.
void each_csv_line(std::string_view text, const std::function<void(const CsvLine&)>& take);

struct CsvNumber {
  double value;
  const char* broken_rule;  // null: a finite number
};
CsvNumber number_of(std::string_view cell);

// Throws scene::SceneError: "<source>: <place> = <value>: <rule>", the value as one line of printable ASCII, cut where
// it is long.
[[noreturn]] void refuse(const std::string& source, const std::string& place, std::string_view value,
                         const std::string& rule);

}  // namespace studies
