// What a solved beam hands out: stations along the rod with the rod's own force and moment, and its tendons'
// shortening.
#pragma once

#include "fem_reference/beam_model.h"
#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace fem_reference {

// A solved beam. cells[i] elements of equal length on span i, as in beam_model().
struct SolvedBeam {
  std::vector<scene::Span> spans;
  std::vector<int> cells;
  BeamModel model;
  BeamState state;  // an equilibrium under the full load
};

// Clamp to tip: all nodes, the ends of spans exactly, and s = k L/40, k = 0..40. Between nodes the pose is that of the
// shape functions: there its error falls as h^(order + 1), slower than at the elements' ends.
//
// Total force and moment: at an element's ends those that balance the loads beyond as the nodes do, to Newton's
// tolerance; within it they follow from those at its end by equilibrium of the part between. The rod's own are the
// total less the tendons' pulls at the strains which they cause together. Empty if these strains are not found.
std::optional<std::vector<scene::Station>> stations(const SolvedBeam& beam);

// Position by the shape functions, mm, base frame.
Eigen::Vector3d position_B_mm(const SolvedBeam& beam, double s_mm);

// For each of the scene's tendons in their order: int |e_x + u0 x r| ds - int |v + u x r| ds over 0..to_mm, by the
// elements' Gauss points.
std::vector<double> tendon_shortening_mm(const SolvedBeam& beam, const std::vector<scene::Load>& loads);

}  // namespace fem_reference
