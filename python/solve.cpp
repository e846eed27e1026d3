// fam.solve and fam.Equilibrium.
#include "convert.h"

#include <fmt/format.h>

#include <limits>

namespace fam_python {
namespace {

using scene::Equilibrium;
using scene::Station;

// A view of one field of all stations.
py::array over_stations(py::handle owner, const double Station::*scalar) {
  const auto& stations = owner.cast<const Equilibrium&>().stations;
  const double* first = stations.empty() ? nullptr : &(stations[0].*scalar);
  return view(first, {static_cast<py::ssize_t>(stations.size())}, {sizeof(Station)}, owner);
}

py::array over_stations(py::handle owner, const Eigen::Vector3d& (*vector)(const Station&)) {
  const auto& stations = owner.cast<const Equilibrium&>().stations;
  const double* first = stations.empty() ? nullptr : vector(stations[0]).data();
  return view(first, {static_cast<py::ssize_t>(stations.size()), 3}, {sizeof(Station), sizeof(double)}, owner);
}

py::array rotations(py::handle owner) {
  const auto& stations = owner.cast<const Equilibrium&>().stations;
  const double* first = stations.empty() ? nullptr : stations[0].X_BS.rotation_BS.data();
  return view(first, {static_cast<py::ssize_t>(stations.size()), 3, 3},
              {sizeof(Station), sizeof(double), 3 * sizeof(double)}, owner);  // Eigen's matrices go column by column
}

const double nan = std::numeric_limits<double>::quiet_NaN();

// A field of the clamp or the tip, NaN where there is none.
template <class Get>
auto at_end(Get get) {
  return [get](const Equilibrium& result) {
    using Value = std::remove_cvref_t<decltype(get(result))>;
    return array_of(result.converged() ? get(result) : Value(Value::Constant(nan)));
  };
}

py::dict model_of(const Equilibrium& result) {
  py::dict model;
  for (const auto& [key, value] : result.model)
    std::visit([&, &name = key](const auto& v) { model[py::str(name)] = py::cast(v); }, value);
  return model;
}

py::object stable_of(const Equilibrium& result) {
  return result.stable ? py::object(py::bool_(*result.stable)) : py::none();
}

std::string described(const Equilibrium& result) {
  if (!result.converged()) return fmt::format("<fam.Equilibrium {}: {}>", scene::name(result.status), result.message);
  const Eigen::Vector3d& tip_mm = result.tip().position_B_mm;
  return fmt::format("<fam.Equilibrium converged: tip at ({:.6g}, {:.6g}, {:.6g}) mm>", tip_mm[0], tip_mm[1],
                     tip_mm[2]);
}

Equilibrium solve(py::handle scene, py::object tolerance_mm, py::object arcs, py::object law, py::object model) {
  const scene::Scene read = scene_of(scene);
  const fam::Options options = options_of({tolerance_mm, arcs, law, model});
  const py::gil_scoped_release others_run;
  return fam::solve(read, options);
}

}  // namespace

void add_solve(py::module_& module) {
  using Class = py::class_<Equilibrium>;
  Class(module, "Equilibrium", R"(Static equilibrium of a scene, as fam.solve gives it.

Arrays along the rod go from clamp to tip and are read-only views; base frame. Only a converged one has a shape:
else those arrays are empty and the values at tip and clamp NaN.)")
      .def_property_readonly(
          "status", [](const Equilibrium& e) { return scene::name(e.status); }, "'converged', or why not (str)")
      .def_property_readonly("converged", &Equilibrium::converged, "bool")
      .def_readonly("message", &Equilibrium::message, "One line, why not converged; empty when converged (str)")
      .def_property_readonly("stable", &stable_of,
                             "Whether the rod would stay; None: not decided, or the loads have no energy")
      .def_property_readonly(
          "error_estimate_mm", [](const Equilibrium& e) { return e.converged() ? e.error_estimate_mm : nan; },
          "Of the position of any station, mm")
      .def_property_readonly("model", &model_of, "What was solved and how (dict: law, arcs, planar, ..., reason)")
      .def_property_readonly("tip_position_mm", at_end([](const Equilibrium& e) { return e.tip().position_B_mm; }),
                             "(3,), mm")
      .def_property_readonly("tip_rotation", at_end([](const Equilibrium& e) { return e.tip().rotation_BS; }),
                             "(3, 3): the section's axes in its columns")
      .def_property_readonly(
          "tip_angle_rad", [](const Equilibrium& e) { return e.converged() ? e.tip_angle_rad : nan; },
          "The tip's turn, rad: about the plane's normal with full turns counted, in space 0 to pi")
      .def_property_readonly("base_force_N", at_end([](const Equilibrium& e) { return e.base().force_B_N; }),
                             "(3,), N: the rod's own internal force at the clamp")
      .def_property_readonly("base_moment_Nmm", at_end([](const Equilibrium& e) { return e.base().moment_B_Nmm; }),
                             "(3,), N mm: the rod's own internal moment at the clamp")
      .def_property_readonly(
          "tendon_shortening_mm",
          [](const Equilibrium& e) {
            return py::array_t<double>(static_cast<py::ssize_t>(e.tendon_shortening_mm.size()),
                                       e.tendon_shortening_mm.data());
          },
          "(tendons,), mm: how much of each leaves through the clamp")
      .def_property_readonly(
          "s_mm", [](py::object self) { return over_stations(self, &Station::s_mm); },
          "(n,), mm: arc lengths of the stations, clamp to tip")
      .def_property_readonly(
          "position_mm",
          [](py::object self) {
            return over_stations(self,
                                 [](const Station& at) -> const Eigen::Vector3d& { return at.X_BS.position_B_mm; });
          },
          "(n, 3), mm")
      .def_property_readonly("rotation", &rotations, "(n, 3, 3): the section's axes in the columns")
      .def_property_readonly(
          "force_N",
          [](py::object self) {
            return over_stations(self, [](const Station& at) -> const Eigen::Vector3d& { return at.force_B_N; });
          },
          "(n, 3), N: the rod's own internal force, base frame; at a load that towards the clamp")
      .def_property_readonly(
          "moment_Nmm",
          [](py::object self) {
            return over_stations(self, [](const Station& at) -> const Eigen::Vector3d& { return at.moment_B_Nmm; });
          },
          "(n, 3), N mm: the rod's own internal moment, base frame; at a load that towards the clamp")
      .def("__repr__", &described);

  module.def("solve", &solve, py::arg("scene"), py::arg("tolerance_mm") = py::none(), py::arg("arcs") = py::none(),
             py::arg("law") = "auto", py::arg("model") = "auto",
             R"(solve(scene, tolerance_mm=None, arcs=None, law='auto', model='auto') -> Equilibrium

Solves one scene: a dict in the scene format, its JSON text, or the path of a scene file.

tolerance_mm: largest error of any place along the rod, mm (None: 1e-3 of the length); arcs in its place: their number.
law: 'auto', 'published', 'midpoint', 'fourth_order' or 'sixth_order'; model: 'auto', 'kirchhoff' or 'reissner'.

Raises SceneError on wrong input. A solve that fails does not raise: its `converged` is False, `status` says why.)");
}

}  // namespace fam_python
