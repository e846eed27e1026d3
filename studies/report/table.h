// A table of text cells, as CSV (the result) and as Markdown (for the reader).
#pragma once

#include <string>
#include <vector>

namespace studies {

class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  // One cell a column.
  void add(std::vector<std::string> cells);

  // Head lines start with "# ".
  std::string csv(const std::vector<std::string>& head = {}) const;
  std::string markdown() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

// Numbers as text. Fixed digits hide the last bits, which differ from machine to machine; never "-0.000".
std::string fixed(double value, int digits);
std::string scientific(double value, int digits);   // "1.2e-07"; "0" for zero
std::string significant(double value, int digits);  // 3 digits: "0.214", "12.3", "1240"; "–" where it is not finite
std::string time_text(double time_us);              // three digits in the unit that suits: "0.214 µs", "37.1 ms"

// Numbers as pages write them: a true minus sign, no zeros in front of an exponent. Markdown tables are written so.
std::string for_reader(const std::string& text);

// Errors below 1e-12 L of a rod of 40 mm are round-off of the references and of the march; files and pictures show this
// value for them.
constexpr double error_floor_mm = 4e-11;

std::string error_text(double error_mm, int digits = 2);  // scientific, not below the floor
std::string error_for_reader(double error_mm);  // two digits: "2.4", "0.033", "2.3e-7"; "–" where not finite

// Observed order between two numbers of arcs; "–" where an error is too near round-off to tell.
std::string observed_order(int coarse_arcs, double coarse_mm, int fine_arcs, double fine_mm);

}  // namespace studies
