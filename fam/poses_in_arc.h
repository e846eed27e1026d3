// Poses inside an arc, several at once: one place a lane (fam/pack.h).
#pragma once

#include "fam/arc_series.h"
#include "fam/vector_unit.h"

#include <array>

namespace fam {

constexpr std::size_t places_at_once = 4;
using PlacesAtOnce = std::array<double, places_at_once>;  // fractions of an arc from its proximal end
template <int D>
using PosesAtOnce = std::array<BasicPose<D>, places_at_once>;

// By the series of the whole arc (fam/arc_series.h) and the pose of its distal end. False, with no poses: the arc
// beyond a place turns by more than 2 rad, or so, which the lanes' coefficients do not serve.
template <bool with_shear, int D>
bool poses_in_arc(const RodSeries<double, D, 7>& series, const PlacesAtOnce& fractions, const BasicPose<D>& distal,
                  PosesAtOnce<D>& poses, VectorUnit unit = widest_unit());

}  // namespace fam
