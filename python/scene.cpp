// Scenes and estimation problems from Python: any of them becomes JSON text, which the one reader of the format reads.
#include "convert.h"

#include "scene/estimation_file.h"
#include "scene/scene_file.h"

#include <charconv>
#include <cmath>
#include <sstream>

namespace fam_python {
namespace {

constexpr std::size_t max_depth = 20;  // more than the reader takes; a list may hold itself

// Writes a value as JSON; knows where it is, to say so.
class JsonWriter {
 public:
  // name: of the whole, in errors.
  explicit JsonWriter(const char* name) : name_(name) {}

  std::string take(py::handle value) {
    write(value);
    return std::move(json_);
  }

 private:
  [[noreturn]] void refuse(py::handle value, const std::string& rule) const {
    std::string path;
    for (const std::string& step : path_) path += path.empty() && step[0] == '.' ? step.substr(1) : step;
    fam_python::refuse(std::string(name_) + ": " + (path.empty() ? "(top level)" : path), value, rule);
  }

  void write(py::handle value) {
    PyObject* object = value.ptr();
    if (PyDict_Check(object)) write_dict(py::reinterpret_borrow<py::dict>(value));
    else if (PyUnicode_Check(object)) write_text(value);
    else if (object == Py_None) json_ += "null";
    else if (PyBool_Check(object)) json_ += object == Py_True ? "true" : "false";
    else if (PyFloat_Check(object)) write_number(value);
    else if (PyLong_Check(object)) json_ += py::str(value).cast<std::string>();
    else if (py::isinstance<py::array>(value)) write(value.attr("tolist")());
    else if (PyList_Check(object) || PyTuple_Check(object)) write_list(value);
    else if (PyNumber_Check(object) && !PyComplex_Check(object)) write_number(value);  // numpy's float32, int64, ...
    else refuse(value, "must be a dict, a list, a number or text");
  }

  void enter(std::string step, py::handle value) {
    path_.push_back(std::move(step));
    if (path_.size() > max_depth) refuse(value, "nested too deeply for a scene");
  }

  void write_dict(const py::dict& dict) {
    json_ += '{';
    bool first = true;
    for (const auto& [key, value] : dict) {
      if (!PyUnicode_Check(key.ptr())) refuse(key, "a key must be text");
      json_ += first ? "" : ",";
      first = false;
      write_text(key);
      json_ += ':';
      enter("." + key.cast<std::string>(), value);
      write(value);
      path_.pop_back();
    }
    json_ += '}';
  }

  void write_list(py::handle list) {
    json_ += '[';
    std::size_t index = 0;
    for (const py::handle value : list) {
      json_ += index > 0 ? "," : "";
      enter("[" + std::to_string(index++) + "]", value);
      write(value);
      path_.pop_back();
    }
    json_ += ']';
  }

  void write_number(py::handle number) {
    const double value = PyFloat_AsDouble(number.ptr());
    if (PyErr_Occurred()) {
      PyErr_Clear();
      refuse(number, "must be a number");
    }
    if (!std::isfinite(value)) refuse(number, "must be finite");
    char buffer[32];
    json_.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  }

  void write_text(py::handle text) {
    const char* utf8 = PyUnicode_AsUTF8(text.ptr());
    if (!utf8) {
      PyErr_Clear();
      refuse(text, "is not Unicode");
    }
    json_ += '"';
    for (; *utf8 != 0; ++utf8) {
      const auto byte = static_cast<unsigned char>(*utf8);
      if (byte == '"' || byte == '\\') json_ += '\\';
      if (byte >= ' ') json_ += *utf8;
      else json_ += {'\\', 'u', '0', '0', "0123456789abcdef"[byte / 16], "0123456789abcdef"[byte % 16]};
    }
    json_ += '"';
  }

  const char* name_;
  std::string json_;
  std::vector<std::string> path_;
};

// read: of a stream with its name for errors; read_file: of a path.
template <class Read, class ReadFile>
auto read_any(py::handle value, const char* name, const Read& read, const ReadFile& read_file) {
  const auto read_text = [&](const std::string& json) {
    std::istringstream input(json);
    return read(input, name);
  };
  if (py::isinstance<py::str>(value)) {
    const std::string text = value.cast<std::string>();
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool is_json = first != std::string::npos && (text[first] == '{' || text[first] == '[');
    return is_json ? read_text(text) : read_file(text);
  }
  if (py::hasattr(value, "__fspath__")) return read_file(py::str(value.attr("__fspath__")()).cast<std::string>());
  if (!py::isinstance<py::dict>(value))
    refuse(std::string(name) + ": (top level)", value, "must be a dict, JSON text or a path");
  return read_text(JsonWriter(name).take(value));
}

}  // namespace

scene::Scene scene_of(py::handle scene) {
  return read_any(scene, "scene", scene::read_scene, scene::read_scene_file);
}

scene::EstimationProblem problem_of(py::handle problem) {
  return read_any(problem, "problem", scene::read_estimation, scene::read_estimation_file);
}

}  // namespace fam_python
