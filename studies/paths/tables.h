// The tables and pictures of the study of paths.
#pragma once

#include "studies/paths/data.h"

namespace studies {

double time_per_point_us(const PathOutcome& outcome, PathMethods method);

// Of the page: numbers known otherwise; places on each diagram beside the exact ones; answers without a path; times.
std::string known_table(const PathsData& data);
std::string agreement_table(const PathsData& data);
std::string direct_table(const PathsData& data);
std::string times_table(const PathsData& data);

std::string critical_csv(const PathsData& data);
std::string stops_csv(const PathsData& data);
std::string paths_times_csv(const PathsData& data);
std::string curl_csv(const PathsData& data);
std::string curl_picture(const PathsData& data);

}  // namespace studies
