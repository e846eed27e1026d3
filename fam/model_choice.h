// The cheapest model that does: plane or space, shear or none, law, march or boundary value, the arcs to start with.
#pragma once

#include "fam/options.h"
#include "fam/screw.h"

#include "scene/span.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fam {

// A scene that lies in one plane (scene::plane_direction): its spans turned about the axis into the x-y plane, and the
// rotation back, from the turned frame P to the base frame.
struct PlanarScene {
  std::vector<scene::Span> spans;
  Matrix3d rotation_BP = Matrix3d::Identity();
};
std::optional<PlanarScene> in_one_plane(std::span<const scene::Span> spans);

// A rod to which GJ does not matter (scene::is_round), with EI in its place: its moments then turn with nothing, so
// that fewer arcs do and a soft torsion costs none. What the section's frame turns more about the tangent, per length
// and moment, is twist_per_Nmm2 (of each span), 1/GJ - 1/EI.
struct RoundRod {
  std::vector<scene::Span> spans;
  std::vector<double> twist_per_Nmm2;
};
std::optional<RoundRod> without_torsion(std::span<const scene::Span> spans);

// Which rod: `wanted` if it is not automatic. The Kirchhoff rod is chosen where the sections neither shear nor stretch,
// or where both together move the tip by less than a tenth of the tolerance; left_out_mm bounds what was left out.
struct RodChoice {
  RodModel model = RodModel::automatic;
  double left_out_mm = 0;
  std::string reason;
};
RodChoice choose_rod(std::span<const scene::Span> spans, RodModel wanted, double tolerance_mm);

// Arcs of each span to start with: as many as it takes that no arc has a load length (load_length.h) beyond
// first_load_length, and that none turns farther by rest curvature, tendons and moments than first_turn_rad where a
// force acts. Chosen, not measured.
constexpr double first_load_length = 1.5;
constexpr double first_turn_rad = 2;
constexpr int most_first_arcs = 1000;  // of a span
std::vector<int> first_arcs(std::span<const scene::Span> spans, bool planar);

// All that is fixed once the options are read against the scene.
struct Choice {
  Law law = Law::automatic;  // chosen
  RodChoice rod = {};
  std::optional<PlanarScene> plane;
  std::optional<RoundRod> round;  // of rods in space
  bool march = false;             // all loads follow the rod; else a boundary value problem
  std::string reason;

  // The spans as they are solved, but for a plane's rotation.
  std::span<const scene::Span> solved_spans(std::span<const scene::Span> scene_spans) const {
    return round ? std::span<const scene::Span>(round->spans) : scene_spans;
  }
  // From the frame that the rod is solved in to the base frame.
  Matrix3d rotation_BP() const { return plane ? plane->rotation_BP : Matrix3d::Identity(); }
};
Choice choose(std::span<const scene::Span> spans, const Options& options, double tolerance_mm);

}  // namespace fam
