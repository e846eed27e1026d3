// What the loads can do to a rod at most, read off its spans on one walk from the tip to the clamp.
//
// The load length of a stretch is its length over that which the loads themselves have: int sqrt(force / EI) ds, force
// that of all loads beyond. A change at its tip side grows like its exponential towards the clamp. In space a
// moment M about the axis of middle stiffness adds int M sqrt((c2 - c1)(c3 - c2)) ds, with the compliances 1/GJ,
// 1/EI_y, 1/EI_z in order: the rate of Euler's unstable spin, at which the direction of the moment goes astray.
//
// The unique length says how far the energy is convex. With c(s) the compliance int_0^s ds/EI between the clamp and s
// and F(s) the force beyond, a turn theta costs int F theta^2 at most and gives int EI theta'^2: the form is positive
// while the largest eigenvalue of the kernel sqrt(F(s)) c(min(s, t)) sqrt(F(t)) is below 1, for which its trace of
// second order below 1 suffices,
//   2 int F(s) c(s)^2 int_s^L F dt ds   (F^2 L^4 / (6 EI^2) of a uniform rod under a tip force: L^2 F/EI < 2.449).
// The unique length is the fourth root of six times that, L sqrt(F/EI) of such a rod, and the moments' part is added.
// In space a turn also works against the moment m that the loads leave to the section, whatever the rest shape and
// straight tendons, which are but another one: a turn R exp(theta) has the strain k + dk + dk x theta / 2, dk = theta'
// + k x theta, so that it costs at most int |m| |theta| |dk|, the root of int EI dk^2 times that of the kernel of
// m^2/EI in the place of F, and |m| is at most int F ds. While both together are below int EI dk^2, at every
// equilibrium, all are minima of the energy, and there is one alone: the minimum share, of the roots of the traces,
// below 1. Forces off the centreline, F at r, cost |F| |r| theta^2 more where they act, at most |F| |r| c of that
// integral: as much is missing from 1.
#pragma once

#include "fam/arc.h"

#include "scene/span.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace fam {

// The smallest of GJ, EI_y, EI_z.
double least_stiffness_Nmm2(const scene::Span& span);

// The larger of 1/EA and 1/kGA; 0 where the section neither stretches nor shears.
double linear_compliance_per_N(const scene::Span& span);

// The rate of Euler's unstable spin per moment: sqrt((c2 - c1)(c3 - c2)).
double spin_rate_per_Nmm2(const scene::Span& span);

// The pulls of tendons along e_x, as the internal force -T and moment -r x T e_x that they leave to the rod (section
// frame).
scene::Wrench straight_tendons(const scene::Span& span);

// A cell of a span, one of those that the span is cut into, as the walk meets it.
struct LoadedCell {
  std::size_t span_index;
  const scene::Span& span;
  int cell;  // of all, from the clamp
  double length_mm;
  // Of all loads on the cell and beyond, at most: the forces, the moments of point loads, and of these those of forces
  // off the centreline, which the shape decides.
  double force_N, moment_Nmm, arms_Nmm;

  double length_by_force(double stiffness_Nmm2) const { return length_mm * std::sqrt(force_N / stiffness_Nmm2); }
  double length_by_moments() const { return moment_Nmm > 0 ? length_mm * moment_Nmm * spin_rate_per_Nmm2(span) : 0; }
  double load_length(double stiffness_Nmm2, bool by_moments) const {
    return length_by_force(stiffness_Nmm2) + (by_moments ? length_by_moments() : 0);
  }
};

// How fixed loads add up: as vectors, or, where each is the larger of several, by their sizes.
enum class Sum { vectors, sizes };

// The forces or moments on a section and beyond; following ones turn, and add up by their sizes.
class LoadSum {
 public:
  explicit LoadSum(Sum sum) : sum_(sum) {}
  void add_fixed(const Vector3d& load) {
    if (sum_ == Sum::vectors) fixed_ += load;
    else sizes_ += load.norm();
  }
  void add_following(double size) { sizes_ += size; }
  double size() const { return sizes_ + fixed_.norm(); }

 private:
  Sum sum_;
  Vector3d fixed_ = Vector3d::Zero();
  double sizes_ = 0;
};

// Calls visit(cell) from the tip to the clamp; cells_per_span[i] cells of span i.
template <class Cells, class Visit>
void walk_from_tip(std::span<const scene::Span> spans, const Cells& cells_per_span, Visit&& visit,
                   Sum sum = Sum::sizes) {
  int cell = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) cell += cells_per_span[i];
  LoadSum force_N(sum), moment_Nmm(sum);
  double arms_Nmm = 0;
  for (std::size_t i = spans.size(); i-- > 0;) {
    const scene::Span& span = spans[i];
    force_N.add_following(span.follower_load_S.force_N.norm());
    force_N.add_fixed(span.fixed_load_B.force_N);
    arms_Nmm += span.fixed_force_arms_BS_Nmm.norm();
    moment_Nmm.add_following(span.follower_load_S.moment_Nmm.norm());
    moment_Nmm.add_fixed(span.fixed_load_B.moment_Nmm);
    const double length_mm = span.length_mm() / cells_per_span[i];
    const double following_N = length_mm * span.follower_force_S_N_per_mm.norm();
    const Vector3d fixed_N = length_mm * span.fixed_force_B_N_per_mm;
    double at_distal_end_N = force_N.size();
    for (int k = 0; k < cells_per_span[i]; ++k) {
      force_N.add_following(following_N);
      force_N.add_fixed(fixed_N);
      const double at_proximal_end_N = force_N.size();
      visit(LoadedCell{i, span, --cell, length_mm, std::max(at_distal_end_N, at_proximal_end_N),
                       moment_Nmm.size() + arms_Nmm, arms_Nmm});
      at_distal_end_N = at_proximal_end_N;
    }
  }
}

// What a cell adds to the unique length's integral: F(s) on it, int F dt beyond it, c at its end towards the clamp.
template <class T>
T convexity_share(const T& force_N, const T& force_beyond_Nmm, double compliance_to_clamp_per_Nmm, double length_mm,
                  double stiffness_Nmm2) {
  const double a = compliance_to_clamp_per_Nmm, b = 1 / stiffness_Nmm2, h = length_mm;
  const double beyond = h * (a * a + h * (a * b + h * b * b / 3));
  const double on_it = h * h * (a * a / 2 + h * (a * b / 3 + h * b * b / 12));
  return T(2) * force_N * (force_beyond_Nmm * T(beyond) + force_N * T(on_it));
}

struct OneEach {
  int operator[](std::size_t) const { return 1; }
};

// Loads that follow leave one equilibrium, as a march from the tip shows, and so do others beside them that are small.
// Of two marches from tips that differ by a turn of size 1 the rigid turn is what following loads make of it; by how
// much the clamps' turns differ from it, at most. Let phi be the turn of a section (base axes), Gamma and Delta what
// the section's force F and moment M change by beyond turning with it. Towards the clamp
//   |phi|' <= |Delta| / EI,  |Gamma|' <= |F| |phi|' + |f| |phi|,  |Delta|' <= |Gamma| + |M| (c3 - c1) / 2 |Delta|,
// f the fixed distributed force, 1/EI the largest compliance c3, the last term in space alone; a fixed point load adds
// its force times |phi| to Gamma, its moment (or arm times force) to Delta. Below 1 the clamp's turn is locally
// invertible in the tip's, everywhere, and so one tip alone meets the clamp (docs/theory.md). Rest curvature and
// straight tendons do not enter. Shear and stretch are left out.
double clamp_straying(std::span<const scene::Span> spans, bool planar);

// Whether each span has one strain all along it, known before the shape is: no force acts but those of tendons, which
// what they leave to the rod cancels, and no moment, or in the plane, where it turns with nothing; nor do forces off
// the centreline that cancel, whose moment is the shape's and may leave more than one equilibrium.
bool strains_are_constant(std::span<const scene::Span> spans, bool planar);

// The largest load length by forces of an arc, with the least stiffness of its span.
double largest_load_length(std::span<const scene::Span> spans, std::span<const int> arcs_per_span);

// The least and the middle of GJ, EI_y, EI_z, as the root of their product: what a section sets against a force across
// it, which bends it about its weakest axis only as far as it is twisted, and twists it only as far as it is bent.
double across_stiffness_Nmm2(const scene::Span& span);

// What the difference of the loads of two rods with the same cuts would do alone: the square of its load length, and
// the turn by its moments, tendons and rest curvature in rad.
double size_of_change(std::span<const scene::Span> from, std::span<const scene::Span> to);

// How fast a section with this total moment m (section frame) turns along the rod, or small changes of m grow or swing,
// if that is more: sqrt(|tr J^2| / 2), J as below.
double swing_rate_per_mm(const scene::Span& span, const Vector3d& moment_Nmm);

// How far the solved arcs swing, the largest of clamp to tip: the turn of one, or in space what its moment m grows or
// swings by about the solution, if that is more: sqrt(|tr J^2| / 2) h, with J the derivative of m x k (m' = m x k, k
// the strain) with respect to m. Arcs of constant strain, and others that no force acts on where m lies along k, are
// exact and do not count.
template <int D>
double largest_swing_rad(std::span<const scene::Span> spans, std::span<const int> arcs_per_span,
                         std::span<const BasicArc<D>> arcs);

// The same of small motions in space about the solved arcs, of planar rods, too: how far they are from being resolved.
template <int D>
double largest_swing_in_space_rad(std::span<const scene::Span> spans, std::span<const int> arcs_per_span,
                                  std::span<const BasicArc<D>> arcs);

// What the series of sixth order leave out of a solved shape, over its length, at most: the sum over the arcs of
// x^7 + q x^4, times series_share and 1 + (sum x)^2 for what becomes of it along the rod. x is the largest of an arc's
// load length, turn, swing and the root of what its strain turns by as the moment does (|m x k| h^2 over the least
// stiffness), q = f h^3 / EI that of a distributed force f, which grows along it: the order of what
// is left out, h^7, by what makes the strain change. Of marches and of rods with one equilibrium.
// Of 220 000 rods drawn for it (up to eight sections with stiffnesses of 1 to 1e4, rest curvature, all kinds of loads)
// and random scenes 18 200 had a bound below 1e-2 and an error above 3e-9: it is at most 0.41 of the bound, and 1.04
// without the last factor.
constexpr double series_share = 0.1;
template <int D>
double series_error_over_L(std::span<const scene::Span> spans, std::span<const int> arcs_per_span,
                           std::span<const BasicArc<D>> arcs);

}  // namespace fam
