#include "studies/third_party/end_piece.h"

#include <fmt/format.h>

#include <numbers>

namespace studies {

namespace {

// P3 with 20 elements ends as far from the exact tip, to 2e-5 L, with pieces of 1 to 4 diameters and 1000 to 10 000
// times the rod's modulus; with 30 times it bends visibly, with 8 mm of 10 000 times CalculiX does not end.
constexpr double piece_over_diameter = 2, piece_stiffness = 1000;

}  // namespace

std::string calculix_element(const scene::CircularSection& section) {
  return section.inner_diameter_mm > 0 ? "B32R" : "B32";
}

std::string calculix_profile(const scene::CircularSection& section) {
  const double outer_mm = section.outer_diameter_mm, inner_mm = section.inner_diameter_mm;
  if (inner_mm > 0) return fmt::format("PIPE\n{:.15g}, {:.15g}\n", outer_mm / 2, (outer_mm - inner_mm) / 2);
  return fmt::format("CIRC\n{0:.15g}, {0:.15g}\n", outer_mm);
}

EndPiece end_piece(const scene::CircularSection& section, double tip_mm, std::size_t tip_node, std::size_t next_element,
                   const Eigen::Vector3d& moment_Nmm) {
  EndPiece piece;
  const double length_mm = piece_over_diameter * section.outer_diameter_mm;
  piece.nodes_and_elements = "*NODE\n";
  for (std::size_t i = 1; i <= 4; ++i)
    piece.nodes_and_elements +=
        fmt::format("{}, {:.15g}, 0, 0\n", tip_node + i, tip_mm + length_mm * static_cast<double>(i) / 4);
  piece.materials = fmt::format("*MATERIAL, NAME=END\n*ELASTIC\n{:.15g}, {:.15g}\n",
                                piece_stiffness * section.youngs_modulus_MPa, section.poissons_ratio);
  std::size_t first = tip_node;
  for (const char* half : {"NEAR", "FAR"}) {
    piece.nodes_and_elements += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n{}, {}, {}, {}\n", calculix_element(section),
                                            half, next_element++, first, first + 1, first + 2);
    first += 2;
    piece.materials +=
        fmt::format("*BEAM SECTION, ELSET={}, MATERIAL=END, SECTION={}0, 0, -1\n", half, calculix_profile(section));
  }
  // The faces of a circle's solids are as wide as the square in it, those of a tube's as the square around it (measured
  // by how far they bend; the test of decks does so again).
  const bool tube = section.inner_diameter_mm > 0;
  const double width_mm = section.outer_diameter_mm / (tube ? 1 : std::numbers::sqrt2);
  piece.pressures = "** The moment at the tip: a couple of pressures, which follows the section\n*DLOAD\n";
  for (int axis = 1; axis <= 2; ++axis) {
    const double pressure_MPa = 4 * moment_Nmm[axis] / (length_mm * length_mm * width_mm);
    if (pressure_MPa == 0) continue;
    piece.pressures += fmt::format("NEAR, P{0}, {1:.15g}\nFAR, P{0}, {2:.15g}\n", axis, -pressure_MPa, pressure_MPa);
  }
  return piece;
}

}  // namespace studies
