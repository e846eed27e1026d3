#include "studies/fe_verification/data.h"

#include "studies/compare/error_measures.h"
#include "studies/report/page.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace studies {
namespace {

std::string scientific_text(double value) {
  return for_reader(scientific(value, 1));
}

// Of the scenes on which both the finite elements and the exact reference converged.
struct OwnErrors {
  std::size_t scenes = 0;
  std::vector<double> errors, errors_mm, kirchhoff, estimate_over_error;
  std::string worst;

  double largest() const { return quantile(errors, 1); }
};

OwnErrors own_errors(const FeVerification& data) {
  OwnErrors own;
  own.scenes = data.own_errors.size();
  for (const FeOwnError& e : data.own_errors) {
    if (e.kirchhoff_error_over_L >= 0) own.kirchhoff.push_back(e.kirchhoff_error_over_L);
    if (e.error_over_L < 0) continue;
    if (own.errors.empty() || e.error_over_L > own.largest()) own.worst = e.scene;
    own.errors.push_back(e.error_over_L);
    own.errors_mm.push_back(e.error_over_L * e.length_mm);
    own.estimate_over_error.push_back(e.estimate_over_L / e.error_over_L);
  }
  return own;
}

std::string orders_text(const FeVerification& data) {
  const auto order = [&](int p) { return fixed(observed_order(data, "thick", p, false), 1); };
  return fmt::format("{}, {} and {}", order(1), order(2), order(3));
}

// 2p, within a quarter, on both rods.
bool orders_hold(const FeVerification& data) {
  for (const char* rod : {"thick", "thin"}) {
    for (int order = 1; order <= 3; ++order) {
      if (!(std::abs(observed_order(data, rod, order, false) - 2 * order) < 0.25)) return false;
    }
  }
  return true;
}

void set_locking(Page& page, const FeVerification& data) {
  const double full = fe_error(data, "thin", 1, true, fe_coarse), reduced = fe_error(data, "thin", 1, false, fe_coarse);
  page.check("locks", full > 20 * reduced && reduced > 0);
  page.set("thin_full", scientific_text(full));
  page.set("thin_reduced", scientific_text(reduced));
  page.set("coarse", std::to_string(fe_coarse));
}

std::string page_of(const FeVerification& data, const OwnErrors& own, const std::filesystem::path& page_md) {
  Page page;
  page.set("scenes", std::to_string(own.scenes));
  page.set("solved", std::to_string(own.errors.size()));
  page.set("median", scientific_text(quantile(own.errors, 0.5)));
  page.set("largest", scientific_text(own.largest()));
  page.set("largest_mm", scientific_text(quantile(own.errors_mm, 1)));
  page.set("worst", own.worst);
  page.set("kirchhoff_largest", scientific_text(quantile(own.kirchhoff, 1)));
  page.set("ratio_least", significant(quantile(own.estimate_over_error, 0), 2));
  page.set("ratio_median", significant(quantile(own.estimate_over_error, 0.5), 2));
  page.set("ratio_most", significant(quantile(own.estimate_over_error, 1), 2));
  page.check("never_below", quantile(own.estimate_over_error, 0) >= 1);
  page.set("orders", orders_text(data));
  page.check("orders_hold", orders_hold(data));
  set_locking(page, data);
  page.set("order_table", fe_order_table(data));
  page.set("work_table", fe_work_table(data));
  return page.fill(page_md);
}

std::string answer(const OwnErrors& own) {
  return fmt::format(
      "the 50 quadratic elements that stand in for Abaqus are at most {} L off the exact tip on {} of {} scenes",
      scientific_text(own.largest()), own.errors.size(), own.scenes);
}

}  // namespace

std::map<std::string, std::string> fe_verification_files(const FeVerification& data,
                                                         const std::filesystem::path& page_md) {
  const OwnErrors own = own_errors(data);
  return {{"README.md", page_of(data, own, page_md)},
          {"answers.json", answers_json({{"how_sure", answer(own)}})},
          {"convergence.csv", fe_convergence_csv(data)},
          {"own_error.csv", fe_own_error_csv(data)},
          {"work.csv", fe_work_csv(data)},
          {"convergence.svg", fe_convergence_picture(data)},
          {"own_error.svg", fe_own_error_picture(data)}};
}

}  // namespace studies
