#include "studies/study1/data.h"

namespace studies {

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

const std::vector<std::pair<std::string, std::string>>& study1_pairs() {
  static const std::vector<std::pair<std::string, std::string>> pairs = {{fam12, "fe"},
                                                                         {fam12 + "_twist_bend", "fe"},
                                                                         {"fam_published_50", "fe"},
                                                                         {fam12, "fe_kirchhoff"},
                                                                         {fam12 + "_twist_bend", "fe_kirchhoff"},
                                                                         {"fam_published_50", "fe_kirchhoff"},
                                                                         {"fam_fourth_order_50", "fe_kirchhoff"},
                                                                         {"fam_fourth_order_50_reissner", "fe"},
                                                                         {"fe_kirchhoff", "fe"},
                                                                         {fam12, "exact_kirchhoff"},
                                                                         {fam12 + "_twist_bend", "exact_kirchhoff"},
                                                                         {"fam_sixth_order_12", "fe_kirchhoff"},
                                                                         {"fam_sixth_order_12", "exact_kirchhoff"},
                                                                         {"fam_fourth_order_50_reissner", "exact"},
                                                                         {"exact_kirchhoff", "exact"},
                                                                         {"exact", "fe"}};
  return pairs;
}

}  // namespace studies
