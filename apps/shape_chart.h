// Deformed centrelines as a picture, in the base frame, with the same scale on both axes.
#pragma once

#include "scene/equilibrium.h"

#include <string>
#include <vector>

namespace apps {

// A centreline to draw; positions in mm, base frame, clamp to tip.
struct Centreline {
  std::string name;
  std::vector<Eigen::Vector3d> positions_B_mm;
  std::string colour;
  std::string dash;     // "" full line
  bool dotted = false;  // dots at the positions in place of a line
};

Centreline centreline(const scene::Equilibrium& result, const std::string& name, const std::string& colour);

// Axes to look along: {0, 1} is the x-y view.
struct View {
  int right, up;
};

// One panel a view, beside each other; a planar set needs one, larger.
std::string shape_chart(const std::vector<Centreline>& lines, const std::vector<View>& views, const std::string& title,
                        const std::string& subtitle = "");

}  // namespace apps
