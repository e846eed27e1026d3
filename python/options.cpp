#include "convert.h"

#include <cmath>
#include <map>

namespace fam_python {
namespace {

// Of a few names, in their order.
template <class Value>
Value chosen(const char* keyword, py::handle name, const std::vector<std::pair<std::string, Value>>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (PyUnicode_Check(name.ptr()) && PyUnicode_CompareWithASCIIString(name.ptr(), names[i].first.c_str()) == 0)
      return names[i].second;
    all += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i].first;
  }
  refuse(keyword, name, "must be " + all);
}

std::vector<std::pair<std::string, fam::Law>> laws() {
  std::vector<std::pair<std::string, fam::Law>> names{{fam::name(fam::Law::automatic), fam::Law::automatic}};
  for (const fam::Law law : fam::all_laws()) names.emplace_back(fam::name(law), law);
  return names;
}

}  // namespace

fam::Options options_of(const Keywords& keywords) {
  fam::Options options;
  if (!keywords.tolerance_mm.is_none()) {
    const double tolerance_mm = PyFloat_AsDouble(keywords.tolerance_mm.ptr());
    const bool is_number = !PyErr_Occurred();
    PyErr_Clear();
    if (!is_number || !std::isfinite(tolerance_mm) || tolerance_mm <= 0)
      refuse("tolerance_mm", keywords.tolerance_mm, "must be a number > 0");
    options.tolerance_mm = tolerance_mm;
  }
  if (!keywords.arcs.is_none()) {
    const long arcs = PyLong_Check(keywords.arcs.ptr()) || PyIndex_Check(keywords.arcs.ptr())
                          ? PyNumber_AsSsize_t(keywords.arcs.ptr(), nullptr)
                          : 0;
    if (arcs < 1 || arcs > fam::max_arcs)
      refuse("arcs", keywords.arcs, "must be a whole number, 1 to " + std::to_string(fam::max_arcs));
    if (!keywords.tolerance_mm.is_none()) refuse("arcs", keywords.arcs, "excludes tolerance_mm");
    options.arcs = static_cast<int>(arcs);
  }
  static const auto all_laws = laws();
  options.law = chosen("law", keywords.law, all_laws);
  options.model = chosen<fam::RodModel>("model", keywords.model,
                                        {{"auto", fam::RodModel::automatic},
                                         {"kirchhoff", fam::RodModel::kirchhoff},
                                         {"reissner", fam::RodModel::reissner}});
  return options;
}

}  // namespace fam_python
