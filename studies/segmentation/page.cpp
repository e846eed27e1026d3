#include "studies/report/page.h"
#include "studies/compare/error_measures.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/scenes/cases.h"
#include "studies/segmentation/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

double p4_error(const SegmentationData& data, const std::string& law, int arcs,
                double SweepPoint::*error = &SweepPoint::exact_mm) {
  const SweepPoint* point = data.find("P4", law, arcs);
  return point ? point->*error : NAN;
}

std::string p4_text(const SegmentationData& data, const std::string& law, int arcs) {
  return error_for_reader(std::max(p4_error(data, law, arcs), error_floor_mm));
}

// Whether the published law's error on P4 falls from each number of arcs to the next, up to 10 000.
bool published_falls(const SegmentationData& data) {
  double last = INFINITY;
  for (const SweepPoint& p : data.curve("P4", "published")) {
    if (p.arcs > 10'000) break;
    if (!(p.exact_mm < last)) return false;
    last = p.exact_mm;
  }
  return true;
}

// Of all laws, from the numbers of arcs at which no error of discretisation is left.
double largest_round_off_mm(const SegmentationData& data) {
  double largest = 0;
  for (const char* law : {"fourth_order", "sixth_order"}) {
    for (const SweepPoint& p : data.curve("P4", law)) {
      if (p.arcs >= 1000) largest = std::max(largest, p.exact_mm);
    }
  }
  return largest;
}

std::string range_mm(const SegmentationData& data, double SweepReference::*value) {
  double least = INFINITY, largest = 0;
  for (const SweepReference& r : data.references) {
    least = std::min(least, r.*value), largest = std::max(largest, r.*value);
  }
  return fixed(least, 2) + " to " + fixed(largest, 2);
}

std::string budget_text(const SegmentationData& data, const std::string& law, int arcs) {
  for (const Budget& b : data.budgets) {
    if (b.load == "P4 scaled" && b.law == law && b.arcs == arcs && b.limit_mm == 0.1) {
      return b.beyond ? "beyond " + fixed(budget_load_max, 0) : significant(b.largest_load, 2);
    }
  }
  return "–";
}

// The most arcs that any case takes, of the planar and of the spatial ones.
std::string most_arcs(const SegmentationData& data, const std::string& law, bool planar, double limit_mm) {
  const std::vector<int> arcs = data.fewest_arcs(law, planar, limit_mm);
  const bool all = std::find(arcs.begin(), arcs.end(), 0) == arcs.end();
  return all ? std::to_string(*std::max_element(arcs.begin(), arcs.end())) : fmt::format("> {}", most_arcs_tried);
}

// Of any case.
std::string most_arcs(const SegmentationData& data, const std::string& law, double limit_mm) {
  return std::max(most_arcs(data, law, true, limit_mm), most_arcs(data, law, false, limit_mm),
                  [](const std::string& a, const std::string& b) {
                    return a[0] != '>' && (b[0] == '>' || std::stoi(a) < std::stoi(b));
                  });
}

std::string arcs_text(const std::string& number) {
  return number + (number == "1" ? " arc" : " arcs");
}

// The automatic choice's arcs over the fewest that would do, a number for each case and limit.
std::vector<double> arcs_over_fewest(const SegmentationData& data) {
  std::vector<double> ratios;
  for (const double limit_mm : arc_limits_mm) {
    for (const bool planar : {true, false}) {
      const std::vector<int> taken = data.fewest_arcs("fam", planar, limit_mm);
      const std::vector<int> fewest = data.fewest_arcs("sixth_order", planar, limit_mm);
      for (std::size_t i = 0; i < taken.size(); ++i) {
        if (taken[i] > 0 && fewest[i] > 0) ratios.push_back(static_cast<double>(taken[i]) / fewest[i]);
      }
    }
  }
  return ratios;
}

void set_arcs(Page& page, const SegmentationData& data) {
  page.set("published_plane", arcs_text(most_arcs(data, "published", true, 0.1)));
  page.set("published_space", most_arcs(data, "published", false, 0.1));
  const std::vector<double> ratios = arcs_over_fewest(data);
  page.set("ratio", significant(quantile(ratios, 0.5), 2));
  page.set("ratio_most", significant(*std::max_element(ratios.begin(), ratios.end()), 2));
  page.set("ratios", std::to_string(ratios.size()));
  page.set("sixth_01", arcs_text(most_arcs(data, "sixth_order", 0.1)));
  page.set("sixth_001", arcs_text(most_arcs(data, "sixth_order", 0.01)));
  page.set("sixth_0001", arcs_text(most_arcs(data, "sixth_order", 0.001)));
  page.set("published_budget", budget_text(data, "published", 12));
  page.set("sixth_budget", budget_text(data, "sixth_order", 12));
  page.set("arcs_table", arcs_table(data));
  page.set("automatic_plane", arcs_cell(data, "fam", true, 0.04));
  page.set("automatic_space", arcs_cell(data, "fam", false, 0.04));
}

void set_p4(Page& page, const SegmentationData& data) {
  const exact_reference::PlanarCantilever& p4 = data.p4;
  page.set("length", fmt::format("{:g}", p4.length_mm));
  page.set("EI", fixed(p4.bending_stiffness_Nmm2, 0));
  page.set("force", for_reader(fmt::format("({:g}, {:g}, 0)", p4.tip_force_N[0], p4.tip_force_N[1])));
  page.set("moment", for_reader(fmt::format("{:g}", p4.tip_moment_Nmm)));
  page.set("load", significant(p4.tip_force_N.norm() * p4.length_mm * p4.length_mm / p4.bending_stiffness_Nmm2, 2));
  for (const int arcs : {1, 12, 500, 5000}) page.set(fmt::format("p{}", arcs), p4_text(data, "published", arcs));
  page.set("published_order",
           observed_order(100, p4_error(data, "published", 100), 500, p4_error(data, "published", 500)));
  page.check("falls", published_falls(data));
  page.check("stays", largest_round_off_mm(data) < 1e-9);
  page.set("round_off", error_for_reader(std::max(largest_round_off_mm(data), error_floor_mm)));
  const SweepReference& reference = data.reference("P4");
  const double fe_500 = p4_error(data, "published", 500, &SweepPoint::fe_mm);
  page.set("shear", error_for_reader(reference.shear_mm));
  page.set("fe_500", error_for_reader(fe_500));
  page.check("levels", std::abs(fe_500 / reference.shear_mm - 1) < 0.02);
  page.set("sweep", sweep_table(data));
  page.set("shear_range", range_mm(data, &SweepReference::shear_mm));
  page.set("frame_range", range_mm(data, &SweepReference::frame_mm));
}

void set_times(Page& page, const SegmentationData& data) {
  std::vector<double> solve_us, published_ns, sixth_ns;
  for (const SweepTime& t : data.times) {
    if (t.law == "fam") solve_us.push_back(t.timing.median_us);
    if (t.arcs != 1000) continue;
    if (t.law == "published") published_ns.push_back(t.timing.median_us);
    if (t.law == "sixth_order") sixth_ns.push_back(t.timing.median_us);
  }
  page.set_time("machine", machine_line());
  page.set_time("times", times_table(data));
  page.set_time("solve", time_text(quantile(solve_us, 0.5)));
  page.set_time("solve_range", time_text(*std::min_element(solve_us.begin(), solve_us.end())) + " to " +
                                   time_text(*std::max_element(solve_us.begin(), solve_us.end())));
  page.set("solve_cases", std::to_string(solve_us.size()));
  page.set_time("published_ns", fixed(quantile(published_ns, 0.5), 0));
  page.set_time("sixth_ns", fixed(quantile(sixth_ns, 0.5), 0));
}

std::string answer(const SegmentationData& data) {
  const auto most = [&](const std::string& law, bool planar) { return most_arcs(data, law, planar, 0.1); };
  return fmt::format(
      "None: `fam solve` chooses. For a tip within 0.1 mm of 40 on each of 16 cases FAM sixth order needs {} in a "
      "plane and "
      "{} in space, FAM published {} and {}. {}",
      most("sixth_order", true), most("sixth_order", false), most("published", true), most("published", false),
      published_falls(data) ? "The *printed* minimum at 12 and rise beyond 500 do not appear in sound arithmetic"
                            : "The error of FAM published does not fall at every number of arcs");
}

}  // namespace

std::map<std::string, std::string> segmentation_pages(const SegmentationData& data,
                                                      const std::filesystem::path& page_md) {
  Page page;
  set_arcs(page, data);
  set_p4(page, data);
  set_times(page, data);
  return {{"README.md", page.fill(page_md)}, {answers_file, answers_json({{"how_many_arcs", answer(data)}})}};
}

}  // namespace studies
