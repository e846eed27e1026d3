// Position errors as text: in CSV files, for readers, and their orders.
#pragma once

#include <string>

namespace studies {

// Errors below 1e-12 L of a rod of 40 mm are round-off of the references and of the march; files and pictures show this
// value for them.
constexpr double error_floor_mm = 4e-11;

std::string error_text(double error_mm, int digits = 2);  // scientific, not below the floor
std::string error_for_reader(double error_mm);  // two digits: "2.4", "0.033", "2.3e-7"; "–" where not finite

// Observed order between two numbers of arcs; "–" where an error is too near round-off to tell.
std::string observed_order(int coarse_arcs, double coarse_mm, int fine_arcs, double fine_mm);

}  // namespace studies
