#include "fam/poses_in_arc.h"

#include "fam/pack.h"

namespace fam {
namespace {

// Of the places from `first` on, one a lane.
template <int lanes, bool with_shear, int D>
bool set_poses(const RodSeries<double, D, 7>& series, const PlacesAtOnce& fractions, std::size_t first,
               const BasicPose<D>& distal, PosesAtOnce<D>& poses) {
  using Lanes = Pack<lanes, 0>;
  Lanes part;
  for (std::size_t i = 0; i < lanes; ++i) part.value[i] = 1 - fractions[first + i];
  const BasicScrew<Lanes, D> screw = magnus<with_shear>(strain_of_part<with_shear>(series, part));
  if (Lanes::any(Lanes(largest_lane_angle_rad * largest_lane_angle_rad) < screw.rotation.squaredNorm())) return false;
  const BasicMotion<Lanes, D> motion = exponential(screw);
  Vector<Lanes, D> position_mm = as<Lanes>(distal.position_B_mm);
#pragma GCC unroll 3
  for (int row = 0; row < D; ++row) {
    const Vector<Lanes, D> axis = motion.rotate(as<Lanes>(Vector<double, D>(distal.rotation_BS.row(row).transpose())));
    position_mm[row] -= axis.dot(motion.position_mm);
    for (std::size_t i = 0; i < lanes; ++i) {
      BasicPose<D>& pose = poses[first + i];
      for (int column = 0; column < D; ++column) pose.rotation_BS(row, column) = axis[column].value[i];
      pose.position_B_mm[row] = position_mm[row].value[i];
    }
  }
  return true;
}

template <int lanes, bool with_shear, int D>
bool set_poses(const RodSeries<double, D, 7>& series, const PlacesAtOnce& fractions, const BasicPose<D>& distal,
               PosesAtOnce<D>& poses) {
  for (std::size_t first = 0; first < places_at_once; first += lanes) {
    if (!set_poses<lanes, with_shear>(series, fractions, first, distal, poses)) return false;
  }
  return true;
}

}  // namespace

template <bool with_shear, int D>
bool poses_in_arc(const RodSeries<double, D, 7>& series, const PlacesAtOnce& fractions, const BasicPose<D>& distal,
                  PosesAtOnce<D>& poses, [[maybe_unused]] VectorUnit unit) {
#ifdef FAM_HAS_AVX2_UNIT
  if (unit == VectorUnit::avx2)
    return call_by_avx2([&] { return set_poses<4, with_shear>(series, fractions, distal, poses); });
#endif
  return set_poses<2, with_shear>(series, fractions, distal, poses);
}

#define FAM_POSES(with_shear, D)                                                                                   \
  template bool poses_in_arc<with_shear>(const RodSeries<double, D, 7>&, const PlacesAtOnce&, const BasicPose<D>&, \
                                         PosesAtOnce<D>&, VectorUnit);
FAM_POSES(true, 2)
FAM_POSES(true, 3)
FAM_POSES(false, 2)
FAM_POSES(false, 3)

}  // namespace fam
