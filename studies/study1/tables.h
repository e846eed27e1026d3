// The tables of Study I: CSV files, and Markdown for its page.
#pragma once

#include "studies/study1/data.h"

#include <map>

namespace studies {

// File name to content: tips, differences, summary, shapes, timing.
std::map<std::string, std::string> study1_csv(const Study1Data& data);

// Follower loads: tip of FAM with 12 published arcs, tip of FE, their difference, in the form of the paper's Tables 1
// and 2; and the statistics of the differences beside the printed ones.
std::string comparison_table(const Study1Data& data, bool planar);
std::string summary_table(const Study1Data& data, bool planar);
// Follower loads: distances of pairs that differ in law, number of arcs or rod model.
std::string separation_table(const Study1Data& data);
// FAM - FE = (FAM - exact Kirchhoff) + (exact Kirchhoff - exact Reissner) + (exact Reissner - FE), as vectors.
std::string split_table(const Study1Data& data);
std::string rotation_order_table(const Study1Data& data);
std::string fixed_table(const Study1Data& data);

// Mean of |a - b| over the cases and axes of a set, follower loads, mm.
double mean_absolute(const Study1Data& data, bool planar, const std::string& a, const std::string& b);

}  // namespace studies
