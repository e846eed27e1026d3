// Between Python's values and the library's. Whatever does not fit is a scene::SceneError of one line.
#pragma once

#include "fam/estimator.h"
#include "fam/solver.h"

#include <pybind11/numpy.h>

#include <span>
#include <string>

namespace fam_python {

namespace py = pybind11;

[[noreturn]] void refuse(const std::string& path, py::handle value, const std::string& rule);
// The value as Python writes it, on one line of printable ASCII, cut where it is long.
std::string shown(py::handle value);

// A dict in the scene format (numpy's arrays and numbers welcome), its JSON text, or the path of a scene file.
scene::Scene scene_of(py::handle scene);
// The same of the estimation format.
scene::EstimationProblem problem_of(py::handle problem);

// The keyword arguments of the same names; None: the default.
struct Keywords {
  py::object tolerance_mm, arcs, law, model;
};
fam::Options options_of(const Keywords& keywords);

// Three numbers: a numpy array, a list, a tuple. Of `scene: list[index].field` in the message.
Eigen::Vector3d vector_of(py::handle value, const char* list, py::ssize_t index, const char* field);
double number_of(py::handle value, const char* list, py::ssize_t index, const char* field);

// 0, 1, 2 of "x", "y", "z"; 0 of "tension", which a tendon has, and only a tendon; else -1.
int component_named(py::handle name, bool of_tendon);

// A copy, C-contiguous.
template <class Matrix>
py::array_t<double> array_of(const Eigen::MatrixBase<Matrix>& matrix) {
  constexpr bool is_vector = Matrix::ColsAtCompileTime == 1;
  py::array_t<double> array =
      is_vector ? py::array_t<double>(matrix.rows()) : py::array_t<double>({matrix.rows(), matrix.cols()});
  double* to = array.mutable_data();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) *to++ = matrix(row, column);
  }
  return array;
}

// A read-only view of memory that `owner` keeps; strides in bytes.
py::array view(const double* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides, py::handle owner);

void add_solve(py::module_& module);
void add_solver(py::module_& module);
void add_batch(py::module_& module);
void add_estimator(py::module_& module);

}  // namespace fam_python
