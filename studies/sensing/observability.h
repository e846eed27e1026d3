// Where a force can be known: its predicted deviation along itself over its size, from the tip's position alone, by its
// direction and place and by how much it bends the rod.
#pragma once

#include <map>
#include <string>

namespace studies {

// observability.csv and observability.svg.
std::map<std::string, std::string> observability_files();

}  // namespace studies
