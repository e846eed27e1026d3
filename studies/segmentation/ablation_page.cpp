#include "studies/report/page.h"
#include "studies/report/table.h"
#include "studies/segmentation/ablation.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

const std::string sound = "sound: double, root of dPi/dtheta";

std::string digit(double value) {
  return for_reader(one_digit(value));
}

Trend exact_trend(const AblationRow& row) {
  return trend(row, &AblationPoint::error_mm);
}

bool has_all(const Trend& t) {
  return t.minimum_near_12() && t.under_3_mm() && t.rises();
}

// Variants whose curve against the exact rod has all of what is printed.
std::string names_with_all(const AblationData& data) {
  std::string list;
  for (const AblationRow& row : data.rows) {
    if (has_all(exact_trend(row))) list += (list.empty() ? "*" : "; *") + row.name + "*";
  }
  return list.empty() ? "none" : list;
}

struct Count {
  int rising = 0, all = 0;
  std::string text() const { return std::to_string(rising) + " of " + std::to_string(all); }
};

// How many of the variants that are wanted rise beyond 500.
template <class Wanted>
Count rising(const AblationData& data, const Wanted& wanted) {
  Count count;
  for (const AblationRow& row : data.rows) {
    if (!wanted(row.weakness)) continue;
    ++count.all;
    count.rising += exact_trend(row).rises();
  }
  return count;
}

bool only_brackets_have_all(const AblationData& data) {
  bool any = false, only = true;
  for (const AblationRow& row : data.rows) {
    if (!has_all(exact_trend(row))) continue;
    any = true;
    only = only && stops_at_a_bracket(row.weakness);
  }
  return any && only;
}

void set_findings(Page& page, const AblationData& data, double fixed_frame_mm) {
  page.set("all", names_with_all(data));
  page.check("brackets", only_brackets_have_all(data) && !exact_trend(data.row(sound)).rises());
  page.set("golden_exact", std::to_string(data.censuses[0].all_three));
  page.set("golden_fe", std::to_string(data.censuses[1].all_three));
  page.set("bisection_exact", std::to_string(data.censuses[2].all_three));
  page.set("bisection_fe", std::to_string(data.censuses[3].all_three));
  page.set("curves", std::to_string(data.censuses[0].curves));
  const Count brackets = rising(data, [](const Weakness& w) { return stops_at_a_bracket(w); });
  const Count single = rising(data, [](const Weakness& w) { return w.single_precision && w.tolerance == 0; });
  const Count others = rising(data, [](const Weakness& w) { return !w.single_precision && !stops_at_a_bracket(w); });
  page.set("brackets_rising", brackets.text());
  page.set("single_rising", single.text());
  page.set("others_rising", others.text());
  const double single_mm = data.point("single precision", 5000).error_mm;
  page.set("single_5000", digit(single_mm));
  page.check("no_plateau", single_mm < 0.1);
  const auto next = [&](int arcs) { return data.point("force not turned to the next arc", arcs).error_mm; };
  page.set("next_12", digit(next(12)));
  page.set("next_500", digit(next(500)));
  page.check("next_settles", next(12) > 1 && next(500) > 1 && next(5000) < 2 * next(500));
  page.set("frame", fixed(fixed_frame_mm, 1));
  const double fe_12 = data.point(sound, 12).fe_mm, fe_500 = data.point(sound, 500).fe_mm;
  page.set("fe_sound", digit(fe_500));
  page.check("plateau", fe_500 < 3 && std::abs(fe_12 / fe_500 - 1) < 0.1);
}

void set_mechanism(Page& page, const AblationData& data) {
  const AblationPoint& bracket = data.point("golden section 1e-03", 5000);
  page.set("arc_angle", digit(data.tip_angle_rad / 5000));
  page.set("relative_5000", digit(bracket.largest_relative));
  page.set("bias_500", digit(data.point("golden section 1e-03", 500).bias_rad));
  page.set("bias_5000", digit(bracket.bias_rad));
  page.check("bias", std::abs(bracket.bias_rad) > 3 * bracket.scatter_rad);
  const AblationPoint& single = data.point("single precision", 5000);
  const double by_drift_mm = data.tip_angle_rad * data.length_mm / 2 * std::abs(single.drift);
  for (const int arcs : {12, 500, 5000}) {
    page.set("drift_" + std::to_string(arcs), digit(data.point("single precision", arcs).drift));
    page.set("in_arc_" + std::to_string(arcs), digit(data.point("force not turned in the arc", arcs).error_mm));
  }
  bool in_arc_larger = true;
  for (const int arcs : {12, 500, 5000}) {
    const double sound_mm = data.point(sound, arcs).error_mm;
    page.set("sound_" + std::to_string(arcs), digit(sound_mm));
    in_arc_larger = in_arc_larger && data.point("force not turned in the arc", arcs).error_mm > 2 * sound_mm;
  }
  page.check("in_arc_larger", in_arc_larger && !exact_trend(data.row("force not turned in the arc")).rises());
  page.set("by_drift", digit(by_drift_mm));
  page.set("tip_angle", fixed(data.tip_angle_rad, 1));
  page.check("drift_explains", by_drift_mm > single.error_mm / 3 && by_drift_mm < 3 * single.error_mm);
  const double coarse = data.point("golden section", 12).largest_relative;
  const double fine = data.point("golden section", 5000).largest_relative;
  page.check("same_relative", fine < 3 * coarse && coarse < 3 * fine);
  page.set("minimiser_relative", digit(fine));
  page.set("expanded_500", digit(data.point("single, golden, expanded Pi", 500).error_mm));
  page.check("expanded_does_not_rise", !exact_trend(data.row("single, golden, expanded Pi")).rises());
  page.set("cancelled", digit(data.cancellations.back().single_precision));
  page.set("unsafe_sums", digit(data.point("single, unsafe", 5000).sums_mm));
  page.set("safe_sums", digit(data.point("single precision", 5000).sums_mm));
}

}  // namespace

std::map<std::string, std::string> ablation_files(const AblationData& data, double fixed_frame_mm,
                                                  const std::filesystem::path& page_md) {
  Page page;
  set_findings(page, data, fixed_frame_mm);
  set_mechanism(page, data);
  page.set("trends", trend_table(data));
  page.set("tolerances", tolerance_table(data));
  page.set("census", census_table(data));
  page.set("mechanism", mechanism_table(data));
  std::map<std::string, std::string> files = ablation_tables(data);
  files["ablation.md"] = page.fill(page_md);
  files["ablation.svg"] = ablation_picture(data);
  return files;
}

}  // namespace studies
