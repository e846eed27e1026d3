// The march with derivatives: small motions of a section, several at once, carried from the tip towards the clamp.
// Exact derivatives of the discrete steps (fam/arc_slopes.h; in the plane by dual numbers).
#pragma once

#include "fam/arc_slopes.h"
#include "fam/loaded_rod.h"

namespace fam {

// N small motions of a section: how it turns, in its own frame, and how its wrench's components there change.
template <int D, int N>
struct Fields {
  Eigen::Matrix<double, rotations_of(D), N> turn;
  Eigen::Matrix<double, D, N> force_N;
  Eigen::Matrix<double, rotations_of(D), N> moment_Nmm;
};

// N: 1 or 4.
template <int N>
void march_varied(const LoadedRod<2>& rod, ArcRange arcs, SectionState<2>& state, Fields<2, N>& fields);

// One arc in space, without the point loads at its distal end. N: 3 or 9. False: a tendon had no length.
template <int N>
bool vary_step(const LoadedRod<3>& rod, const SpanArcs<3>& span, SectionState<3>& state, Fields<3, N>& fields);
template <int N>
void add_point_loads(const SpanArcs<3>& span, SectionState<3>& state, Fields<3, N>& fields);

// after_arc(state, fields) sees each proximal end, and may change the fields.
template <int N, class After>
void march_varied(const LoadedRod<3>& rod, ArcRange arcs, SectionState<3>& state, Fields<3, N>& fields,
                  After&& after_arc) {
  rod.for_spans(arcs, [&](const SpanArcs<3>& span, int first_arc, int end_arc) {
    if (end_arc == span.end_arc) add_point_loads(span, state, fields);
    for (int arc = end_arc; arc-- > first_arc;) {
      if (!vary_step(rod, span, state, fields)) rod.note_collapse();
      after_arc(state, fields);
    }
  });
}
template <int N>
void march_varied(const LoadedRod<3>& rod, ArcRange arcs, SectionState<3>& state, Fields<3, N>& fields) {
  march_varied(rod, arcs, state, fields, [](const auto&, const auto&) {});
}

}  // namespace fam
