// What can be read off a scene's spans before it is solved.
#pragma once

#include "scene/span.h"

#include <optional>
#include <span>

namespace scene {

// The march from the tip suffices: all loads, distributed ones included, are in the section frame.
bool all_loads_follow(std::span<const Span> spans);

// All loads are moments about axes fixed in space, without tendons: no section bears a force, and its moment is known
// in the base's axes before the shape is. So the rod has one equilibrium, which a march from the clamp leads to.
bool moments_are_known(std::span<const Span> spans);

// The plane through the undeformed axis in which all loads, rest curvatures and tendons lie: the unit vector (y, z)
// that spans it with the x axis; (1, 0) where they ask for none. Any plane if all sections have EI_y = EI_z and equal
// shear stiffnesses, else the x-y or the x-z plane. Tendons lie in a plane if it mirrors them onto each other.
std::optional<Eigen::Vector2d> plane_direction(std::span<const Span> spans);

// Nothing of a planar rod lies off the axis: any plane does.
bool needs_no_plane(std::span<const Span> spans);

// The unit normal of that plane, about which such a rod turns.
std::optional<Eigen::Vector3d> plane_normal(std::span<const Span> spans);

// All sections are the same about y and z.
bool is_isotropic(std::span<const Span> spans);

// Nothing tells one direction in a section from another: sections the same about y and z and without rest curvature,
// and neither tendons, lever arms nor transversal follower loads. The centreline then does not depend on GJ: the moment
// about the tangent is constant between point moments, and only turns the section about it.
bool is_round(std::span<const Span> spans);

// What leaves the scene as it is: half a turn about the axis (nothing but tension, torque and twist along it), or else
// the mirror of a plane that all bending lies in. A rod can stay on an unstable branch only as far as its symmetry
// holds it there: on the axis, or in the plane as long as it would leave it sideways.
enum class Symmetry { none, plane_xy, plane_xz, axis };
Symmetry symmetry_of(std::span<const Span> spans);
// What leaves both as they are.
Symmetry common_symmetry(Symmetry a, Symmetry b);

// The loads have an energy: fixed forces, gravity and tendons alone. Loads that cancel at a place do not count.
bool is_conservative(std::span<const Span> spans);

}  // namespace scene
