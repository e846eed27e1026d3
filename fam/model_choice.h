// The cheapest model that does: plane or space, shear or none, law, march or boundary value, the arcs to start with.
#pragma once

#include "fam/options.h"
#include "fam/screw.h"

#include "scene/scene.h"
#include "scene/span.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fam {

// Which rod: `wanted` if it is not automatic. The Kirchhoff rod is chosen where the sections neither shear nor stretch,
// or where both together move the tip by less than left_out_share of the tolerance; left_out_mm bounds what was left
// out, and is part of the error estimate.
constexpr double left_out_share = 0.25;
struct RodChoice {
  enum class Why { asked_for, does_not_give_way, does_not_matter, may_matter };
  RodModel model = RodModel::automatic;
  double left_out_mm = 0;
  Why why = Why::asked_for;
};
RodChoice choose_rod(std::span<const scene::Span> spans, RodModel wanted, double tolerance_mm);

// How a straight unloaded rod's tip gives way to a force by shear and stretch, over how it does by bending: of the
// largest number of the tip's compliance, what the Kirchhoff rod leaves out.
double compliance_left_out(const scene::Scene& scene);

// A bound on the strains |K_v^-1 n| of shear and stretch.
double linear_strain_bound(std::span<const scene::Span> spans);

// Arcs of each span to start with: as many as it takes that no arc has a load length (load_length.h) beyond
// first_load_length, and that none turns farther by rest curvature, tendons and moments than first_turn_rad where a
// force acts; `factor` times as many. Chosen, not measured.
constexpr double first_load_length = 1.5;
constexpr double first_turn_rad = 2;
constexpr int most_first_arcs = 1000;  // of a span
void set_first_arcs(std::span<const scene::Span> spans, bool planar, std::vector<int>& arcs, double factor = 1);
// The same in space for a rod that is hardly bent: all forces act across it (across_stiffness_Nmm2).
void set_first_arcs_hardly_bent(std::span<const scene::Span> spans, std::vector<int>& arcs);

// The factor for an error within the tolerance, before anything is solved: the error with the first arcs is taken as
// first_arcs_error of the length, and to fall with the law's order. Measured on 270 random scenes: with 0.01 nine in
// ten were within 1e-5 of their length.
constexpr double first_arcs_error = 0.3;
double arcs_factor(Law law, double tolerance_over_L);
// How far solved arcs may swing (load_length.h) for the tolerance.
double allowed_swing_rad(Law law, double tolerance_over_L);

// All that is fixed once the options are read against the loads, the largest on the way.
struct Choice {
  Law law = Law::automatic;  // chosen
  bool law_asked_for = false;
  RodChoice rod;
  // The plane that all lies in (scene::plane_direction): its direction (y, z), and the rotation from the frame P in
  // which the rod is solved, in the x-y plane, to the base frame.
  std::optional<Eigen::Vector2d> plane;
  Matrix3d rotation_BP = Matrix3d::Identity();
  // In space, a rod to which GJ does not matter (scene::is_round) is solved with EI in its place: its moments then turn
  // with nothing, so that fewer arcs do and a soft torsion costs none. What the section's frame turns more about the
  // tangent, per length and moment, is 1/GJ - 1/EI (twist_per_Nmm2).
  bool round = false;
  bool march = false;  // all loads follow the rod; else a boundary value problem
  // All spans are of constant strain (load_length.h): one arc each has no error. Laws that couple bending and twist
  // alone.
  bool constant_strains = false;
};
Choice choose(std::span<const scene::Span> spans, const Options& options, double tolerance_mm);
std::string reason(const Choice& choice);

// The spans of a planar scene turned about the axis into the x-y plane.
void turn_into_plane(std::span<const scene::Span> spans, const Choice& choice, scene::Reused<scene::Span>& turned);
// The spans of a round rod with EI for GJ.
void leave_out_torsion(std::span<const scene::Span> spans, scene::Reused<scene::Span>& without);
double twist_per_Nmm2(const scene::Span& span);

}  // namespace fam
