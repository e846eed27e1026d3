// Colours and strokes of the pictures. A method's own style stands in its row of methods/registry.cpp.
#pragma once

#include <string>

namespace studies {

// Colours that differ in lightness too, so that they can be told apart in grey (after Okabe and Ito 2008).
namespace colour {
inline const std::string black = "#1a1a1a", blue = "#0072b2", orange = "#d55e00", sky = "#56b4e9", green = "#009e73",
                         purple = "#9a3d7a", yellow = "#c79a00", grey = "#8a8a8a", faint = "#e4e4e4", band = "#f0f0f0";
}

struct Style {
  std::string colour = colour::black;
  std::string dash;  // SVG dash array; empty: a full line
};

}  // namespace studies
