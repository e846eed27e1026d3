#include "scene/equilibrium_file.h"

#include "scene/json_file.h"

#include <fmt/format.h>

#include <cmath>

namespace scene {
namespace {

Json list(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}

Json list(const Eigen::Matrix3d& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) rows.push_back(list(Eigen::Vector3d(matrix.row(row))));
  return rows;
}

std::string fact_text(const std::variant<bool, int, double, std::string>& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

std::string triple(const Eigen::Vector3d& v) {
  // Never "-0.000000".
  const auto shown = [](double value) { return std::abs(value) < 5e-7 ? 0.0 : value; };
  return fmt::format("{:12.6f} {:12.6f} {:12.6f}", shown(v[0]), shown(v[1]), shown(v[2]));
}

}  // namespace

std::string to_json(const Equilibrium& result, const std::string& method, double time_us) {
  Json json{{"method", method}, {"status", name(result.status)}};
  if (!result.message.empty()) json["message"] = result.message;
  if (result.limit) json["limit"] = {{"load_factor", result.limit->load_factor}, {"kind", result.limit->kind}};
  json["tip"] = nullptr;
  json["base"] = nullptr;
  json["centreline"] = Json::array();
  json["error_estimate_mm"] = nullptr;
  if (result.converged()) {
    const Pose& tip = result.tip();
    json["tip"] = {{"position_mm", list(tip.position_B_mm)},
                   {"rotation", list(tip.rotation_BS)},
                   {"angle_rad", result.tip_angle_rad}};
    const Station& base = result.base();
    json["base"] = {{"force_N", list(base.force_B_N)}, {"moment_Nmm", list(base.moment_B_Nmm)}};
    for (const Station& station : result.stations) {
      json["centreline"].push_back({{"s_mm", station.s_mm},
                                    {"position_mm", list(station.X_BS.position_B_mm)},
                                    {"rotation", list(station.X_BS.rotation_BS)},
                                    {"force_N", list(station.force_B_N)},
                                    {"moment_Nmm", list(station.moment_B_Nmm)}});
    }
    if (!result.tendon_shortening_mm.empty()) {
      json["tendons"] = Json::array();
      for (const double shortening_mm : result.tendon_shortening_mm) {
        json["tendons"].push_back({{"shortening_mm", shortening_mm}});
      }
    }
    json["error_estimate_mm"] = result.error_estimate_mm;
  }
  json["time_us"] = time_us;
  json["model"] = Json::object();
  for (const Fact& fact : result.model) {
    std::visit([&](const auto& value) { json["model"][fact.first] = value; }, fact.second);
  }
  json["stable"] = result.stable ? Json(*result.stable) : Json(nullptr);
  return json.dump(2) + "\n";
}

std::string to_csv(const Equilibrium& result) {
  std::string csv = "s_mm,x_mm,y_mm,z_mm,R11,R12,R13,R21,R22,R23,R31,R32,R33,Fx_N,Fy_N,Fz_N,Mx_Nmm,My_Nmm,Mz_Nmm\n";
  for (const Station& station : result.stations) {
    csv += fmt::format("{}", station.s_mm);
    for (const double coordinate : station.X_BS.position_B_mm) csv += fmt::format(",{}", coordinate);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) csv += fmt::format(",{}", station.X_BS.rotation_BS(row, column));
    }
    for (const Eigen::Vector3d* vector : {&station.force_B_N, &station.moment_B_Nmm}) {
      for (const double component : *vector) csv += fmt::format(",{}", component);
    }
    csv += "\n";
  }
  return csv;
}

std::string to_text(const Equilibrium& result, const std::string& method, double time_us) {
  if (!result.converged()) return fmt::format("{}: {}: {}\n", method, name(result.status), result.message);
  std::string report = fmt::format("{}: converged in {:.3g} us\n\n", method, time_us);
  report += fmt::format("  {:<24}{:>12} {:>12} {:>12}\n", "", "x", "y", "z");
  report += fmt::format("  {:<24}{}\n", "tip position, mm", triple(result.tip().position_B_mm));
  report += fmt::format("  {:<24}{}\n", "tip tangent", triple(result.tip().rotation_BS.col(0)));
  report += fmt::format("  {:<24}{}\n", "force at the clamp, N", triple(result.base().force_B_N));
  report += fmt::format("  {:<24}{}\n", "moment at the clamp, N mm", triple(result.base().moment_B_Nmm));
  report += fmt::format("  {:<24}{:12.6f}\n", "tip rotation angle, rad", result.tip_angle_rad);
  const bool estimated = std::isfinite(result.error_estimate_mm);
  const std::string error = estimated ? fmt::format("{:.3g}", result.error_estimate_mm) : "unknown";
  report += fmt::format("  {:<24}{:>12}\n", "estimated error, mm", error);
  if (result.stable) report += fmt::format("  {:<24}{}\n", "equilibrium", *result.stable ? "stable" : "unstable");
  report += "\n  model\n";
  for (const auto& [key, value] : result.model) report += fmt::format("    {:<18}{}\n", key, fact_text(value));
  return report;
}

}  // namespace scene
