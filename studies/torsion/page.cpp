#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/torsion/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

const double T = largest_printed_Nmm;

std::string share_of_L(const TorsionData& data, double error_mm) {
  return significant(100 * error_mm / data.rod.length_mm, 2) + " %";
}

std::string arcs_text(const TorsionData& data, const std::string& law, double limit_mm) {
  const int arcs = data.fewest_arcs(T, law, limit_mm);
  return arcs ? std::to_string(arcs) : "more than 100 000";
}

std::string vector_text(const Eigen::Vector3d& v) {
  return for_reader(fmt::format("({:g}, {:g}, {:g})", v[0], v[1], v[2]));
}

bool grows(const TorsionData& data, const std::string& method) {
  double last = 0;
  for (const double torque : data.torques_Nmm) {
    if (torque > T) break;
    const double error = data.own_mm(torque, method);
    if (!(error > last)) return false;
    last = error;
  }
  return true;
}

// Of the paper's range.
double torque_of_least_error(const TorsionData& data, const std::string& method) {
  double at = 0;
  for (const double torque : data.torques_Nmm) {
    if (torque <= T && data.own_mm(torque, method) < data.own_mm(at, method)) at = torque;
  }
  return at;
}

// Whether all observed orders at these torques are those that theory gives.
bool orders_as_in_theory(const TorsionData& data) {
  const double theory[] = {1, 1, 2, 4, 6};
  for (std::size_t i = 0; i < torsion_laws().size(); ++i) {
    const std::string order = data.order_of(T, torsion_laws()[i].key);
    if (order == "–" || std::abs(std::stod(order) - theory[i]) > 0.1) return false;
  }
  return true;
}

double time_us(const TorsionData& data, const std::string& scene, const std::string& law) {
  return data.time(scene, law, law == "fam" ? 0 : 12).median_us;
}

// "1.1 to 1.3": least and largest over the laws of time in one scene over that in another.
std::string time_ratios(const TorsionData& data, const std::string& scene, const std::string& over) {
  double least = INFINITY, largest = 0;
  for (const TorsionLaw& law : torsion_laws()) {
    const double ratio = time_us(data, scene, law.key) / time_us(data, over, law.key);
    least = std::min(least, ratio), largest = std::max(largest, ratio);
  }
  return fixed(least, 2) + " to " + fixed(largest, 2);
}

std::string orders_at_zero(const TorsionData& data) {
  return data.order_of(0, "bend_twist") + " and " + data.order_of(0, "twist_bend");
}

void set_scene(Page& page, const TorsionData& data) {
  const TorsionRod& rod = data.rod;
  page.set("length", fmt::format("{:g}", rod.length_mm));
  page.set("diameter", fmt::format("{:g}", rod.diameter_mm));
  page.set("EI", fixed(rod.bending_Nmm2, 0));
  page.set("GJ", fixed(rod.torsion_Nmm2, 0));
  page.set("force", vector_text(rod.tip_force_N));
  page.set("moment", vector_text(rod.tip_moment_Nmm));
  page.set("twist50", fixed(T * rod.length_mm / rod.torsion_Nmm2, 1));
  page.set("twist_last", fixed(data.torques_Nmm.back() * rod.length_mm / rod.torsion_Nmm2, 0));
  page.set("gyration", fmt::format("{:g}", rod.diameter_mm / 4));
}

void set_errors(Page& page, const TorsionData& data) {
  const auto own = [&](double torque, const std::string& law) {
    return error_for_reader(data.own_mm(torque, law + "_12"));
  };
  page.set("published", own(T, "bend_twist"));
  page.set("published_share", share_of_L(data, data.own_mm(T, "bend_twist_12")));
  page.set("twist_first", own(T, "twist_bend"));
  page.set("sixth", own(T, "sixth_order"));
  page.set("published_0", own(0, "bend_twist"));
  page.set("published_arcs", arcs_text(data, "bend_twist", 0.1));
  page.set("twist_first_arcs", arcs_text(data, "twist_bend", 0.1));
  page.set("sixth_arcs", arcs_text(data, "sixth_order", 0.1));
  page.check("grows", grows(data, "bend_twist_12"));
  const double least = torque_of_least_error(data, "twist_bend_12");
  page.check("dips", least > 0 && least < T);
  page.set("least_at", fixed(least, 0));
  page.check("orders", orders_as_in_theory(data));
  page.set("orders_at_zero", orders_at_zero(data));
  page.set("tilt50", fixed((data.tilts.back().tip_mm - data.tilts.back().straight_tip_mm).norm(), 1));
}

void set_times(Page& page, const TorsionData& data) {
  page.set_time("machine", machine_line());
  page.set_time("torque_over_space", time_ratios(data, "torque", "space"));
  page.set_time("space_over_plane", time_ratios(data, "space", "plane"));
  for (const char* scene : {"plane", "space", "torque"}) {
    page.set_time(fmt::format("solve_{}", scene), time_text(time_us(data, scene, "fam")));
    page.set_time(fmt::format("sixth_{}", scene), time_text(time_us(data, scene, "sixth_order")));
  }
  page.set_time("repeats", std::to_string(data.times.front().timing.repeats));
}

std::string answer(const TorsionData& data) {
  const auto own = [&](const std::string& law) { return error_for_reader(data.own_mm(T, law + "_12")); };
  const auto time = [&](const char* scene) { return timed(time_text(time_us(data, scene, "fam"))); };
  return fmt::format(
      "At 50 N mm and 12 arcs FAM published is {} mm off ({} of L), FAM sixth order {} mm. `fam solve` takes {} in a "
      "plane, {} in space, {} with the torque",
      own("bend_twist"), share_of_L(data, data.own_mm(T, "bend_twist_12")), own("sixth_order"), time("plane"),
      time("space"), time("torque"));
}

}  // namespace

std::map<std::string, std::string> torsion_pages(const TorsionData& data, const std::filesystem::path& page_md) {
  Page page;
  set_scene(page, data);
  set_errors(page, data);
  set_times(page, data);
  page.set("laws", laws_table(data));
  page.set_time("times", times_table(data));
  page.set("printed", printed_table(data));
  page.set("beyond", beyond_table(data));
  page.set("tilts", tilts_table(data));
  return {{"README.md", page.fill(page_md)}, {answers_file, answers_json({{"cost", answer(data)}})}};
}

}  // namespace studies
