// A time in the CSV files: median, quartiles where the repeats tell them, repeats.
#pragma once

#include "studies/compare/stopwatch.h"

#include <string>
#include <vector>

namespace studies {

inline std::vector<std::string> with_timing_columns(std::vector<std::string> columns) {
  columns.insert(columns.end(), {"median_us", "lower_quartile_us", "upper_quartile_us", "repeats"});
  return columns;
}

// number: fixed or significant of report/table.h, with so many digits.
inline std::vector<std::string> with_timing(std::vector<std::string> cells, const Timing& timing,
                                            std::string (*number)(double, int), int digits) {
  const auto quartile = [&](double us) { return timing.has_spread() ? number(us, digits) : std::string(); };
  cells.insert(cells.end(), {number(timing.median_us, digits), quartile(timing.lower_quartile_us),
                             quartile(timing.upper_quartile_us), std::to_string(timing.repeats)});
  return cells;
}

}  // namespace studies
