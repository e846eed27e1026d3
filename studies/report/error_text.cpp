#include "studies/report/error_text.h"

#include "studies/report/table.h"

#include <algorithm>
#include <cmath>

namespace studies {

std::string error_text(double error_mm, int digits) {
  return scientific(std::max(error_mm, error_floor_mm), digits);
}

std::string error_for_reader(double error_mm) {
  if (!std::isfinite(error_mm)) return "–";
  return error_mm >= 0.00095 ? significant(error_mm, 2) : for_reader(error_text(error_mm, 1));
}

std::string observed_order(int coarse_arcs, double coarse_mm, int fine_arcs, double fine_mm) {
  constexpr double resolved_mm = 1e-8;
  if (!(std::min(coarse_mm, fine_mm) >= resolved_mm)) return "–";
  return fixed(std::log(coarse_mm / fine_mm) / std::log(static_cast<double>(fine_arcs) / coarse_arcs), 2);
}

}  // namespace studies
