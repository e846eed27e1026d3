#include "fam/lanes.h"

namespace fam {

#define FAM_DECLARE_LANES(unit)                                                                                      \
  namespace unit {                                                                                                   \
  void solve_lanes(const LaneRods& rods, const double* values, std::span<const std::ptrdiff_t> rows, LaneTip* tips); \
  }
FAM_DECLARE_LANES(portable)
#ifdef FAM_X86_64
FAM_DECLARE_LANES(x86_64_v2)
FAM_DECLARE_LANES(x86_64_v3)
FAM_DECLARE_LANES(x86_64_v4)
#endif

std::span<const LaneUnit> lane_units() {
  static const std::vector<LaneUnit> units = [] {
    std::vector<LaneUnit> found;
#ifdef FAM_X86_64
    __builtin_cpu_init();
    const auto has = [](auto... features) { return (features && ...); };
    if (has(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512bw"), __builtin_cpu_supports("avx512cd"),
            __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512vl")))
      found.push_back({"x86-64-v4", 8, x86_64_v4::solve_lanes});
    if (has(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("bmi"), __builtin_cpu_supports("bmi2"),
            __builtin_cpu_supports("fma")))
      found.push_back({"x86-64-v3", 4, x86_64_v3::solve_lanes});
    if (has(__builtin_cpu_supports("sse4.2"), __builtin_cpu_supports("ssse3"), __builtin_cpu_supports("popcnt")))
      found.push_back({"x86-64-v2", 2, x86_64_v2::solve_lanes});
#endif
    found.push_back({"portable", 2, portable::solve_lanes});
    return found;
  }();
  return units;
}

}  // namespace fam
