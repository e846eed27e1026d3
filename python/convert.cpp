#include "convert.h"

#include <cmath>

namespace fam_python {
namespace {

std::string place(const char* list, py::ssize_t index, const char* field) {
  return std::string("scene: ") + list + "[" + std::to_string(index) + "]" + field;
}

// False: not a number.
bool to_double(PyObject* object, double& value) {
  value = PyFloat_CheckExact(object) ? PyFloat_AS_DOUBLE(object) : PyFloat_AsDouble(object);
  if (value != -1 || !PyErr_Occurred()) return true;
  PyErr_Clear();
  return false;
}

bool is_text(py::handle value) {
  return PyUnicode_Check(value.ptr()) || PyBytes_Check(value.ptr());
}

// A numpy array of three doubles that can be read as it is: the quick way, for calls that are made often.
bool is_array_of_3(py::handle value) {
  if (!py::isinstance<py::array>(value)) return false;
  const auto* array = py::detail::array_proxy(value.ptr());
  const auto* kind = py::detail::array_descriptor_proxy(array->descr);
  return array->nd == 1 && array->dimensions[0] == 3 && kind->type_num == py::detail::npy_api::NPY_DOUBLE_ &&
         kind->byteorder == '=' && (array->flags & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

// Any sequence; false: not three numbers.
bool to_vector(py::handle value, Eigen::Vector3d& vector) {
  if (is_text(value)) return false;
  const auto items = py::reinterpret_steal<py::object>(PySequence_Fast(value.ptr(), ""));
  if (!items) {
    PyErr_Clear();
    return false;
  }
  if (PySequence_Fast_GET_SIZE(items.ptr()) != 3) return false;
  for (int i = 0; i < 3; ++i) {
    PyObject* item = PySequence_Fast_GET_ITEM(items.ptr(), i);
    if (is_text(item) || !to_double(item, vector[i])) return false;
  }
  return true;
}

}  // namespace

std::string shown(py::handle value) {
  const auto text = py::reinterpret_steal<py::object>(PyObject_ASCII(value.ptr()));
  if (!text) {
    PyErr_Clear();
    return "(unprintable)";
  }
  std::string line;
  for (const char c : text.cast<std::string>()) {
    if (line.size() >= 80) return line + "...";
    const bool blank = c == '\n' || c == ' ';
    if (!blank || !line.ends_with(' ')) line += blank ? ' ' : c;
  }
  return line;
}

void refuse(const std::string& path, py::handle value, const std::string& rule) {
  throw scene::SceneError(path + " = " + shown(value) + ": " + rule);
}

Eigen::Vector3d vector_of(py::handle value, const char* list, py::ssize_t index, const char* field) {
  Eigen::Vector3d vector;
  if (is_array_of_3(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    for (int i = 0; i < 3; ++i) vector[i] = *static_cast<const double*>(array.data(i));
    return vector;
  }
  if (to_vector(value, vector)) return vector;
  refuse(place(list, index, field), value, "must be an array of 3 numbers");
}

double number_of(py::handle value, const char* list, py::ssize_t index, const char* field) {
  double number = 0;
  if (!is_text(value) && to_double(value.ptr(), number)) return number;
  refuse(place(list, index, field), value, "must be a number");
}

int component_named(py::handle name, bool of_tendon) {
  if (!PyUnicode_Check(name.ptr())) return -1;
  const auto is = [&](const char* other) { return PyUnicode_CompareWithASCIIString(name.ptr(), other) == 0; };
  if (of_tendon) return is("tension") ? 0 : -1;
  return is("x") ? 0 : is("y") ? 1 : is("z") ? 2 : -1;
}

py::array view(const double* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides, py::handle owner) {
  py::array array(py::dtype::of<double>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

}  // namespace fam_python
