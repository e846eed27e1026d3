#include "exact_reference/limit.h"

#include "exact_reference/critical_points.h"

#include <algorithm>

namespace exact_reference {

std::optional<double> fold_ahead(const ScaledRod& rod, const MeshedStates& from, double load_factor) {
  constexpr int most_steps = 60;  // growing ones: a fold is near where the load cannot grow
  constexpr double first_step = 1e-3, longest_step = 0.05, smallest_step = 1e-9;
  constexpr double tolerance = 1e-9;  // six digits of the load factor are promised
  Continuation path(
      rod, [](ScaledRod&, double factor) { return factor; }, 1, tolerance, from.mesh, rod.has_energy());
  if (!path.start(from.y, load_factor, 1)) return std::nullopt;
  double s = first_step;
  for (int step = 0; step < most_steps && path.base().parameter() < 1 && s > smallest_step; ++step) {
    const std::optional<Solution> next = path.at(s);
    const auto found = next && path.leads_to(*next) ? critical_points(path, *next, s) : std::nullopt;
    if (!found) {
      s /= 2;
      continue;
    }
    for (const CriticalPoint& point : *found) {
      const double factor = point.x[point.x.size() - 1];
      if (point.kind == scene::PathPoint::Kind::fold && factor <= 1) return factor;
    }
    if (!path.advance(*next)) return std::nullopt;
    s = std::min(2 * s, longest_step);
  }
  return std::nullopt;
}

}  // namespace exact_reference
