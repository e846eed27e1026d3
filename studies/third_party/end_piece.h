// A moment at the tip of a rod of CalculiX's beams.
//
// CalculiX makes of a moment at a node the mean rotation of the section's nodes about a fixed axis (its *MPC MEANROT):
// an arc sine, which ends at 90 degrees, and in space neither the moment that keeps its axis nor the one that follows
// the section. Instead a piece of the same section and of stiffer material goes on beyond the tip, and pressures press
// its near half and its far half in opposite directions: a couple without a force. Pressure follows the section, so in
// space the moment does; in a plane it keeps its axis.
#pragma once

#include "scene/section.h"

#include <string>

namespace studies {

struct EndPiece {
  std::string nodes_and_elements, materials, pressures;  // keyword lines; the last ones of a step
};

// `moment_Nmm` has no part about the rod's axis. `next_element` is free, and nodes are from tip_node + 1 on.
EndPiece end_piece(const scene::CircularSection& section, double tip_mm, std::size_t tip_node, std::size_t next_element,
                   const Eigen::Vector3d& moment_Nmm);

// SECTION=...: CalculiX's words for a circle or a tube.
std::string calculix_profile(const scene::CircularSection& section);
std::string calculix_element(const scene::CircularSection& section);

}  // namespace studies
