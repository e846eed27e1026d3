#include "fem_reference/solve.h"

#include "fem_reference/beam_element.h"
#include "fem_reference/limit.h"
#include "fem_reference/load_stepping.h"
#include "fem_reference/stations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace fem_reference {

namespace {

bool is_rigid_somewhere(const BeamModel& model) {
  return std::any_of(model.elements.begin(), model.elements.end(),
                     [](const ElementData& element) { return (element.force_compliance.array() == 0).any(); });
}

// What a converged solution of the equations needs to be a rod; empty if it is one.
std::string defect(const BeamModel& model, const BeamState& state) {
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const ElementState element = state_of_element(model, state, e);
    for (int g = 0; g < model.reference.points(); ++g) {
      if (element_strain(model.reference, model.elements[e], element, g).v[0] <= 0) {
        return "element " + std::to_string(e) + " is compressed to nothing (1 + stretch <= 0)";
      }
    }
  }
  return {};
}

struct Solution {
  scene::Equilibrium equilibrium;
  SolvedBeam beam;  // of a converged equilibrium
};

std::vector<scene::Fact> facts(const BeamModel& model, const SteppingResult& result, const Options& options) {
  return {{"elements", static_cast<int>(model.elements.size())},
          {"order", options.order},
          {"integration", std::string(options.full_integration ? "full" : "reduced")},
          {"model", std::string(options.model == RodModel::kirchhoff ? "kirchhoff" : "reissner")},
          {"load_steps", result.load_steps},
          {"newton_iterations", result.newton_iterations}};
}

// Stations and tip angle, or why there are none.
void hand_out(const SolvedBeam& beam, scene::Equilibrium& equilibrium) {
  std::string found = defect(beam.model, beam.state);
  auto along = found.empty() ? stations(beam) : std::nullopt;
  if (!along) {
    equilibrium.status = scene::Status::not_converged;
    equilibrium.message = found.empty() ? "the strains under the tendons' pull were not found at a station" : found;
    return;
  }
  equilibrium.stations = std::move(*along);
  equilibrium.tip_angle_rad = scene::tip_angle_rad(equilibrium.stations, scene::plane_normal(beam.spans));
}

Solution solve_on(const std::vector<scene::Span>& spans, const std::vector<int>& cells, const Options& options) {
  const ReferenceElement reference =
      reference_element(options.order, options.order + (options.full_integration ? 1 : 0));
  Solution solution{{}, {spans, cells, beam_model(spans, cells, reference, options.model == RodModel::kirchhoff), {}}};
  const BeamModel& model = solution.beam.model;
  SteppingResult result;
  if (options.full_integration && is_rigid_somewhere(model)) {
    result.status = scene::Status::unsupported;
    result.message = "full integration of a rod that does not stretch or shear: use reduced integration";
  } else {
    result = step_to_full_load(model, stepping_options(options));
    if (result.status == scene::Status::load_step_too_small) {
      look_for_a_limit(model, stepping_options(options), result);
    }
  }
  scene::Equilibrium& equilibrium = solution.equilibrium;
  equilibrium.model = facts(model, result, options);
  equilibrium.status = result.status;
  equilibrium.message = std::move(result.message);
  if (result.limit) equilibrium.limit = scene::Limit{*result.limit, "fold"};
  if (!equilibrium.converged()) return solution;
  equilibrium.stable = result.stable;
  solution.beam.state = std::move(result.state);
  hand_out(solution.beam, equilibrium);
  return solution;
}

// Meshes whose shapes lie farther apart than this times L are too coarse to trust the order of the error,
constexpr double asymptotic_difference = 1e-3;
// and farther apart than this, to trust anything.
constexpr double distrusted_difference = 0.05;

// Whether an element turns by more than pi/2 from end to end.
bool turns_far(const SolvedBeam& beam) {
  const auto order = static_cast<std::size_t>(beam.model.reference.order());
  const std::vector<Quaternion>& rotations = beam.state.rotation_BS;
  const double cosine = std::sqrt(0.5);  // of half that angle
  for (std::size_t i = order; i < rotations.size(); i += order) {
    if (std::abs(rotations[i - order].dot(rotations[i])) < cosine) return true;
  }
  return false;
}

// Largest distance, of all stations found, from where another mesh has them.
double distance_mm(const Solution& found, const Solution& other) {
  double largest_mm = 0;
  for (const scene::Station& station : found.equilibrium.stations) {
    const Eigen::Vector3d apart_mm = position_B_mm(other.beam, station.s_mm) - station.X_BS.position_B_mm;
    largest_mm = std::max(largest_mm, apart_mm.norm());
  }
  return largest_mm;
}

// Largest error of the stations on `cells`, from another mesh of half the elements: between nodes it is c h^q with
// q = order + 1 at least, doubled for safety. Where they are too coarse for that, twice the distance of the shapes,
// from twice the elements too; L at least where that distance is large or an element turns by more than pi/2: such
// meshes can agree on what is no solution.
double error_estimate_mm(const Solution& found, const Options& options) {
  const std::vector<int>& cells = found.beam.cells;
  const double length_mm = found.beam.spans.back().end_mm;
  const auto distance_to_mm = [&](const std::vector<int>& mesh) {
    const Solution other = solve_on(found.beam.spans, mesh, options);
    return other.equilibrium.converged() ? distance_mm(found, other) : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<int> half = cells, twice = cells;
  double ratio = std::numeric_limits<double>::infinity();  // of the element lengths, the least of all spans
  for (std::size_t i = 0; i < cells.size(); ++i) {
    half[i] = (cells[i] + 1) / 2;
    twice[i] = 2 * cells[i];
    ratio = std::min(ratio, static_cast<double>(cells[i]) / half[i]);
  }
  const bool finer = ratio == 1;  // a span of one element cannot be halved
  double difference_mm = distance_to_mm(finer ? twice : half);
  if (std::isnan(difference_mm)) return difference_mm;
  if (difference_mm <= asymptotic_difference * length_mm) {
    return 2 * difference_mm / std::abs(std::pow(finer ? 0.5 : ratio, options.order + 1) - 1);
  }
  if (!finer) difference_mm += std::max(0.0, distance_to_mm(twice) - difference_mm);
  const bool distrusted = difference_mm > distrusted_difference * length_mm || turns_far(found.beam);
  return distrusted ? std::max(2 * difference_mm, length_mm) : 2 * difference_mm;
}

}  // namespace

scene::Equilibrium solve(const scene::Scene& scene, const Options& options) {
  validate(options);
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  const Solution found = solve_on(spans, scene::cells_per_span(spans, options.elements), options);
  scene::Equilibrium equilibrium = found.equilibrium;
  if (!equilibrium.converged()) return equilibrium;
  equilibrium.tendon_shortening_mm = tendon_shortening_mm(found.beam, scene.loads);
  if (options.estimate_error) equilibrium.error_estimate_mm = error_estimate_mm(found, options);
  return equilibrium;
}

}  // namespace fem_reference
