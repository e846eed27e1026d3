// fam.solve_batch and fam.BatchResult.
#include "convert.h"

#include "scene/load_visitor.h"

#include <cstring>

namespace fam_python {
namespace {

using fam::BatchColumn;
using fam::BatchResult;

// (0, "x"), (2, "tension").
std::vector<BatchColumn> columns_of(py::handle columns, const scene::Scene& scene) {
  const char* rule = "must be a list of (load, 'x', 'y', 'z' or 'tension')";
  if (!PySequence_Check(columns.ptr()) || PyUnicode_Check(columns.ptr())) refuse("columns", columns, rule);
  std::vector<BatchColumn> named;
  for (const py::handle column : columns) {
    const std::string path = "columns[" + std::to_string(named.size()) + "]";
    const auto pair = py::reinterpret_steal<py::object>(PySequence_Tuple(column.ptr()));
    PyErr_Clear();
    if (!pair || PyTuple_GET_SIZE(pair.ptr()) != 2 || !PyIndex_Check(PyTuple_GET_ITEM(pair.ptr(), 0)))
      refuse(path, column, rule);
    const py::handle load = PyTuple_GET_ITEM(pair.ptr(), 0), component = PyTuple_GET_ITEM(pair.ptr(), 1);
    const py::ssize_t index = PyNumber_AsSsize_t(load.ptr(), nullptr);
    const std::size_t loads = scene.loads.size();
    if (index < 0 || static_cast<std::size_t>(index) >= loads)
      refuse(path + ".load", load, "must name one of the scene's " + std::to_string(loads) + " loads, counted from 0");
    const bool of_tendon = scene::tendon_of(scene.loads[static_cast<std::size_t>(index)]) != nullptr;
    const int number = component_named(component, of_tendon);
    if (number < 0) {
      const std::string kind = scene::kind_name(scene.loads[static_cast<std::size_t>(index)]);
      refuse(path + ".component", component,
             of_tendon ? "must be 'tension', of a tendon" : "must be 'x', 'y' or 'z', of a " + kind);
    }
    named.push_back({static_cast<std::size_t>(index), number});
  }
  return named;
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

BatchResult solve_batch(py::handle scene, py::handle columns, py::handle values, py::object tolerance_mm,
                        py::object arcs, bool estimate, py::object law, py::object model, int threads) {
  const scene::Scene read = scene_of(scene);
  fam::Options options = options_of({tolerance_mm, arcs, law, model});
  options.estimate_error = estimate;
  if (threads < 0) refuse("threads", py::int_(threads), "must be >= 0");
  options.threads = threads;
  const std::vector<BatchColumn> named = columns_of(columns, read);
  const auto given = py::array::ensure(values);
  const bool has_numbers = given && std::strchr("biufO", given.dtype().kind());  // not complex ones, dates, texts
  const auto numbers = has_numbers ? Numbers::ensure(given) : Numbers();  // as it is where C-contiguous and float64
  if (!has_numbers || !numbers || numbers.ndim() != 2) refuse("values", values, "must be an array of numbers, (rods, columns)");
  const Eigen::Map<const fam::RowMajorMatrix> rows(numbers.data(), numbers.shape(0), numbers.shape(1));
  const py::gil_scoped_release others_run;
  return fam::solve_batch(read, named, rows, options);
}

py::list status_of(const BatchResult& result) {
  py::list names(result.status.size());
  for (std::size_t k = 0; k < result.status.size(); ++k) {
    PyObject* name = PyUnicode_InternFromString(scene::name(result.status[k]));
    if (!name) throw py::error_already_set();
    PyList_SET_ITEM(names.ptr(), static_cast<py::ssize_t>(k), name);
  }
  return names;
}

template <class Matrix>
py::array rows_of(py::handle owner, const Matrix& matrix) {
  return view(matrix.data(), {matrix.rows(), matrix.cols()},
              {matrix.cols() * static_cast<py::ssize_t>(sizeof(double)), sizeof(double)}, owner);
}

}  // namespace

void add_batch(py::module_& module) {
  py::class_<BatchResult>(module, "BatchResult", R"(What fam.solve_batch gives: a row for each row of its values.

The numbers of a row that did not converge are NaN. Arrays are read-only views.)")
      .def_property_readonly(
          "position_mm", [](py::object self) { return rows_of(self, self.cast<const BatchResult&>().position_mm); },
          "(n, 3), mm: of the tip, base frame")
      .def_property_readonly(
          "rotation_wxyz", [](py::object self) { return rows_of(self, self.cast<const BatchResult&>().rotation_wxyz); },
          "(n, 4): unit quaternions w x y z, w >= 0, of the tip's section frame in the base frame")
      .def_property_readonly("status", &status_of, "list of n str: 'converged', or why not")
      .def_property_readonly(
          "error_estimate_mm",
          [](py::object self) {
            const Eigen::VectorXd& error_mm = self.cast<const BatchResult&>().error_estimate_mm;
            return view(error_mm.data(), {error_mm.size()}, {sizeof(double)}, self);
          },
          "(n,), mm: of any position along the rod; 0 where no estimate was asked for");

  module.def(
      "solve_batch", &solve_batch, py::arg("scene"), py::arg("columns"), py::arg("values"),
      py::arg("tolerance_mm") = py::none(), py::arg("arcs") = py::none(), py::arg("estimate") = true,
      py::arg("law") = "auto", py::arg("model") = "auto", py::arg("threads") = 1,
      R"(solve_batch(scene, columns, values, tolerance_mm=None, arcs=None, estimate=True, law='auto', model='auto', threads=1) -> BatchResult

Solves one scene for many values of its loads.

columns: which number of the scene each column of values replaces: (load, 'x' | 'y' | 'z'), of a tendon (load, 'tension').
values: (n, columns), N, N mm, N/mm or m/s^2 as the load has it; a C-contiguous float64 array is not copied.
estimate=False leaves the error estimates out. threads: that share the rows; 0: as many as the machine runs at once.
Else as fam.solve.

Each row is a cold solve, whatever the order of the rows. A row whose error estimate exceeds the tolerance has
'tolerance_not_met'. Raises SceneError on wrong input. Other threads run meanwhile.)");
}

}  // namespace fam_python
