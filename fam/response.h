// How a solved rod answers small changes of its loads and of its sections: derivatives of the discrete equations.
//
// Fields of small motions. A section turns by the small theta, moves by p, and its total wrench changes by (N, M), all
// in the base frame. Each arc's step, differentiated once (fam/arc_slopes.h), makes one end's motion from the other's;
// what is asked for puts a source into arcs (constants, distributed forces) or nodes (point loads). From the tip, which
// turns freely, to the clamp the wrench is carried as an affine function of the turn, (N, M) = S theta + w (invariant
// embedding: what grows towards the clamp meets no cancellation); back from the clamp, which is at rest, the turns and
// shifts follow. S is found once for a solution, each source takes one sweep of w, and the last sweeps are kept.
#pragma once

#include "fam/arc_slopes.h"

#include "scene/scene.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace fam {

// In space; of a coupled law.
class Response {
 public:
  // A solution, in the true frames of a scene and its spans. Views, which must last until the next solution.
  struct Solution {
    const scene::Scene* scene;
    std::span<const scene::Span> spans;
    std::span<const std::size_t> section_of_span;
    std::span<const int> arcs_per_span;
    std::span<const SectionPose> poses;                // of the arcs' ends, clamp to tip: one more than arcs
    std::span<const SectionWrench> distal_wrenches_S;  // total, at the arcs' distal ends, loads there included
    Law law;
    scene::RodModel model;
    // Of a rod that lies in a plane, from the frame in whose x-y plane it does.
    std::optional<Matrix3d> rotation_BP{};
  };
  // pose: position_B (mm) and small turn in the base frame; strain: u (1/mm), v, section frame; wrench: the rod's own
  // force and moment, base frame.
  enum class What { pose, strain, wrench };
  using Columns = Eigen::Matrix<double, 6, 3>;

  // Takes all memory: nothing below allocates for rods of at most so many arcs, spans and tendons.
  void reserve(std::size_t arcs, std::size_t spans, std::size_t tendons);
  // Costs nothing; the derivatives are made when the first is asked for.
  void set(const Solution& solution);

  // At s: by a small fixed wrench at the tip, by a load's value (a tendon: the first column), by a section's rest
  // curvature or its (GJ, EI_y, EI_z), by a point load's place (the first column; where rod or other loads change
  // there, as it moves towards the clamp). NaN where there is no such place, load or section.
  Eigen::Matrix<double, 6, 6> compliance(double s_mm, What what);
  Columns by_load(std::size_t load, double s_mm, What what);
  Columns by_rest_curvature(std::size_t section, double s_mm, What what);
  Columns by_stiffness(std::size_t section, double s_mm, What what);
  Columns by_place(std::size_t load, double s_mm, What what);

 private:
  // force, moment: at the end of a span; distributed, place: of a load; tension: of the
  // 3 i-th to 3 i + 2nd tendon among the loads; rest_curvature, stiffness: of a
  // section.
  enum class Kind { none, force, moment, distributed, tension, rest_curvature, stiffness, place };
  struct Source {
    Kind kind = Kind::none;
    std::size_t index = 0;
    bool operator==(const Source&) const = default;
  };
  static constexpr Source first_tensions{Kind::tension, 0};

  // Slopes and the solution of an arc, base frame. `slopes` of the turn, the way, and the gain (as in ArcVariation) by
  // the wrench and, with distributed forces, by the fixed force in the distal frame.
  struct Arc {
    Eigen::Matrix<double, 12, 9> slopes;
    bool has_fixed_along;  // the slopes by the fixed force along itself, which no turn asks for, are among them
    bool has_tensions;     // `tensions` are known: the slopes by the first three tendons'
    Eigen::Matrix<double, 12, 3> tensions;
    Vector3d force_N, moment_Nmm, proximal_force_N, way_mm;
    Matrix3d turn_by_turn, way_by_turn;  // the distal turn by the proximal one; the way by the distal turn
    Columns stiffness, onwards;          // S at the distal end, loads included, and at the proximal one
  };
  struct Node {      // at an arc's distal end, on the loads' side towards the clamp
    Columns wrench;  // w
    Matrix3d turn, shift_mm;
  };
  struct Sweep {
    Source source;
    std::size_t jump_span = 0;  // at whose end these jump:
    Columns wrench_jump;
    Matrix3d turn_jump, shift_jump_mm;
    std::vector<Node> nodes;
    unsigned long asked = 0;
  };
  // Where s lies: an arc, and the part of it beyond s.
  struct Place {
    std::size_t span, arc;
    double part;
    bool valid;
  };
  // A section there, and how it moves: turn, shift and total wrench.
  struct Section {
    Matrix3d rotation_BS;
    Vector3d force_N, moment_Nmm;
    Matrix3d turn, shift_mm;
    Columns wrench;
    // In its own frame: the wrench, and its changes.
    SectionWrench wrench_S() const;
    ArcChange<3> change_S() const;
  };

  void prepare();  // for the solution, when the first is asked for
  void factorise_span(std::size_t span);
  template <int N>
  ArcVariation<N> vary(const ArcForces<double, 3>* forces, const SectionWrench& wrench) const;
  ArcVariation<9> vary_by_turns(const ArcForces<double, 3>& forces, const SectionWrench& wrench) const;
  SectionWrench linearise(std::size_t span, std::size_t arc);
  void carry(std::size_t span, std::size_t arc, const SectionWrench& gain_B);

  const Sweep& swept(const Source& source);
  void set_jumps(Sweep& sweep);
  void set_place_jumps(Sweep& sweep);
  void sweep_to_clamp(Sweep& sweep);
  void sweep_to_tip(Sweep& sweep) const;
  Columns rows(const Source& source, double s_mm, What what);
  Columns by_tension(std::size_t load, double s_mm, What what);
  Section inside(const Source& source, const Place& place, const Section& distal);
  Columns strain_or_wrench(const Source& source, const Place& place, const Section& section, What what);

  bool acts_in(const Source& source, std::size_t span) const;
  // Of a source's tendons, those that pass through a span.
  TendonArms tendon_arms(const Source& source, std::size_t span) const;
  const scene::DistributedForce* distributed(const Source& source) const;
  bool brings_forces(const Source& source, std::size_t span) const;
  Eigen::Matrix<double, 12, 3> source_in(const Source& source, std::size_t span, std::size_t arc) const;
  // Adds what the source changes in a length of a span with such a distal end.
  void add_source(const Source& source, std::size_t span, double length_mm, const Matrix3d& rotation_BS,
                  ArcChange<3>& change) const;
  // constants_ of a length of a span.
  void set_constants(std::size_t span, double length_mm);
  ArcForces<double, 3> forces_on(std::size_t span, double length_mm, const Matrix3d& rotation_BS) const;

  bool has_forces(std::size_t span) const {
    return !solution_.spans[span].follower_force_S_N_per_mm.isZero(0) ||
           !solution_.spans[span].fixed_force_B_N_per_mm.isZero(0);
  }
  Place place_of(double s_mm) const;
  std::size_t span_ending_at(double s_mm) const;
  double arc_length_mm(std::size_t span) const {
    return solution_.spans[span].length_mm() / solution_.arcs_per_span[span];
  }

  Solution solution_{};
  bool prepared_ = false;
  bool arc_loads_are_asked_for_ = false;  // distributed ones and tensions, at this solution or one before
  std::vector<Arc> arcs_;
  std::vector<std::size_t> first_arcs_;  // of the spans, and their number
  std::array<Sweep, 8> sweeps_;
  unsigned long asked_ = 0;
  BasicArcConstants<3> constants_;         // of the span in hand, with its tendons
  bool planar_ = false;                    // the span's arcs vary as planar ones
  BasicArcConstants<3> planar_constants_;  // in the plane's frame
  std::vector<BasicTendon<3>> tendons_;
};

}  // namespace fam
