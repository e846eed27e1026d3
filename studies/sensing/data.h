// What study `sensing` publishes beside its trials.
#pragma once

#include "studies/report/table.h"

#include <filesystem>
#include <map>
#include <string>

namespace studies {

// The synthetic set: name in the study's folder to content.
std::map<std::string, std::string> sensing_data(const std::filesystem::path& cases);

// Of a force by direction and place: its predicted deviation along itself over its size, from the tip's position.
Table observability_table(int digits);

}  // namespace studies
