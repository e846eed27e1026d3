// How a rod is cut into segments, and what its loads can do at most: one walk over the arcs, from the tip.
#include "fam/load_length.h"
#include "fam/shooting.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fam {
namespace {

// The unique length (load_length.h) of a rod whose sections give way with these stiffnesses, from the tip on.
struct UniqueLength {
  double compliance_per_Nmm = 0;  // of the rod between the clamp and the cell
  double trace = 0, by_moments = 0, arms_turn_rad = 0;
  double moment_trace = 0, moment_squares_Nmm = 0;  // of the moments' kernel, and of its weight beyond the cell

  // spin_length: the part of the cell's load length by moments.
  void add(const LoadedCell& cell, double force_beyond_Nmm, double stiffness_Nmm2, double spin_length) {
    compliance_per_Nmm = std::max(0.0, compliance_per_Nmm - cell.length_mm / stiffness_Nmm2);
    trace += convexity_share(cell.force_N, force_beyond_Nmm, compliance_per_Nmm, cell.length_mm, stiffness_Nmm2);
    by_moments += spin_length;
    arms_turn_rad += cell.length_mm * cell.arms_Nmm / stiffness_Nmm2;
    const double moment_Nmm = force_beyond_Nmm + cell.length_mm * cell.force_N + cell.arms_Nmm;
    const double square_N = moment_Nmm * moment_Nmm / stiffness_Nmm2;
    moment_trace += convexity_share(square_N, moment_squares_Nmm, compliance_per_Nmm, cell.length_mm, stiffness_Nmm2);
    moment_squares_Nmm += cell.length_mm * square_N;
  }
  // The energy is convex where this is at most 1.
  double share() const {
    const double length = by_moments + std::sqrt(std::sqrt(6 * trace));
    return length * length / unique_length_squared + arms_turn_rad;
  }
  // Of loads that have an energy: every equilibrium is a minimum, and so the only one, where this is below 1.
  double minimum_share() const { return std::sqrt(trace) + std::sqrt(std::sqrt(moment_trace)) + arms_turn_rad; }
};

}  // namespace

template <int D>
bool Shooting<D>::one_equilibrium() const {
  const bool is_short = bounds_.unique_share <= 1 && (D == 2 || bounds_.turn_rad <= unique_turn_rad);
  return (is_short || bounds_.minimum_share < 1 || loads_all_but_follow()) && bounds_.strain <= unique_strain;
}

template <int D>
void Shooting<D>::cut_into_segments() {
  const std::span<const scene::Span> bounds = rod_.way().bounds;
  const bool planar = D == 2 || scene::plane_direction(bounds).has_value();
  bounds_ = {};
  segments_.clear();
  softness_.assign(1, 0);
  double since_cut = 0, force_beyond_Nmm = 0;
  UniqueLength unique, in_space;
  // A round rod's energy is that of its centreline's curvature, in space too.
  const bool round = planar && scene::is_round(bounds);
  const bool is_in_space = D == 3 && !planar;  // then both are one
  const auto giving_way_Nmm2 = [](const scene::Span& span, bool torsion_counts) {
    return torsion_counts ? least_stiffness_Nmm2(span) : span.stiffness.bending_Nmm2.minCoeff();
  };
  for (const scene::Span& span : bounds) {
    unique.compliance_per_Nmm += span.length_mm() / giving_way_Nmm2(span, !planar);
    in_space.compliance_per_Nmm += span.length_mm() / giving_way_Nmm2(span, !round);
  }
  int end_arc = rod_.arc_count();
  const auto visit = [&](const LoadedCell& arc) {
    const double least_Nmm2 = least_stiffness_Nmm2(arc.span);
    const double buckling_Nmm2 = giving_way_Nmm2(arc.span, !planar);
    const double spin_length = D == 3 || !round ? arc.length_by_moments() : 0;
    const double load_length = arc.length_by_force(buckling_Nmm2) + (D == 3 ? spin_length : 0);
    unique.add(arc, force_beyond_Nmm, buckling_Nmm2, D == 3 ? spin_length : 0);
    if (!is_in_space) in_space.add(arc, force_beyond_Nmm, giving_way_Nmm2(arc.span, !round), round ? 0 : spin_length);
    force_beyond_Nmm += arc.force_N * arc.length_mm;
    const scene::Wrench tendons = straight_tendons(arc.span);
    bounds_.load_length += load_length;
    const double by_moments_rad = arc.length_mm * arc.moment_Nmm / least_Nmm2;
    const double at_rest_rad =
        arc.length_mm * (arc.span.rest_curvature_per_mm.norm() + tendons.moment_Nmm.norm() / least_Nmm2);
    // In the plane bent rods are as good as straight ones.
    bounds_.turn_rad += by_moments_rad + (D == 3 ? at_rest_rad : 0);
    bounds_.turn_in_space_rad += by_moments_rad + at_rest_rad;
    if (rod_.model() == RodModel::reissner) {
      const double force_N = arc.force_N + tendons.force_N.norm();
      bounds_.strain = std::max(bounds_.strain, force_N * linear_compliance_per_N(arc.span));
    }
    if (since_cut > 0 && since_cut + load_length > segment_load_length_) {
      segments_.push_back({arc.cell + 1, end_arc});
      softness_.push_back(0);
      end_arc = arc.cell + 1;
      since_cut = 0;
    }
    since_cut += load_length;
    const Eigen::Vector2d& bending_Nmm2 = arc.span.stiffness.bending_Nmm2;
    softness_.back() += arc.length_mm * bending_Nmm2.tail<D - 1>().cwiseSqrt().cwiseInverse().sum();
  };
  // Loads that grow from none bound themselves.
  const bool from_no_load = bounds.data() == rod_.way().to.data();
  walk_from_tip(bounds, rod_.arcs_per_span(), visit, from_no_load ? Sum::vectors : Sum::sizes);
  if (is_in_space) in_space = unique;
  bounds_.unique_share = unique.share();
  bounds_.unique_share_in_space = in_space.share();
  if (scene::is_conservative(bounds)) bounds_.minimum_share = in_space.minimum_share();
  else if (bounds_.strain <= unique_strain) bounds_.clamp_straying = clamp_straying(bounds, planar);
  segments_.push_back({0, end_arc});
  if (loads_all_but_follow()) {  // then no change at the tip grows on the way
    segments_.assign(1, {0, rod_.arc_count()});
    softness_.assign(1, std::accumulate(softness_.begin(), softness_.end(), 0.));
  }
  std::reverse(segments_.begin(), segments_.end());
  std::reverse(softness_.begin(), softness_.end());
  nodes_.resize(segments_.size());
  if (segments_.size() > 1) system_.resize(unknowns * static_cast<int>(segments_.size()) - rotations - D);
}

template <int D>
void Shooting<D>::take_segments(const Shooting& fewer) {
  const auto here = [&](int arc) {
    return static_cast<int>(static_cast<long long>(arc) * rod_.arc_count() / fewer.rod_.arc_count());
  };
  bounds_ = fewer.bounds_;
  softness_ = fewer.softness_;
  segments_ = fewer.segments_;
  for (ArcRange& segment : segments_) segment = {here(segment.first_arc), here(segment.end_arc)};
  nodes_.resize(segments_.size());
}

template bool Shooting<2>::one_equilibrium() const;
template bool Shooting<3>::one_equilibrium() const;
template void Shooting<2>::cut_into_segments();
template void Shooting<3>::cut_into_segments();
template void Shooting<2>::take_segments(const Shooting<2>&);
template void Shooting<3>::take_segments(const Shooting<3>&);

}  // namespace fam
