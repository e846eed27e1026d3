// The pictures of Study I (SVG text).
#pragma once

#include "studies/study1/data.h"

namespace studies {

std::string shapes_picture(const Study1Data& data, bool planar);  // FAM lines, FE dots
std::string errors_picture(const Study1Data& data);               // distance of the tips of several pairs
std::string split_picture(const Study1Data& data);                // FAM - FE in its three parts

}  // namespace studies
