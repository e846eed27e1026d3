#include "kept_solver.h"

#include "scene/load_visitor.h"

#include <fmt/format.h>

#include <algorithm>

namespace fam_python {
namespace {

fam::Solver made(const scene::Scene& scene, const fam::Options& options) {
  std::variant<fam::Solver, fam::Refusal> result = fam::Solver::make(scene, options);
  if (auto* solver = std::get_if<fam::Solver>(&result)) return std::move(*solver);
  const fam::Refusal& refusal = std::get<fam::Refusal>(result);
  throw std::runtime_error(fmt::format("{}: {}", scene::name(refusal.status), refusal.message));
}

}  // namespace

KeptSolver::KeptSolver(const scene::Scene& scene, const fam::Options& options)
    : solver_(made(scene, options)),
      length_mm_(scene::length_mm(scene)),
      loads_(static_cast<py::ssize_t>(scene.loads.size())),
      sections_(static_cast<py::ssize_t>(scene.sections.size())) {}

bool KeptSolver::is_tendon(std::size_t load) const {
  return scene::tendon_of(solver_.scene().loads[load]) != nullptr;
}

std::size_t KeptSolver::point_load(py::ssize_t index) const {
  const std::size_t i = load(index);
  const scene::Load& load = solver_.scene().loads[i];
  const bool at_a_point = scene::visit_load(
      load, [](const scene::Force&) { return true; }, [](const scene::Moment&) { return true; },
      [](const scene::DistributedForce&) { return false; }, [](const scene::Gravity&) { return false; },
      [](const scene::Tendon&) { return false; });
  if (!at_a_point)
    throw py::value_error(fmt::format("loads[{}] is a {}: no force or moment at a place", i, scene::kind_name(load)));
  return i;
}

double KeptSolver::on_rod(double s_mm) const {
  const double slack_mm = scene::same_place_relative * length_mm_;
  if (!(s_mm >= -slack_mm && s_mm <= length_mm_ + slack_mm))
    throw py::value_error(fmt::format("s_mm = {}: must lie on the rod, 0 <= s <= {} mm", s_mm, length_mm_));
  return std::clamp(s_mm, 0.0, length_mm_);
}

std::size_t KeptSolver::not_negative(py::ssize_t index, py::ssize_t count, const char* list, const char* what) {
  if (index < 0) throw scene::SceneError(fmt::format("scene: {}[{}]: there are {} {}", list, index, count, what));
  return static_cast<std::size_t>(index);
}

std::size_t KeptSolver::index_below(py::ssize_t index, py::ssize_t count, const char* what) {
  if (index < 0 || index >= count)
    throw py::index_error(fmt::format("{} {}: the scene has {}, counted from 0", what, index, count));
  return static_cast<std::size_t>(index);
}

void KeptSolver::raise_busy() {
  throw std::runtime_error("the solver is solving in another thread: one solver a thread");
}

void KeptSolver::raise_not_solved() {
  throw std::runtime_error("nothing is solved yet: call solve(), and see that it converged");
}

}  // namespace fam_python
