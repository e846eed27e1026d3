// The files of Study I, as functions of what was solved: tables.cpp, pictures.cpp, page.cpp.
#pragma once

#include "studies/study1/data.h"

#include <filesystem>
#include <map>

namespace studies {

// File name to content: page, tables, pictures, answers.
std::map<std::string, std::string> study1_files(const Study1Data& data, const std::filesystem::path& page_md);

// tips, differences, summary, printed, shapes, timing.
std::map<std::string, std::string> study1_csv(const Study1Data& data);

// Markdown. Follower loads unless they say otherwise.
std::string comparison_table(const Study1Data& data);  // case by case, in the form of the paper's Tables 1 and 2
std::string summary_table(const Study1Data& data);     // mean ± SD, MAE ± SD, RMS beside the printed ones
std::string printed_table();                           // what the printed statistics imply
std::string methods_table(const Study1Data& data);     // each method - FE
std::string split_table(const Study1Data& data);       // FAM - FE in its parts
std::string fixed_table(const Study1Data& data);       // fixed loads
std::string times_table(const Study1Data& data);       // marked

// SVG.
std::string shapes_picture(const Study1Data& data, bool planar);  // FAM lines, FE dots
std::string errors_picture(const Study1Data& data);               // tip distance from the exact rod, by method
std::string split_picture(const Study1Data& data);                // FAM - FE in its parts, case by case

}  // namespace studies
