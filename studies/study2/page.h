// The files of Study II, as functions of what was solved: tables.cpp, pictures.cpp, page.cpp.
#pragma once

#include "studies/study2/data.h"

#include <filesystem>
#include <map>

namespace studies {

// File name to content: page, tables, pictures, answers.
std::map<std::string, std::string> study2_files(const Study2Data& data, const std::filesystem::path& page_md);

std::map<std::string, std::string> study2_csv(const Study2Data& data);  // shapes, errors, errors_along, timing

std::string errors_table(const Study2Data& data);  // Markdown: largest error of each method on each scene
std::string times_table(const Study2Data& data);   // Markdown, marked

std::string deflection_picture(const Study2Data& data);  // SVG
std::string errors_picture(const Study2Data& data);      // SVG: distance from the exact rod along the catheter

}  // namespace studies
