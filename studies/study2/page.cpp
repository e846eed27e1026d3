#include "studies/study2/page.h"
#include "studies/scenes/cases.h"

#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Printed in the paper, mm, for its own forces against photographs; the largest is 8.5 % of the largest deflection.
constexpr double printed_mean_mm = 1.41, printed_sd_mm = 1.47, printed_largest_mm = 4.95, printed_share = 0.085;

constexpr double blood_kg_per_m3 = 1060;  // assumed

std::string error_text_mm(double error_mm) {
  return for_reader(scientific(error_mm, 1));
}

double tip_distance_mm(const Study2Row& a, const Study2Row& b) {
  if (a.positions_mm.empty() || b.positions_mm.empty()) return NAN;
  return (a.positions_mm.back() - b.positions_mm.back()).norm();
}

// Of the forces alone.
double error_of(const Study2Data& data, const std::string& method) {
  return largest_error_mm(row(data, "study2", method));
}

double deflection_mm(const Study2Data& data) {
  return largest_deflection_mm(row(data, "study2", "exact"));
}

std::string time_of_method(const Study2Data& data, const std::string& method) {
  return time_text(row(data, "study2", method).timing.median_us);
}

void set_answer(Page& page, const Study2Data& data) {
  page.set("deflection", fixed(deflection_mm(data), 1));
  page.set("published", error_text_mm(error_of(data, "fam_published_12")));
  page.set("fam_error", error_text_mm(error_of(data, "fam")));
  page.set("kirchhoff", error_text_mm(error_of(data, "exact_kirchhoff")));
  page.set_time("fam_time", time_of_method(data, "fam"));
  page.set_time("fe_time", time_of_method(data, "fe"));
  page.set("printed_mean", fixed(printed_mean_mm, 2));
  page.set("printed_sd", fixed(printed_sd_mm, 2));
  page.set("printed_largest", fixed(printed_largest_mm, 2));
  const auto percent = [](double mm) { return significant(100 * mm / printed_mean_mm, 2); };
  page.set("published_percent", percent(error_of(data, "fam_published_12")));
  page.set("kirchhoff_percent", percent(error_of(data, "exact_kirchhoff")));
  page.check("arithmetic",
             error_of(data, "fam_published_12") + error_of(data, "exact_kirchhoff") < 0.5 * printed_mean_mm);
  page.check("no_weight", std::all_of(study2_scenes.begin() + 1, study2_scenes.end(), [&](const std::string& scene) {
               return row(data, scene, "fam_published_12").status == "unsupported";
             }));
}

double weight_N(const scene::Scene& scene) {
  double weight = 0;
  for (const scene::Load& load : scene.loads) {
    const auto* gravity = known_load<scene::Gravity>(load);
    if (!gravity) continue;
    for (const scene::Section& s : scene.sections) {
      weight += 1e-3 * s.length_mm * stiffness_of(s).mass_per_length_kg_per_m * gravity->acceleration_m_per_s2.norm();
    }
  }
  return weight;
}

double density_kg_per_m3(const scene::Scene& scene) {
  const auto* tube = std::get_if<scene::CircularSection>(&scene.sections.front().cross_section);
  return tube ? tube->density_kg_per_m3 : NAN;
}

void set_weight(Page& page, const Study2Data& data) {
  double forces_N = 0;
  for (const scene::Load& load : data.forces_alone.loads) {
    if (const auto* force = known_load<scene::Force>(load)) forces_N += force->value_N.norm();
  }
  const Study2Row& plain = row(data, "study2", "exact");
  double least = INFINITY;
  for (const std::string axis : {"y", "z"}) {
    const double moved = tip_distance_mm(row(data, "study2_gravity_" + axis, "exact"), plain);
    least = std::min(least, moved);
    page.set("moved_" + axis, fixed(moved, 0));
    page.set("share_" + axis, fixed(100 * moved / deflection_mm(data), 0));
  }
  page.check("weight_matters", least > 0.05 * deflection_mm(data));
  const double density = density_kg_per_m3(data.with_weight);
  page.set("density", fixed(density, 0));
  page.set("weight", fixed(1e3 * weight_N(data.with_weight), 1));
  page.set("forces_sum", fixed(1e3 * forces_N, 1));
  page.set("floating", fixed(100 * (1 - blood_kg_per_m3 / density), 1));
}

std::string forces_text(const scene::Scene& scene) {
  std::vector<std::string> texts;
  for (const scene::Load& load : scene.loads) {
    const auto* force = known_load<scene::Force>(load);
    if (!force) continue;
    const auto& f = force->value_N;
    texts.push_back(for_reader(fmt::format("({:.3g}, {:.3g}, {:.3g}) N at {:g} mm", f[0], f[1], f[2], force->at_mm)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

void set_method(Page& page, const Study2Data& data) {
  page.set("bending", fixed(stiffness_of(data.forces_alone.sections.front()).bending_Nmm2[0], 1));
  page.set("forces", forces_text(data.forces_alone));
  const double printed_deflection_mm = printed_largest_mm / printed_share;
  page.set("printed_deflection", fixed(printed_deflection_mm, 0));
  page.check("near", std::abs(deflection_mm(data) - printed_deflection_mm) < 0.02 * printed_deflection_mm);
  page.set("stations", std::to_string(row(data, "study2", "exact").s_mm.size()));
  page.check("interpolated",
             std::any_of(data.rows.begin(), data.rows.end(), [](const Study2Row& r) { return r.interpolated; }));
}

std::string readme(const Study2Data& data, const std::filesystem::path& page_md) {
  Page page;
  set_answer(page, data);
  page.set("errors_table", errors_table(data));
  set_weight(page, data);
  page.set("times_table", times_table(data));
  page.set_time("machine", machine_line());
  set_method(page, data);
  return page.fill(page_md);
}

std::string catheter(const Study2Data& data) {
  const double published_mm = error_of(data, "fam_published_12");
  return fmt::format(
      "of 504 mm, bent by {} mm: `fam solve` is within {} mm of the exact rod in {}, FAM published, 12 arcs, "
      "within {} mm; FE takes {}",
      fixed(deflection_mm(data), 1), error_text_mm(error_of(data, "fam")), timed(time_of_method(data, "fam")),
      error_text_mm(published_mm), timed(time_of_method(data, "fe")));
}

std::string model(const Study2Data& data) {
  double most = 0;
  for (const std::string& scene : study2_scenes) {
    most = std::max(most, largest_error_mm(row(data, scene, "exact_kirchhoff")));
  }
  return fmt::format("on a catheter of 504 × 2.14 mm they move no place by more than {} mm in {} scenes",
                     error_text_mm(most), study2_scenes.size());
}

}  // namespace

std::map<std::string, std::string> study2_files(const Study2Data& data, const std::filesystem::path& page_md) {
  std::map<std::string, std::string> files{
      {"README.md", readme(data, page_md)},
      {"deflection.svg", deflection_picture(data)},
      {"errors.svg", errors_picture(data)},
      {answers_file, answers_json({{"catheter", catheter(data)}, {"model", model(data)}})}};
  files.merge(study2_csv(data));
  return files;
}

}  // namespace studies
