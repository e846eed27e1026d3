// Scenes and estimation problems from Python: any of them becomes JSON text, which the one reader of the format reads.
#include "convert.h"

#include "scene/estimation_file.h"
#include "scene/scene_file.h"

#include <charconv>
#include <cmath>
#include <cstring>
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

// After space and a byte order mark a bracket.
bool is_json(py::handle text) {
  const Py_ssize_t length = PyUnicode_GET_LENGTH(text.ptr());
  for (Py_ssize_t i = 0; i < length; ++i) {
    const Py_UCS4 character = PyUnicode_READ_CHAR(text.ptr(), i);
    const bool is_mark = i == 0 && character == 0xFEFF;
    if (!is_mark && !std::strchr(" \t\r\n", static_cast<int>(character < 128 ? character : 'x')))
      return character == '{' || character == '[';
  }
  return false;
}

// As os.fsencode has it: a name need not be Unicode.
std::string file_name(py::handle path, const std::string& where) {
  PyObject* bytes = nullptr;
  if (!PyUnicode_FSConverter(path.ptr(), &bytes)) {
    PyErr_Clear();
    refuse(where, path, "is neither JSON text nor the name of a file");
  }
  return py::reinterpret_steal<py::bytes>(bytes);
}

// read: of a stream with its name for errors; read_file: of a path.
template <class Read, class ReadFile>
auto read_any(py::handle value, const char* name, const Read& read, const ReadFile& read_file) {
  const std::string where = std::string(name) + ": (top level)";
  const auto read_text = [&](const std::string& json) {
    std::istringstream input(json);
    return read(input, name);
  };
  const bool is_text = py::isinstance<py::str>(value);
  if (is_text && is_json(value)) {
    Py_ssize_t size = 0;
    const char* utf8 = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
    if (utf8) return read_text({utf8, static_cast<std::size_t>(size)});
    PyErr_Clear();
    refuse(where, value, "is not Unicode");
  }
  if (is_text || py::hasattr(value, "__fspath__")) return read_file(file_name(value, where));
  if (!py::isinstance<py::dict>(value)) refuse(where, value, "must be a dict, JSON text or a path");
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
