#include "studies/sensing/observability.h"

#include "fam/estimator.h"
#include "fam/solve.h"
#include "studies/report/svg.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace studies {
namespace {

constexpr double length_mm = 40, bending_Nmm2 = 1500, unit_N = bending_Nmm2 / (length_mm * length_mm), sd_mm = 0.01;
constexpr std::array map_sizes{0.1, 1.0, 10.0};  // EI/L^2: of one force, ten times a size is a tenth of the stiffness
constexpr std::array map_places{1e-7, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
constexpr int angles = 13, angle_step_deg = 15;

// Infinite: not observable.
double relative_sd(double place, double size, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
  scene::Scene scene;
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2.setConstant(bending_Nmm2);
  stiffness.torsion_Nmm2 = 1000;
  scene.sections = {{length_mm, stiffness, Eigen::Vector3d::Zero()}};
  scene.loads = {scene::Force{place * length_mm, scene::Frame::fixed, size * unit_N * along}};
  fam::Options fine;
  fine.tolerance_mm = 1e-7;
  const scene::Equilibrium answer = fam::solve(scene, fine);
  if (!answer.converged()) return std::numeric_limits<double>::infinity();
  scene::EstimationProblem problem{
      {{scene, {{length_mm, scene::PositionMeasurement{answer.tip().position_B_mm, sd_mm}}}}}, {}};
  for (const int axis : {0, 1, 2}) {
    problem.unknowns.push_back({scene::Unknown::Kind::component, 0, 0, axis});
    problem.unknowns.back().prior_mean = size * unit_N * along[axis];
  }
  const fam::Estimate found = fam::Estimator(problem).estimate();
  double variance = 0;
  for (const int i : {0, 1, 2}) {
    for (const int k : {0, 1, 2}) {
      if (std::abs(along[i] * along[k]) > 1e-12) variance += along[i] * along[k] * found.covariance(i, k);
    }
  }
  const bool known = found.converged() && std::isfinite(variance) && variance >= 0;
  return known ? std::sqrt(variance) / (size * unit_N) : std::numeric_limits<double>::infinity();
}

struct Cell {
  double size, place, angle_deg, sd;
};

std::vector<Cell> all_cells() {
  std::vector<Cell> cells;
  for (const double size : map_sizes) {
    for (const double place : map_places) {
      for (int i = 0; i < angles; ++i) {
        const double angle_deg = i * angle_step_deg;
        cells.push_back({size, place, angle_deg, relative_sd(place, size, angle_deg)});
      }
    }
  }
  return cells;
}

// Dark: known well. A dash: not at all.
std::string fill_of(double sd) {
  return sd < 0.01 ? "#0b3c5d" : sd < 0.1 ? "#3d84b8" : sd < 1 ? "#a9d0ea" : "#fdf3cf";
}

std::string picture(const std::vector<Cell>& cells) {
  constexpr double cell_width = 30, cell_height = 20, left = 66, top = 92, panel = angles * cell_width + 76;
  const double height = top + map_places.size() * cell_height + 58;
  Svg svg(left + map_sizes.size() * panel - 40, height, "Where can a force be known from the tip's position?",
          "Three grids, of forces that bend the rod little, well and far: the angle to the rod along, the place on the "
          "rod upwards; dark cells are known well, pale ones worse than they are large, a dash is not observable.",
          "predicted deviation along itself over its size; positions to 0.01 mm of 40");
  double x = left;
  for (const auto& [sd, name] :
       {std::pair(0.001, "below 1 %"), {0.05, "1 to 10 %"}, {0.5, "10 to 100 %"}, {2.0, "larger than the force"}}) {
    svg.rectangle({x, 50}, 22, 16, fill_of(sd));
    svg.text({x + 27, 63}, name);
    x += 50 + text_width(name, 12);
  }
  svg.text({x + 4, 63}, "–  not observable");
  const double bottom = top + map_places.size() * cell_height;
  for (std::size_t s = 0; s < map_sizes.size(); ++s) {
    const double start = left + static_cast<double>(s) * panel;
    svg.text({start, top - 8}, fmt::format("{:g} EI/L²", map_sizes[s]), Anchor::start, 13);
    for (std::size_t p = 0; p < map_places.size(); ++p) {
      const double y = bottom - cell_height * static_cast<double>(p + 1);
      svg.text({start - 6, y + 14}, map_places[p] < 0.01 ? "1e-7" : fmt::format("{:g}", map_places[p]), Anchor::end);
      for (int i = 0; i < angles; ++i) {
        const Cell& cell = cells[(s * map_places.size() + p) * angles + static_cast<std::size_t>(i)];
        const Point corner{start + cell_width * i, y};
        if (std::isfinite(cell.sd))
          svg.rectangle({corner.x + 0.5, corner.y + 0.5}, cell_width - 1, cell_height - 1, fill_of(cell.sd));
        else svg.text({corner.x + cell_width / 2, corner.y + 14}, "–", Anchor::middle);
      }
    }
    for (int i = 0; i < angles; i += 2)
      svg.text({start + cell_width * (i + 0.5), bottom + 16}, std::to_string(i * angle_step_deg), Anchor::middle);
    svg.text({start + cell_width * angles / 2, bottom + 36}, "angle to the rod, degrees", Anchor::middle);
  }
  svg.text({18, (top + bottom) / 2}, "force at, L", Anchor::middle, 12, colour::black, -90);
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> observability_files() {
  const std::vector<Cell> cells = all_cells();
  Table table({"size_EI_per_L2", "place_over_L", "angle_deg", "sd_over_size"});
  for (const Cell& cell : cells) {
    table.add({fmt::format("{:g}", cell.size), fmt::format("{:g}", cell.place), fmt::format("{:g}", cell.angle_deg),
               std::isfinite(cell.sd) ? significant(cell.sd, 3) : "unobservable"});
  }
  return {{"observability.csv",
           table.csv({"A force of unknown components from the tip's position to 0.01 mm, without noise."})},
          {"observability.svg", picture(cells)}};
}

}  // namespace studies
