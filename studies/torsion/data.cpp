#include "studies/torsion/data.h"

#include "studies/report/table.h"

#include <algorithm>
#include <stdexcept>

namespace studies {

const std::vector<TorsionLaw>& torsion_laws() {
  static const std::vector<TorsionLaw> laws = {{"bend_twist", method_row("fam_published"), false},
                                               {"twist_bend", method_row("fam_published"), true},
                                               {"midpoint", method_row("fam_midpoint"), false},
                                               {"fourth_order", method_row("fam_fourth_order"), false},
                                               {"sixth_order", method_row("fam_sixth_order"), false}};
  return laws;
}

Request TorsionLaw::with(int arcs) const {
  Request request;
  request.count = arcs;
  request.model = scene::RodModel::kirchhoff;
  request.estimate_error = false;
  request.twist_first = twist_first;
  return request;
}

std::string TorsionLaw::label(int arcs) const {
  Request request;
  request.count = arcs;
  request.twist_first = twist_first;
  return studies::label(row, request);
}

const TorsionTip& TorsionData::tip(double torque_Nmm, const std::string& method) const {
  const auto found = std::find_if(
      tips.begin(), tips.end(), [&](const TorsionTip& t) { return t.torque_Nmm == torque_Nmm && t.method == method; });
  if (found == tips.end()) throw std::logic_error("no tip of " + method);
  return *found;
}

std::string TorsionData::order_of(double torque_Nmm, const std::string& law) const {
  std::string order = "–";
  const TorsionOrder* last = nullptr;
  for (const TorsionOrder& o : orders) {
    if (o.torque_Nmm != torque_Nmm || o.law != law) continue;
    const std::string here = last ? observed_order(last->arcs, last->own_mm, o.arcs, o.own_mm) : "–";
    if (here != "–") order = here;
    last = &o;
  }
  return order;
}

int TorsionData::fewest_arcs(double torque_Nmm, const std::string& law, double limit_mm) const {
  for (const TorsionArcs& a : arcs) {
    if (a.torque_Nmm == torque_Nmm && a.law == law && a.limit_mm == limit_mm) return a.arcs;
  }
  throw std::logic_error("no number of arcs for " + law);
}

const Timing& TorsionData::time(const std::string& scene, const std::string& law, int count) const {
  const auto found = std::find_if(times.begin(), times.end(), [&](const TorsionTime& t) {
    return t.scene == scene && t.law == law && t.arcs == count;
  });
  if (found == times.end()) throw std::logic_error("no time of " + law + " on " + scene);
  return found->timing;
}

}  // namespace studies
