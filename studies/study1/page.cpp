#include "studies/study1/page.h"

#include "studies/compare/error_measures.h"
#include "studies/compare/printed_statistics.h"
#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

double median(const std::vector<double>& values) {
  return values.empty() ? NAN : quantile(values, 0.5);
}

double largest(const std::vector<double>& values) {
  return values.empty() ? NAN : quantile(values, 1);
}

double mean_absolute(const Study1Data& data, bool planar, const std::string& a, const std::string& b) {
  const std::vector<double> values = differences_mm(data, planar, a, b);
  return values.empty() ? NAN : statistics(values).mean_absolute;
}

double root_mean_square(const Study1Data& data, bool planar, const std::string& a, const std::string& b) {
  const std::vector<double> values = differences_mm(data, planar, a, b);
  return values.empty() ? NAN : statistics(values).root_mean_square;
}

std::string largest_text(const Study1Data& data, const std::string& a, const std::string& b) {
  return for_reader(scientific(largest(distances_mm(data, study1_cases(), "follower", a, b)), 0));
}

// "planar x and spatial z"; "none" of them.
template <class Predicate>
std::string rows_where(Predicate&& holds) {
  std::vector<std::string> names;
  for (const PrintedStatistics& p : printed_statistics()) {
    if (holds(p)) names.push_back(set_and_axis(p));
  }
  if (names.empty()) return "no row";
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

void set_printed(Page& page) {
  page.set("printed_table", printed_table());
  page.set("fits_errors", rows_where([](const auto& p) { return from_errors(p, share_n_minus_1).agrees; }));
  page.set("fits_errors_n", rows_where([](const auto& p) { return from_errors(p, share_n).agrees; }));
  page.set("fits_absolute", rows_where([](const auto& p) { return from_absolute_errors(p, share_n_minus_1).agrees; }));
  page.set("fits_absolute_n", rows_where([](const auto& p) { return from_absolute_errors(p, share_n).agrees; }));
  page.set("below", rows_where(below_mean_absolute));
  page.set("above", rows_where(above_mean_absolute));
  page.set("sd_is_rms",
           rows_where([](const auto& p) { return std::abs(p.absolute_deviation - p.root_mean_square) < 0.01; }));
}

// Least or most of the printed values of a column, as printed.
template <class Member>
std::pair<std::string, std::string> printed_range(Member member, int digits) {
  std::vector<double> values;
  for (const PrintedStatistics& p : printed_statistics()) values.push_back(p.*member);
  return {fixed(quantile(values, 0), digits), fixed(quantile(values, 1), digits)};
}

void set_answer(Page& page, const Study1Data& data) {
  bool solved = true;
  for (const std::string& method : {fam12, sixth12}) {
    solved = solved && distances_mm(data, study1_cases(), "follower", method, "fe").size() == study1_cases().size();
  }
  page.check("solved", solved);
  page.set("mae_planar", fixed(mean_absolute(data, true, fam12, "fe"), 2));
  page.set("mae_spatial", fixed(mean_absolute(data, false, fam12, "fe"), 2));
  page.set("rms_planar", fixed(root_mean_square(data, true, fam12, "fe"), 2));
  page.set("rms_spatial", fixed(root_mean_square(data, false, fam12, "fe"), 2));
  const auto mae = printed_range(&PrintedStatistics::mean_absolute, 2);
  const auto rms = printed_range(&PrintedStatistics::root_mean_square, 2);
  page.set("printed_mae_least", mae.first);
  page.set("printed_mae_most", mae.second);
  page.set("printed_rms_least", rms.first);
  page.set("printed_rms_most", rms.second);
  page.set("sixth_largest", largest_text(data, sixth12, "fe"));
}

// The power of the number of arcs with which the published law's error falls from 12 to 50 arcs.
std::string order_text(const Study1Data& data, bool planar) {
  const double coarse = mean_absolute(data, planar, fam12, "exact_kirchhoff");
  const double fine = mean_absolute(data, planar, "fam_published_50", "exact_kirchhoff");
  return fixed(std::log(coarse / fine) / std::log(50.0 / 12), 1);
}

void set_shear(Page& page, const Study1Data& data, const std::string& name, const std::string& frame) {
  const std::vector<double> distances = distances_mm(data, study1_cases(), frame, "exact_kirchhoff", "exact");
  page.set(name + "_median", fixed(median(distances), 2));
  page.set(name + "_median_percent", fixed(100 * median(distances) / data.length_mm, 2));
  page.set(name + "_most", fixed(largest(distances), 2));
  page.set(name + "_most_percent", fixed(100 * largest(distances) / data.length_mm, 2));
}

void set_split(Page& page, const Study1Data& data) {
  page.set("split_table", split_table(data));
  for (const bool planar : {true, false}) {
    const std::string set = planar ? "planar" : "spatial";
    page.check("law_" + set, mean_absolute(data, planar, fam12, "exact_kirchhoff") >
                                 mean_absolute(data, planar, "exact_kirchhoff", "exact"));
    page.set("order_" + set, order_text(data, planar));
  }
  set_shear(page, data, "shear", "follower");
  set_shear(page, data, "shear_fixed", "fixed");
}

void set_rotation_order(Page& page, const Study1Data& data) {
  const auto of = [&](const std::string& method) {
    return distances_mm(data, study1_cases(false), "follower", method, "fe_kirchhoff");
  };
  page.set("bend_median", fixed(median(of(fam12)), 2));
  page.set("bend_most", fixed(largest(of(fam12)), 2));
  page.set("twist_median", fixed(median(of(fam12_twist_first)), 2));
  page.set("twist_most", fixed(largest(of(fam12_twist_first)), 2));
  int nearer = 0, both = 0;
  for (const std::string& load_case : study1_cases(false)) {
    const auto* bend = difference(data, load_case, "follower", fam12, "fe_kirchhoff");
    const auto* twist = difference(data, load_case, "follower", fam12_twist_first, "fe_kirchhoff");
    if (!bend || !twist) continue;
    ++both;
    nearer += twist->tip_mm.norm() < bend->tip_mm.norm() ? 1 : 0;
  }
  page.set("twist_nearer", fmt::format("{} of {} cases", nearer, both));
}

void set_fixed(Page& page, const Study1Data& data) {
  page.set("fixed_table", fixed_table(data));
  std::size_t solved = 0;
  std::vector<double> apart;
  for (const std::string& load_case : study1_cases()) {
    solved += tip(data, load_case, "fixed", fam12) ? 1 : 0;
    const Study1Tip *dead = tip(data, load_case, "fixed", "exact"),
                    *turning = tip(data, load_case, "follower", "exact");
    if (dead && turning) apart.push_back((dead->position_mm - turning->position_mm).norm());
  }
  page.set("published_fixed", fmt::format("{} of {}", solved, study1_cases().size()));
  page.set("frame_least", fixed(apart.empty() ? NAN : quantile(apart, 0), 2));
  page.set("frame_most", fixed(largest(apart), 2));
  page.set("frame_median", fixed(median(apart), 2));
  page.check("frame_matters", median(apart) > median(distances_mm(data, study1_cases(), "follower", fam12, "fe")));
  page.set("fam_fe_median", fixed(median(distances_mm(data, study1_cases(), "follower", fam12, "fe")), 2));
}

std::string median_time(const Study1Data& data, const std::string& method) {
  return time_text(median(times_us(data, "follower", method)));
}

void set_times(Page& page, const Study1Data& data) {
  page.set_time("time_fam", median_time(data, "fam"));
  page.set_time("time_sixth", median_time(data, sixth12));
  page.set_time("time_fe", median_time(data, "fe"));
  page.set("times_table", times_table(data));
  const double ratio = median(times_us(data, "follower", "fe")) / median(times_us(data, "follower", "fam"));
  page.set_time("fe_over_fam", significant(ratio, 2));
  page.check_time("spread", std::all_of(data.times.begin(), data.times.end(), [](const Study1Time& t) {
                    return t.timing.has_spread() || t.timing.median_us > 1e6 * long_work_s;
                  }));
  page.set_time("machine", machine_line());
}

std::string readme(const Study1Data& data, const std::filesystem::path& page_md) {
  Page page;
  set_answer(page, data);
  page.set("summary_table", summary_table(data));
  set_printed(page);
  set_split(page, data);
  set_rotation_order(page, data);
  page.set("methods_table", methods_table(data));
  set_times(page, data);
  page.set("comparison_table", comparison_table(data));
  set_fixed(page, data);
  return page.fill(page_md);
}

std::string fam_beside_fe(const Study1Data& data) {
  const auto printed = printed_range(&PrintedStatistics::mean_absolute, 2);
  return fmt::format(
      "FAM published, 12 arcs, is off FE by {} mm in the plane and {} mm in space (mean absolute per axis; *printed*: "
      "{} "
      "to {}); FAM sixth order with shear by at most {} mm. `fam solve` takes {}, FE {}",
      fixed(mean_absolute(data, true, fam12, "fe"), 2), fixed(mean_absolute(data, false, fam12, "fe"), 2),
      printed.first, printed.second, largest_text(data, sixth12, "fe"), timed(median_time(data, "fam")),
      timed(median_time(data, "fe")));
}

std::string model(const Study1Data& data) {
  std::vector<double> distances = distances_mm(data, study1_cases(), "follower", "exact_kirchhoff", "exact");
  const std::vector<double> more = distances_mm(data, study1_cases(), "fixed", "exact_kirchhoff", "exact");
  distances.insert(distances.end(), more.begin(), more.end());
  const auto text = [&](double mm) {
    return fmt::format("{} mm ({} % of L)", fixed(mm, 2), fixed(100 * mm / data.length_mm, 2));
  };
  return fmt::format(
      "on a rod of 40 × 6 mm shear and stretch move the tip by {} in the median of {} solves, {} at most",
      text(median(distances)), distances.size(), text(largest(distances)));
}

}  // namespace

std::map<std::string, std::string> study1_files(const Study1Data& data, const std::filesystem::path& page_md) {
  std::map<std::string, std::string> files{
      {"README.md", readme(data, page_md)},
      {"shapes_planar.svg", shapes_picture(data, true)},
      {"shapes_spatial.svg", shapes_picture(data, false)},
      {"errors.svg", errors_picture(data)},
      {"split.svg", split_picture(data)},
      {answers_file, answers_json({{"fam_beside_fe", fam_beside_fe(data)}, {"model", model(data)}})}};
  files.merge(study1_csv(data));
  return files;
}

}  // namespace studies
