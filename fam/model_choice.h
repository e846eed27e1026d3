// The smallest model that does: plane or space, shear or none, law, and the arcs to start with.
#pragma once

#include "fam/arc_law.h"

#include "scene/span.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fam {

// A scene whose loads, rest curvatures and tendons all lie in one plane through the undeformed axis: its spans turned
// about the axis into the x-y plane, and the rotation back, from the turned frame P to the base frame. Any plane if all
// sections have EI_y = EI_z and equal shear stiffnesses, else the x-y or the x-z plane.
struct PlanarScene {
  std::vector<scene::Span> spans;
  Matrix3d rotation_BP = Matrix3d::Identity();
};
std::optional<PlanarScene> in_one_plane(std::span<const scene::Span> spans);

// Which rod: `wanted` if it is not automatic. The Kirchhoff rod is chosen where the sections neither shear nor stretch,
// or where both together move the tip by less than a tenth of the tolerance; left_out_mm bounds what was left out.
struct RodChoice {
  RodModel model;
  double left_out_mm = 0;
  std::string reason;
};
RodChoice choose_rod(std::span<const scene::Span> spans, RodModel wanted, double tolerance_mm);

// Arcs of each span to start with: one where the strain is constant, else as many as it takes that no arc sees more
// than a growth of 1.5: sqrt(force / EI) h and, in space, moment_growth_per_Nmm2 times the moment and h.
std::vector<int> first_arcs(std::span<const scene::Span> spans, bool planar);

// The largest growth sqrt(force / EI) h that an arc sees, EI the least stiffness of its span.
double largest_growth(std::span<const scene::Span> spans, std::span<const int> arcs_per_span);

}  // namespace fam
