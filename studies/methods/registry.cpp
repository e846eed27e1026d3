#include "studies/methods/registry.h"

#include "studies/methods/elastica_method.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/methods/rk4_method.h"

#include <stdexcept>

namespace studies {
namespace {

using Made = std::unique_ptr<Method>;

fam::Options fam_options(const Request& request) {
  fam::Options options;
  options.arcs = request.count;
  options.model = request.model;
  options.estimate_error = request.estimate_error;
  return options;
}

template <fam::Law law>
Made fam_arcs(const MethodRow& row, const Request& request) {
  fam::Options options = fam_options(request);
  options.law = law;
  if (request.twist_first) options.twist_order = fam::TwistOrder::twist_bend;
  if (row.kirchhoff_only) options.model = scene::RodModel::kirchhoff;
  return fam_method(options, request.tolerance);
}

Made fam_automatic(const MethodRow&, const Request& request) {
  return fam_method(fam_options(request), request.tolerance);
}

template <int order>
Made finite_elements(const MethodRow&, const Request& request) {
  fem_reference::Options options;
  if (request.count > 0) options.elements = request.count;
  options.order = order;
  options.model = request.model;
  options.estimate_error = request.estimate_error;
  if (request.most_load_steps > 0) options.max_load_steps = request.most_load_steps;
  if (request.whole_load) {
    options.initial_load_step = 1;
    options.largest_rotation_rad = 3;
  }
  return fem_method(options);
}

Made exact(const MethodRow&, const Request& request) {
  exact_reference::Options options;
  options.model = request.model;
  if (request.tolerance > 0) options.tolerance = request.tolerance;
  return exact_method(options);
}

Made rk4(const MethodRow&, const Request& request) {
  return rk4_method({request.count > 0 ? request.count : 50, request.model != scene::RodModel::kirchhoff});
}

Made closed_form(const MethodRow&, const Request&) {
  return elastica_method();
}

}  // namespace

std::span<const MethodRow> all_methods() {
  using fam::Law;
  static const MethodRow rows[] = {
      {"fam_published",
       "FAM published",
       {colour::orange, ""},
       "arc",
       true,
       "--method fam --law published --arcs ",
       fam_arcs<Law::published>},
      {"fam_midpoint",
       "FAM midpoint",
       {colour::yellow, ""},
       "arc",
       false,
       "--method fam --law midpoint --arcs ",
       fam_arcs<Law::midpoint>},
      {"fam_fourth_order",
       "FAM fourth order",
       {colour::sky, ""},
       "arc",
       false,
       "--method fam --law fourth_order --arcs ",
       fam_arcs<Law::fourth_order>},
      {"fam_sixth_order",
       "FAM sixth order",
       {colour::blue, ""},
       "arc",
       false,
       "--method fam --law sixth_order --arcs ",
       fam_arcs<Law::sixth_order>},
      {"fam", "FAM automatic", {colour::blue, "2 3"}, "", false, "--method fam", fam_automatic},
      {"fe_linear",
       "FE linear",
       {colour::green, "5 3"},
       "element",
       false,
       "--method fem --order 1 --elements ",
       finite_elements<1>},
      {"fe", "FE", {colour::green, ""}, "element", false, "--method fem --order 2 --elements ", finite_elements<2>},
      {"fe_cubic",
       "FE cubic",
       {colour::green, "2 3"},
       "element",
       false,
       "--method fem --order 3 --elements ",
       finite_elements<3>},
      {"rk4", "RK4 shooting", {colour::purple, ""}, "step", false, "--method rk4 --steps ", rk4},
      {"exact", "exact", {colour::black, ""}, "", false, "--method exact", exact},
      {"elastica", "closed form", {colour::grey, "5 3"}, "", true, "--method elastica", closed_form}};
  return rows;
}

const MethodRow& method_row(const std::string& key) {
  for (const MethodRow& row : all_methods()) {
    if (row.key == key) return row;
  }
  throw std::out_of_range("no method has the key " + key);
}

std::string counted(int count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string label(const MethodRow& row, const Request& request) {
  std::string text = row.name;
  if (request.count > 0) text += ", " + counted(request.count, row.counts);
  if (request.model == scene::RodModel::kirchhoff && !row.kirchhoff_only) text += ", Kirchhoff";
  if (request.twist_first) text += ", twist first";
  return text;
}

}  // namespace studies
