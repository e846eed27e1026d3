#include "studies/segmentation/data.h"

#include "studies/scenes/cases.h"

#include <algorithm>
#include <stdexcept>

namespace studies {

const std::vector<SweepLaw>& sweep_laws() {
  using fam::Law;
  using scene::RodModel;
  static const std::vector<SweepLaw> laws = {
      {"published", method_row("fam_published"), Law::published, RodModel::kirchhoff},
      {"midpoint", method_row("fam_midpoint"), Law::midpoint, RodModel::kirchhoff},
      {"fourth_order", method_row("fam_fourth_order"), Law::fourth_order, RodModel::kirchhoff},
      {"fourth_order_reissner", method_row("fam_fourth_order"), Law::fourth_order, RodModel::reissner},
      {"sixth_order", method_row("fam_sixth_order"), Law::sixth_order, RodModel::kirchhoff}};
  return laws;
}

const SweepLaw& sweep_law(const std::string& key) {
  const auto found =
      std::find_if(sweep_laws().begin(), sweep_laws().end(), [&](const SweepLaw& law) { return law.key == key; });
  if (found == sweep_laws().end()) throw std::logic_error("no law " + key);
  return *found;
}

std::vector<SweepLaw> kirchhoff_laws() {
  std::vector<SweepLaw> laws;
  for (const SweepLaw& law : sweep_laws()) {
    if (!law.shears()) laws.push_back(law);
  }
  return laws;
}

Request SweepLaw::with(int arcs) const {
  Request request;
  request.count = arcs;
  request.model = model;
  request.estimate_error = false;
  return request;
}

std::string SweepLaw::label() const {
  return row.name + (shears() ? ", with shear" : "");
}

const SweepPoint* SegmentationData::find(const std::string& load_case, const std::string& law, int arcs) const {
  const auto found = std::find_if(points.begin(), points.end(), [&](const SweepPoint& p) {
    return p.load_case == load_case && p.law == law && p.arcs == arcs;
  });
  return found == points.end() ? nullptr : &*found;
}

const SweepReference& SegmentationData::reference(const std::string& load_case) const {
  const auto found = std::find_if(references.begin(), references.end(),
                                  [&](const SweepReference& r) { return r.load_case == load_case; });
  if (found == references.end()) throw std::logic_error("no reference for " + load_case);
  return *found;
}

std::vector<SweepPoint> SegmentationData::curve(const std::string& load_case, const std::string& law) const {
  std::vector<SweepPoint> list;
  std::copy_if(points.begin(), points.end(), std::back_inserter(list),
               [&](const SweepPoint& p) { return p.load_case == load_case && p.law == law; });
  return list;
}

std::vector<int> SegmentationData::fewest_arcs(const std::string& law, bool planar, double limit_mm) const {
  std::vector<int> list;
  for (const FewestArcs& f : fewest) {
    if (f.law == law && f.limit_mm == limit_mm && is_planar(f.load_case) == planar) list.push_back(f.arcs);
  }
  return list;
}

}  // namespace studies
