// What study `sensing` publishes beside its trials.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace studies {

// The synthetic set: name in the study's folder to content.
std::map<std::string, std::string> sensing_data(const std::filesystem::path& cases);

}  // namespace studies
