// A picture of where the tips are.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace studies {

// Tips in mm, base frame; drawn in the views in which they do not lie on a line. all: points of the sweep, failed ones
// included. Of more than most_dots every n-th.
std::string workspace_svg(const std::vector<Eigen::Vector3d>& tips_B_mm, double length_mm, std::uint64_t all);

constexpr std::size_t most_dots = 5000;

}  // namespace studies
