// How far an arc reaches by its moment: beyond resolved_reach_rad two resolutions may agree by chance (fam/solve.h).
#pragma once

#include "fam/arc.h"

#include "scene/span.h"

#include <span>

namespace fam {

// The largest reach of the solved arcs, clamp to tip, of which each span has arcs_per_span: the turn of one, or in
// space what its moment m grows or swings by about the solution, if that is more: sqrt(|tr J^2| / 2) h, with J the
// derivative of m x k (m' = m x k, k the strain) with respect to m. Arcs that no force acts on are exact where m lies
// along k, and in the plane always, and do not count.
double largest_reach_rad(std::span<const scene::Span> spans, std::span<const int> arcs_per_span,
                         std::span<const Arc> arcs, bool planar);

}  // namespace fam
