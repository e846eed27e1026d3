#include "studies/paths/data.h"

#include <cmath>
#include <numbers>

namespace studies {
namespace {

using scene::Path;
using scene::PathPoint;
using Kind = PathPoint::Kind;

// The parameter of the fold or branch point of the first branch with this number, from 0.
auto critical(std::size_t number) {
  return [number](const Path& path) -> std::optional<double> {
    std::size_t met = 0;
    for (const PathPoint& point : path.points) {
      if (point.branch != 0 || (point.kind != Kind::fold && point.kind != Kind::branch)) continue;
      if (met++ == number) return point.parameter;
    }
    return std::nullopt;
  };
}

auto sum_of_folds(double factor) {
  return [factor](const Path& path) -> std::optional<double> {
    const std::optional<double> first = critical(0)(path), second = critical(1)(path);
    if (!first || !second) return std::nullopt;
    return factor * (*first + *second);
  };
}

// The tip's y over the length on the first branch that leaves the path, at a stop.
auto tip_y(double parameter, double length_mm) {
  return [=](const Path& path) -> std::optional<double> {
    for (const PathPoint& point : path.points) {
      if (point.branch == 1 && point.parameter == parameter) return point.tip_position_B_mm[1] / length_mm;
    }
    return std::nullopt;
  };
}

const double pi = std::numbers::pi;
// The elastica whose tip has turned by 60 degrees.
const double modulus = 0.5, K = std::comp_ellint_1(modulus), load_60 = std::pow(2 * K / pi, 2);

}  // namespace

const std::array<PathMethod, path_method_count> path_methods{
    {{"fam", "FAM as called"}, {"fam_fine", "FAM, fine"}, {"exact", "exact"}, {"fem", "FE"}}};

// Zeros of Bessel functions: by scipy.special.jv and brentq.
const std::vector<PathCase>& path_cases() {
  static const std::vector<PathCase> cases{
      {"elastica",
       "Column and elastica",
       "Pressed beyond Euler's load the column bows out and its tip comes round past the clamp; the straight one stays "
       "an "
       "equilibrium, unstable in two directions at once.",
       load_60,
       {{"buckles at, over Euler's load", "Euler", 1, critical(0)},
        {"second mode", "Euler", 9, critical(1)},
        {"tip's y/L where it has turned by 60°", "elliptic integrals", 2 * modulus / K, tip_y(load_60, 100)}}},
      {"heavy_column",
       "Heavy column",
       "A column under its own weight, four times as stiff across: Greenhill's height, then the same across, then the "
       "second mode.",
       20,
       {{"buckles at, w L³/EI", "Greenhill 1881; zero of J₋₁⸝₃", 7.837347438943483, critical(0)},
        {"across", "four times that", 4 * 7.837347438943483, critical(1)},
        {"second mode", "second zero of J₋₁⸝₃", 55.97702968126102, critical(2)}}},
      {"lateral",
       "Strip on edge",
       "A strip pressed on its edge topples sideways and twists.",
       5,
       {{"topples at, over √(EI GJ)/L²", "Prandtl, Michell 1899; zero of J₋₁⸝₄ ¹", 4.01259934357890, critical(0), 2e-6},
        {"second mode", "second zero of J₋₁⸝₄ ¹", 20.49225097098538 / 2, critical(1), 2e-6}}},
      {"turned_clamp",
       "Curved rod turned in its clamp",
       "A rod with rest curvature and a weight on a lever arm at its tip lags behind its clamp, snaps round past half "
       "a "
       "turn, and back at another angle: hysteresis.",
       3.2,
       {{"snaps at, rad", "AUTO-07p, refined", 3.292926116, critical(0)},
        {"and back at", "AUTO-07p, refined", 3.033816950, critical(1)}}},
      {"curl",
       "Heavy curl",
       "A hanging rod with rest curvature hangs as a planar hook, then as a helix, and as a planar curl again.",
       0.9,
       {}},
      {"coil",
       "Coil pulled straight",
       "Two turns of wire in a plane, pulled by the tip: they twist out of the plane to unwind, and come "
       "back into it without a loop.",
       10,
       {}},
      {"finger",
       "Finger that snaps past a load",
       "A bent finger under thrust: its tendon pulls it over, and it snaps to the other side.",
       2,
       {{"mean of the two tensions, N", "symmetry: EI κ₀/offset", 2.5, sum_of_folds(0.5)}}},
      {"ribbon",
       "Heavy ribbon turned in its clamp",
       "A drooping ribbon is turned about its axis past its edge: it hangs on, then topples over.",
       1.65,
       {{"sum of both angles, rad", "symmetry: π", pi, sum_of_folds(1)}}},
  };
  return cases;
}

}  // namespace studies
