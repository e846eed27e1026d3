// The slopes of a kept solver's solution: (6, columns), named in fam.pyi.
#include "kept_solver.h"

#include <array>
#include <stdexcept>

namespace fam_python {
namespace {

using fam::Parameter;
using fam::Solver;

// NaN in C++.
template <class Matrix>
const Matrix& told(const Matrix& slopes) {
  if (!slopes.hasNaN()) return slopes;
  throw std::runtime_error(
      "no derivatives: the published law has none, and others take more arcs for small changes than reserved_arcs");
}

template <auto get>
auto compliance(KeptSolver& kept, double s_mm) {
  return array_of(told((kept.solved().*get)(kept.on_rod(s_mm))));
}

template <auto get>
py::array by_load(KeptSolver& kept, py::ssize_t load, double s_mm) {
  const Solver& solver = kept.solved();
  const std::size_t index = kept.load(load);
  const Solver::Matrix63 slopes = told((solver.*get)(index, kept.on_rod(s_mm)));
  if (!kept.is_tendon(index)) return array_of(slopes);
  return array_of(slopes.col(0)).reshape({6, 1});
}

template <auto get>
auto by_section(KeptSolver& kept, py::ssize_t section, double s_mm) {
  const Solver& solver = kept.solved();
  const std::size_t index = kept.section(section);
  return array_of(told((solver.*get)(index, kept.on_rod(s_mm))));
}

template <auto get>
auto by_place(KeptSolver& kept, py::ssize_t load, double s_mm) {
  const Solver& solver = kept.solved();
  const std::size_t index = kept.point_load(load);
  return array_of(told((solver.*get)(index, kept.on_rod(s_mm))));
}

[[noreturn]] void refuse_parameter(std::size_t at, py::handle parameter, const std::string& rule) {
  throw py::value_error("parameters[" + std::to_string(at) + "] = " + shown(parameter) + ": " + rule);
}

// ("load", 0, "x"), ("load", 2, "tension"), ("rest_curvature", 0, "z"), ("stiffness", 1, "GJ"), ("place", 0).
Parameter parameter_of(const KeptSolver& kept, std::size_t at, py::handle parameter) {
  const char* rule =
      "must be ('load', i, 'x', 'y', 'z' or 'tension'), ('rest_curvature', i, 'x', 'y' or 'z'), "
      "('stiffness', i, 'GJ', 'EI_y' or 'EI_z') or ('place', i)";
  if (!PyTuple_Check(parameter.ptr()) && !PyList_Check(parameter.ptr())) refuse_parameter(at, parameter, rule);
  const auto parts = py::reinterpret_borrow<py::sequence>(parameter);
  const std::size_t size = parts.size();
  if (size < 2 || size > 3 || !py::isinstance<py::str>(parts[0]) || !PyIndex_Check(py::object(parts[1]).ptr()))
    refuse_parameter(at, parameter, rule);
  const std::string kind = py::object(parts[0]).cast<std::string>();
  const auto index = py::object(parts[1]).cast<py::ssize_t>();
  if (kind == "place" && size == 2) return {Parameter::Kind::place, kept.point_load(index)};
  if (size != 3) refuse_parameter(at, parameter, rule);
  const py::object name = parts[2];
  if (kind == "load") {
    const std::size_t load = kept.load(index);
    const int component = component_named(name, kept.is_tendon(load));
    if (component < 0)
      refuse_parameter(at, parameter,
                       kept.is_tendon(load) ? "loads[" + std::to_string(load) + "] has a 'tension'"
                                            : "loads[" + std::to_string(load) + "] has 'x', 'y', 'z'");
    return {Parameter::Kind::load, load, component};
  }
  if (kind == "rest_curvature" && component_named(name, false) >= 0)
    return {Parameter::Kind::rest_curvature, kept.section(index), component_named(name, false)};
  constexpr std::array<const char*, 3> stiffnesses{"GJ", "EI_y", "EI_z"};
  for (int component = 0; component < 3 && kind == "stiffness"; ++component) {
    if (name.equal(py::str(stiffnesses[static_cast<std::size_t>(component)])))
      return {Parameter::Kind::stiffness, kept.section(index), component};
  }
  refuse_parameter(at, parameter, rule);
}

py::array jacobian(KeptSolver& kept, py::array_t<double, py::array::c_style | py::array::forcecast> s_mm,
                   const py::sequence& parameters) {
  const Solver& solver = kept.solved();
  if (s_mm.ndim() > 1) throw py::value_error("s_mm: must be a place or a list of places, mm");
  std::vector<double> places(s_mm.data(), s_mm.data() + s_mm.size());
  for (double& place : places) place = kept.on_rod(place);
  std::vector<Parameter> columns;
  for (const py::handle parameter : parameters) columns.push_back(parameter_of(kept, columns.size(), parameter));

  const auto rows = static_cast<py::ssize_t>(6 * places.size()), count = static_cast<py::ssize_t>(columns.size());
  py::array_t<double, py::array::f_style> result({rows, count});
  Eigen::Map<Eigen::MatrixXd> slopes(result.mutable_data(), rows, count);
  solver.jacobian(places, columns, slopes);
  told(slopes);
  return result;
}

}  // namespace

// What one quantity's slopes are named and say.
#define FAM_SLOPES(prefix, of)                                                                                        \
  solver                                                                                                              \
      .def(#prefix "compliance", &compliance<&Solver::prefix##compliance>, py::arg("s_mm"),                           \
           #prefix "compliance(s_mm) -> (6, 6)\n\n" of " by a small fixed force (N), then moment (N mm), at the tip") \
      .def(#prefix "by_load", &by_load<&Solver::prefix##by_load>, py::arg("load"), py::arg("s_mm"),                   \
           #prefix "by_load(load, s_mm) -> (6, 3); of a tendon (6, 1)\n\n" of " by the load's value, or tension")     \
      .def(#prefix "by_rest_curvature", &by_section<&Solver::prefix##by_rest_curvature>, py::arg("section"),          \
           py::arg("s_mm"),                                                                                           \
           #prefix "by_rest_curvature(section, s_mm) -> (6, 3)\n\n" of " by torsion, bending about y, z (1/mm)")      \
      .def(#prefix "by_stiffness", &by_section<&Solver::prefix##by_stiffness>, py::arg("section"), py::arg("s_mm"),   \
           #prefix "by_stiffness(section, s_mm) -> (6, 3)\n\n" of " by GJ, EI_y, EI_z (N mm^2)")                      \
      .def(#prefix "by_place", &by_place<&Solver::prefix##by_place>, py::arg("load"), py::arg("s_mm"),                \
           #prefix "by_place(load, s_mm) -> (6,)\n\n" of " by where a force or a moment acts (mm)")

void add_derivatives(py::class_<KeptSolver>& solver) {
  FAM_SLOPES(, "Slopes of the pose at s (position, mm; rotation, rad: dR R^T = [d rotation]x; base frame)");
  FAM_SLOPES(strain_, "Slopes of the strains at s (u, 1/mm; v; section frame)");
  FAM_SLOPES(wrench_, "Slopes of the rod's own wrench at s (force, N; moment, N mm; base frame)");
  solver.def("jacobian", &jacobian, py::arg("s_mm"), py::arg("parameters"),
             R"(jacobian(s_mm, parameters) -> (6 n, m)

Slopes of the poses at n places: six rows for each, a column for each parameter: ('load', i, 'x' | 'y' | 'z'),
('load', i, 'tension'), ('rest_curvature', i, 'x' | 'y' | 'z'), ('stiffness', i, 'GJ' | 'EI_y' | 'EI_z'), ('place', i).)");
}

}  // namespace fam_python
