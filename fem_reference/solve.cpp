#include "fem_reference/solve.h"

#include "fem_reference/beam_element.h"
#include "fem_reference/load_stepping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace fem_reference {

namespace {

void require(bool holds, const char* name, double value, const char* rule) {
  if (holds) return;
  throw scene::SceneError("finite element options: " + std::string(name) + " = " + std::to_string(value) + ": " + rule);
}

void validate(const Options& options) {
  require(options.elements >= 1 && options.elements <= 1'000'000, "elements", options.elements, "must be 1 to 1000000");
  require(options.order >= 1 && options.order <= max_order, "order", options.order, "must be 1, 2 or 3");
  require(options.initial_load_step > 0 && options.initial_load_step <= 1, "initial_load_step",
          options.initial_load_step, "must be > 0 and <= 1");
  require(options.smallest_load_step > 0, "smallest_load_step", options.smallest_load_step, "must be > 0");
  require(options.max_load_steps >= 1, "max_load_steps", options.max_load_steps, "must be >= 1");
  require(options.max_newton_iterations >= 1, "max_newton_iterations", options.max_newton_iterations, "must be >= 1");
  require(options.largest_rotation_rad > 0 && options.largest_rotation_rad <= 3, "largest_rotation_rad",
          options.largest_rotation_rad, "must be > 0 and <= 3");
  require(options.tolerance > 0, "tolerance", options.tolerance, "must be > 0");
}

SteppingOptions stepping_options(const Options& options) {
  return {.initial_load_step = options.initial_load_step,
          .smallest_load_step = options.smallest_load_step,
          .max_load_steps = options.max_load_steps,
          .max_newton_iterations = options.max_newton_iterations,
          .largest_rotation_rad = options.largest_rotation_rad,
          .tolerance = options.tolerance};
}

bool is_rigid_somewhere(const BeamModel& model) {
  return std::any_of(model.elements.begin(), model.elements.end(),
                     [](const ElementData& element) { return (element.force_compliance.array() == 0).any(); });
}

// All nodes, clamp to tip; those at span ends lie exactly there.
std::vector<scene::Station> stations(const std::vector<scene::Span>& spans, const std::vector<int>& cells,
                                     const BeamModel& model, const BeamState& state) {
  std::vector<scene::Station> result;
  const auto add = [&](double s_mm) {
    const std::size_t node = result.size();
    result.push_back({s_mm, {rotation_matrix(state.rotation_BS[node]), state.position_B[node] * model.length_unit_mm}});
  };
  add(0);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (int e = 0; e < cells[i]; ++e) {
      for (int k = 1; k < model.reference.nodes(); ++k) {
        const double fraction = (e + model.reference.node(k)) / cells[i];
        add(fraction < 1 ? spans[i].start_mm + fraction * spans[i].length_mm() : spans[i].end_mm);
      }
    }
  }
  return result;
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

scene::Equilibrium equilibrium(const std::vector<scene::Span>& spans, const std::vector<int>& cells,
                               const BeamModel& model, SteppingResult result, const Options& options) {
  scene::Equilibrium equilibrium;
  equilibrium.status = result.status;
  equilibrium.message = std::move(result.message);
  equilibrium.model = {{"elements", static_cast<int>(model.elements.size())},
                       {"order", options.order},
                       {"integration", std::string(options.full_integration ? "full" : "reduced")},
                       {"model", std::string(options.model == RodModel::kirchhoff ? "kirchhoff" : "reissner")},
                       {"load_steps", result.load_steps},
                       {"newton_iterations", result.newton_iterations}};
  if (!equilibrium.converged()) return equilibrium;
  if (std::string found = defect(model, result.state); !found.empty()) {
    equilibrium.status = scene::Status::not_converged;
    equilibrium.message = std::move(found);
    return equilibrium;
  }
  equilibrium.stations = stations(spans, cells, model, result.state);
  equilibrium.tip_angle_rad = scene::total_angle_rad(equilibrium.stations);
  equilibrium.stable = result.stable;
  // The wall pushes back with what the rod's first section carries; the tendons run through the clamp.
  const ElementData& first = model.elements.front();
  equilibrium.base_force_B_N = (first.tendon_force_S - result.clamp_force_B) * model.force_unit_N;
  equilibrium.base_moment_B_Nmm = (first.tendon_moment_S - result.clamp_moment_B) * model.moment_unit_Nmm();
  return equilibrium;
}

scene::Equilibrium solve_on(const std::vector<scene::Span>& spans, const std::vector<int>& cells,
                            const Options& options) {
  const ReferenceElement reference =
      reference_element(options.order, options.order + (options.full_integration ? 1 : 0));
  const BeamModel model = beam_model(spans, cells, reference, options.model == RodModel::kirchhoff);
  if (options.full_integration && is_rigid_somewhere(model)) {
    SteppingResult refused;
    refused.status = scene::Status::unsupported;
    refused.message = "full integration of a rod that does not stretch or shear: use reduced integration";
    return equilibrium(spans, cells, model, std::move(refused), options);
  }
  return equilibrium(spans, cells, model, step_to_full_load(model, stepping_options(options)), options);
}

// Meshes whose tips lie farther apart than this times L are too coarse to trust the order of the error,
constexpr double asymptotic_difference = 1e-3;
// and farther apart than this, to trust anything.
constexpr double distrusted_difference = 0.05;

// Whether an element turns by more than pi/2 from end to end.
bool turns_far(const std::vector<scene::Station>& stations, int order) {
  const auto step = static_cast<std::size_t>(order);
  for (std::size_t i = step; i < stations.size(); i += step) {
    const Eigen::Matrix3d turn = stations[i - step].X_BS.rotation_BS.transpose() * stations[i].X_BS.rotation_BS;
    if (turn.trace() < 1) return true;
  }
  return false;
}

// Error of the tip on `cells` from the tip on another mesh, of half the elements: the error is c h^q with q = 2 order,
// doubled for safety. Where they are too coarse for that, twice the distance of the tips, from twice the elements too;
// L at least where that distance is large or an element turns by more than pi/2: such meshes can agree on what is no
// solution.
double error_estimate_mm(const std::vector<scene::Span>& spans, const std::vector<int>& cells, const Options& options,
                         const scene::Equilibrium& found) {
  const double length_mm = spans.back().end_mm;
  const auto distance_mm = [&](const std::vector<int>& mesh) {
    const scene::Equilibrium other = solve_on(spans, mesh, options);
    if (!other.converged()) return std::numeric_limits<double>::quiet_NaN();
    return (other.tip().position_B_mm - found.tip().position_B_mm).norm();
  };
  std::vector<int> half = cells, twice = cells;
  double ratio = std::numeric_limits<double>::infinity();  // of the element lengths, the least of all spans
  for (std::size_t i = 0; i < cells.size(); ++i) {
    half[i] = (cells[i] + 1) / 2;
    twice[i] = 2 * cells[i];
    ratio = std::min(ratio, static_cast<double>(cells[i]) / half[i]);
  }
  const bool finer = ratio == 1;  // a span of one element cannot be halved
  double difference_mm = distance_mm(finer ? twice : half);
  if (std::isnan(difference_mm)) return difference_mm;
  if (difference_mm <= asymptotic_difference * length_mm) {
    return 2 * difference_mm / std::abs(std::pow(finer ? 0.5 : ratio, 2 * options.order) - 1);
  }
  if (!finer) difference_mm += std::max(0.0, distance_mm(twice) - difference_mm);
  const bool distrusted = difference_mm > distrusted_difference * length_mm || turns_far(found.stations, options.order);
  return distrusted ? std::max(2 * difference_mm, length_mm) : 2 * difference_mm;
}

}  // namespace

scene::Equilibrium solve(const scene::Scene& scene, const Options& options) {
  validate(options);
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  const std::vector<int> cells = scene::cells_per_span(spans, options.elements);
  scene::Equilibrium found = solve_on(spans, cells, options);
  if (found.converged() && options.estimate_error) {
    found.error_estimate_mm = error_estimate_mm(spans, cells, options, found);
  }
  return found;
}

}  // namespace fem_reference
