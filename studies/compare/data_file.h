// CSV files of published and computed numbers (tests/data): comment lines start with #, then a head, then rows.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

// A number as it is printed: 0.05643 has 5 decimals, 1.2e-03 has 4.
struct Printed {
  double value = 0;
  int decimals = 0;
};

Printed printed(const std::string& text);  // throws scene::SceneError

// The same print in a unit that is 10^power times smaller; factor: +1 or -1.
Printed shifted(const Printed& number, int power, int factor = 1);

// Column name to cell.
using DataRow = std::map<std::string, std::string>;

// Throws scene::SceneError naming the file if it cannot be read. Only the last column may hold commas.
std::vector<DataRow> data_rows(const std::filesystem::path& file);

}  // namespace studies
