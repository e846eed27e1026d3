#include "studies/study1/data.h"

#include <stdexcept>

namespace studies {
namespace {

// The record of a list that `matches`, or null.
template <class Record, class Predicate>
const Record* find(const std::vector<Record>& records, Predicate&& matches) {
  for (const Record& record : records) {
    if (matches(record)) return &record;
  }
  return nullptr;
}

constexpr auto kirchhoff = scene::RodModel::kirchhoff;
constexpr auto reissner = scene::RodModel::reissner;

Study1Group first_group() {
  return {{{"exact", "exact", {}},
           {"exact_kirchhoff", "exact", {.model = kirchhoff}},
           {"fam_fourth_order_50", "fam_fourth_order", {.count = 50, .model = kirchhoff}},
           {"fam_fourth_order_50_reissner", "fam_fourth_order", {.count = 50, .model = reissner}},
           {fam12, "fam_published", {.count = 12}},
           {fam12_twist_first, "fam_published", {.count = 12, .twist_first = true}},
           {"fam_published_50", "fam_published", {.count = 50}},
           {"fam_sixth_order_12", "fam_sixth_order", {.count = 12, .model = kirchhoff}},
           {"fe", "fe", {.model = reissner}},
           {"fe_kirchhoff", "fe", {.model = kirchhoff}}},
          {{fam12, "fe"},
           {fam12_twist_first, "fe"},
           {"fam_published_50", "fe"},
           {fam12, "fe_kirchhoff"},
           {fam12_twist_first, "fe_kirchhoff"},
           {"fam_published_50", "fe_kirchhoff"},
           {"fam_fourth_order_50", "fe_kirchhoff"},
           {"fam_fourth_order_50_reissner", "fe"},
           {"fe_kirchhoff", "fe"},
           {fam12, "exact_kirchhoff"},
           {fam12_twist_first, "exact_kirchhoff"},
           {"fam_sixth_order_12", "fe_kirchhoff"},
           {"fam_sixth_order_12", "exact_kirchhoff"},
           {"fam_fourth_order_50_reissner", "exact"},
           {"exact_kirchhoff", "exact"},
           {"exact", "fe"}}};
}

// With shear, as a user of `fam solve` has it; and more pairs with the exact solution.
Study1Group second_group() {
  return {{{"fam", "fam", {}}, {sixth12, "fam_sixth_order", {.count = 12, .model = reissner}}},
          {{"fam", "fe"},
           {sixth12, "fe"},
           {"fam", "exact"},
           {sixth12, "exact"},
           {fam12, "exact"},
           {"fam_published_50", "exact"},
           {"fam_published_50", "exact_kirchhoff"}}};
}

}  // namespace

const std::vector<Study1Group>& study1_groups() {
  static const std::vector<Study1Group> groups = {first_group(), second_group()};
  return groups;
}

const Study1Method& study1_method(const std::string& key) {
  for (const Study1Group& group : study1_groups()) {
    if (const auto* method = find(group.methods, [&](const Study1Method& m) { return m.key == key; })) return *method;
  }
  throw std::out_of_range("Study I has no method " + key);
}

std::string study1_label(const std::string& key) {
  const Study1Method& method = study1_method(key);
  return label(method_row(method.row), method.request);
}

const Study1Tip* tip(const Study1Data& data, const std::string& load_case, const std::string& frame,
                     const std::string& method) {
  return find(data.tips, [&](const Study1Tip& t) {
    return t.load_case == load_case && t.frame == frame && t.method == method && t.status == "converged";
  });
}

const Study1Difference* difference(const Study1Data& data, const std::string& load_case, const std::string& frame,
                                   const std::string& a, const std::string& b) {
  return find(data.differences, [&](const Study1Difference& d) {
    return d.load_case == load_case && d.frame == frame && d.a == a && d.b == b;
  });
}

std::vector<double> distances_mm(const Study1Data& data, const std::vector<std::string>& cases,
                                 const std::string& frame, const std::string& a, const std::string& b) {
  std::vector<double> values;
  for (const std::string& load_case : cases) {
    if (const auto* d = difference(data, load_case, frame, a, b)) values.push_back(d->tip_mm.norm());
  }
  return values;
}

std::vector<double> differences_mm(const Study1Data& data, bool planar, const std::string& a, const std::string& b) {
  std::vector<double> values;
  for (const std::string& load_case : study1_cases(planar)) {
    const auto* d = difference(data, load_case, "follower", a, b);
    for (int axis = 0; d && axis < (planar ? 2 : 3); ++axis) values.push_back(d->tip_mm[axis]);
  }
  return values;
}

std::vector<double> times_us(const Study1Data& data, const std::string& frame, const std::string& method) {
  std::vector<double> times;
  for (const Study1Time& t : data.times) {
    if (t.frame == frame && t.method == method) times.push_back(t.timing.median_us);
  }
  return times;
}

}  // namespace studies
