// fam.Solver and fam.Outcome.
#include "kept_solver.h"

#include <fmt/format.h>

namespace fam_python {
namespace {

using fam::Solver;

struct Outcome {
  scene::Status status;
  int load_steps, newton_steps;
  std::string message;
};

int whole_number(const char* name, py::handle value, int least, int most) {
  const py::ssize_t number = PyIndex_Check(value.ptr()) ? PyNumber_AsSsize_t(value.ptr(), nullptr) : least - 1;
  if (number < least || number > most)
    refuse(name, value, "must be a whole number, " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(number);
}

std::unique_ptr<KeptSolver> make(py::handle scene, py::object tolerance_mm, py::object arcs, py::object law,
                                 py::object model, py::handle reserved_arcs) {
  const scene::Scene read = scene_of(scene);
  fam::Options options = options_of({tolerance_mm, arcs, law, model});
  options.reserved_arcs = whole_number("reserved_arcs", reserved_arcs, 1, fam::max_arcs);
  return std::make_unique<KeptSolver>(read, options);
}

Outcome solve_kept(KeptSolver& kept, py::handle start, py::handle newton_steps_at_most) {
  const auto is = [&](const char* name) {
    return PyUnicode_Check(start.ptr()) && PyUnicode_CompareWithASCIIString(start.ptr(), name) == 0;
  };
  if (!is("last") && !is("unloaded")) refuse("start", start, "must be 'last' or 'unloaded'");
  const Solver::Start from = is("last") ? Solver::Start::last_solution : Solver::Start::unloaded;
  const int most = whole_number("newton_steps_at_most", newton_steps_at_most, 0, fam::most_newton_steps);
  const Solver::Outcome outcome = kept.alone([=](Solver& solver) { return solver.solve(from, most); });
  return {outcome.status, outcome.load_steps, outcome.newton_steps, outcome.message};
}

// One of the set_... of a load's vector.
template <auto set>
auto vector_setter(const char* field) {
  return [field](KeptSolver& kept, py::ssize_t load, py::handle value) {
    Solver& solver = kept.use();
    (solver.*set)(kept.load_to_set(load), vector_of(value, "loads", load, field));
  };
}

template <auto set>
auto number_setter(const char* field) {
  return [field](KeptSolver& kept, py::ssize_t load, py::handle value) {
    Solver& solver = kept.use();
    (solver.*set)(kept.load_to_set(load), number_of(value, "loads", load, field));
  };
}

// A copy of a vector of each item.
template <class Items, class Get>
py::array_t<double> rows_of(const Items& items, Get get) {
  py::array_t<double> rows({static_cast<py::ssize_t>(items.size()), py::ssize_t{3}});
  double* to = rows.mutable_data();
  for (const auto& item : items) {
    for (const double component : get(item)) *to++ = component;
  }
  return rows;
}

py::array_t<double> rotations(const KeptSolver&, std::span<const scene::Pose> poses) {
  py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), py::ssize_t{3}, py::ssize_t{3}});
  double* to = array.mutable_data();
  for (const scene::Pose& pose : poses) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) *to++ = pose.rotation_BS(row, column);
    }
  }
  return array;
}

void add_outcome(py::module_& module) {
  py::class_<Outcome>(module, "Outcome", "How a Solver.solve ended.")
      .def_property_readonly(
          "status", [](const Outcome& o) { return scene::name(o.status); }, "'converged', or why not (str)")
      .def_property_readonly(
          "converged", [](const Outcome& o) { return o.status == scene::Status::converged; }, "bool")
      .def_readonly("load_steps", &Outcome::load_steps, "int")
      .def_readonly("newton_steps", &Outcome::newton_steps, "int")
      .def_readonly("message", &Outcome::message, "One line; empty when converged (str)")
      .def("__repr__", [](const Outcome& o) {
        return o.message.empty() ? fmt::format("<fam.Outcome {}>", scene::name(o.status))
                                 : fmt::format("<fam.Outcome {}: {}>", scene::name(o.status), o.message);
      });
}

void add_setters(py::class_<KeptSolver>& solver) {
  const auto vector = [&]<auto set>(const char* name, const char* field, const char* words) {
    solver.def(name, vector_setter<set>(field), py::arg("load"), py::arg("value"), words);
  };
  vector.operator()<&Solver::set_force_N>("set_force_N", ".value_N",
                                          "set_force_N(load, value)\n\nvalue: (3,), N, of a force, in its frame");
  vector.operator()<&Solver::set_moment_Nmm>(
      "set_moment_Nmm", ".value_Nmm", "set_moment_Nmm(load, value)\n\nvalue: (3,), N mm, of a moment, in its frame");
  vector.operator()<&Solver::set_distributed_N_per_mm>(
      "set_distributed_N_per_mm", ".value_N_per_mm",
      "set_distributed_N_per_mm(load, value)\n\nvalue: (3,), N/mm, of a distributed force, in its frame");
  vector.operator()<&Solver::set_acceleration_m_per_s2>(
      "set_acceleration_m_per_s2", ".acceleration_m_per_s2",
      "set_acceleration_m_per_s2(load, value)\n\nvalue: (3,), m/s^2, of gravity, base frame");
  solver
      .def("set_tension_N", number_setter<&Solver::set_tension_N>(".tension_N"), py::arg("load"), py::arg("value"),
           "set_tension_N(load, value)\n\nvalue: N, >= 0, of a tendon")
      .def("set_at_mm", number_setter<&Solver::set_at_mm>(".at"), py::arg("load"), py::arg("value"),
           "set_at_mm(load, value)\n\nvalue: mm from the clamp, where a force or a moment acts from now on")
      .def(
          "set_rest_curvature_per_mm",
          [](KeptSolver& kept, py::ssize_t section, py::handle value) {
            kept.use().set_rest_curvature_per_mm(kept.section_to_set(section),
                                                 vector_of(value, "rod.sections", section, ".rest_curvature_per_mm"));
          },
          py::arg("section"), py::arg("value"),
          "set_rest_curvature_per_mm(section, value)\n\nvalue: (3,), 1/mm: torsion, bending about y, about z")
      .def(
          "set_stiffness_Nmm2",
          [](KeptSolver& kept, py::ssize_t section, py::handle value) {
            kept.use().set_stiffness_Nmm2(kept.section_to_set(section),
                                          vector_of(value, "rod.sections", section, ".stiffness"));
          },
          py::arg("section"), py::arg("value"),
          "set_stiffness_Nmm2(section, value)\n\nvalue: (3,), N mm^2: GJ, EI_y, EI_z");
}

void add_shape(py::class_<KeptSolver>& solver) {
  solver
      .def_property_readonly(
          "tip_position_mm", [](KeptSolver& kept) { return array_of(kept.solved().tip().position_B_mm); },
          "(3,), mm, base frame")
      .def_property_readonly(
          "tip_rotation", [](KeptSolver& kept) { return array_of(kept.solved().tip().rotation_BS); },
          "(3, 3): the section's axes in its columns, base frame")
      .def_property_readonly(
          "base_force_N", [](KeptSolver& kept) { return array_of(kept.solved().base_wrench_B().force_N); },
          "(3,), N: the rod's own internal force at the clamp, base frame")
      .def_property_readonly(
          "base_moment_Nmm", [](KeptSolver& kept) { return array_of(kept.solved().base_wrench_B().moment_Nmm); },
          "(3,), N mm: the rod's own internal moment at the clamp, base frame")
      .def_property_readonly(
          "s_mm",
          [](KeptSolver& kept) {
            const std::span<const double> s_mm = kept.solved().s_mm();
            return py::array_t<double>(static_cast<py::ssize_t>(s_mm.size()), s_mm.data());
          },
          "(n,), mm: the arcs' ends, clamp to tip. A copy, as all arrays of a Solver")
      .def_property_readonly(
          "position_mm",
          [](KeptSolver& kept) {
            return rows_of(kept.solved().poses(), [](const scene::Pose& pose) { return pose.position_B_mm; });
          },
          "(n, 3), mm, base frame")
      .def_property_readonly(
          "rotation", [](KeptSolver& kept) { return rotations(kept, kept.solved().poses()); },
          "(n, 3, 3): the section's axes in the columns, base frame")
      .def_property_readonly(
          "force_N",
          [](KeptSolver& kept) {
            return rows_of(kept.solved().wrenches_B(), [](const scene::Wrench& wrench) { return wrench.force_N; });
          },
          "(n, 3), N: the rod's own internal force, base frame")
      .def_property_readonly(
          "moment_Nmm",
          [](KeptSolver& kept) {
            return rows_of(kept.solved().wrenches_B(), [](const scene::Wrench& wrench) { return wrench.moment_Nmm; });
          },
          "(n, 3), N mm: the rod's own internal moment, base frame")
      .def(
          "pose_at",
          [](KeptSolver& kept, double s_mm) {
            const scene::Pose pose = kept.solved().pose_at(kept.on_rod(s_mm));
            return py::make_tuple(array_of(pose.position_B_mm), array_of(pose.rotation_BS));
          },
          py::arg("s_mm"), "pose_at(s_mm) -> (position, rotation)\n\n(3,), mm, and (3, 3), anywhere along the rod")
      .def(
          "wrench_at",
          [](KeptSolver& kept, double s_mm) {
            const scene::Wrench wrench = kept.solved().wrench_at(kept.on_rod(s_mm));
            return py::make_tuple(array_of(wrench.force_N), array_of(wrench.moment_Nmm));
          },
          py::arg("s_mm"), "wrench_at(s_mm) -> (force, moment)\n\n(3,), N, and (3,), N mm: the rod's own, base frame");
}

}  // namespace

void add_solver(py::module_& module) {
  add_outcome(module);
  py::class_<KeptSolver> solver(module, "Solver", R"(One rod, solved again and again as its loads change.

Solver(scene, tolerance_mm=None, arcs=None, law='auto', model='auto', reserved_arcs=1024); as fam.solve.
reserved_arcs: memory is taken for so many, those of the error estimate included, and for no more later.

set_... give new values and raise SceneError on wrong ones, which leaves the solver as it was. Getters speak of the
solution found last; before there is one they raise RuntimeError, off the rod ValueError, of a load or section that
is not there IndexError. One solver only in one thread at a time; others run while it solves.)");
  solver
      .def(py::init(&make), py::arg("scene"), py::arg("tolerance_mm") = py::none(), py::arg("arcs") = py::none(),
           py::arg("law") = "auto", py::arg("model") = "auto", py::arg("reserved_arcs") = fam::Options().reserved_arcs)
      .def("solve", &solve_kept, py::arg("start") = "last",
           py::arg("newton_steps_at_most") = fam::most_newton_steps,
           R"(solve(start='last', newton_steps_at_most=3000) -> Outcome

'last': on from the loads solved last, along the straight line between, on their branch; 'unloaded': the equilibrium that
the rod reaches when all loads grow together from zero. Unless it converges the last solution stays.
newton_steps_at_most: while loads grow; more end it in work_limit.)")
      .def_property_readonly(
          "solved", [](KeptSolver& kept) { return kept.use().solved(); }, "bool: there is a solution")
      .def(
          "error_estimate_mm",
          [](KeptSolver& kept) {
            kept.solved();
            return kept.alone([](Solver& of) { return of.error_estimate_mm(); });
          },
          "error_estimate_mm() -> float\n\nOf any position along the rod, mm: solves at a second resolution")
      .def_property_readonly(
          "stable",
          [](KeptSolver& kept) {
            const std::optional<bool> stable = kept.solved().stable();
            return stable ? py::object(py::bool_(*stable)) : py::none();
          },
          "Whether the rod would stay; None: not decided, or the loads have no energy");
  add_setters(solver);
  add_shape(solver);
  add_derivatives(solver);
}

}  // namespace fam_python
