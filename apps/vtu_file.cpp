#include "apps/vtu_file.h"

#include "studies/report/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps {
namespace {

constexpr double drawn_radius_over_L = 0.01;  // of sections whose stiffness is given and no diameter; chosen
constexpr int poly_line_cell = 4;             // VTK_POLY_LINE

// One array of a file: `components` numbers a row.
std::string data_array(const std::string& name, int components, const std::vector<double>& values) {
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return "";
  std::string text = fmt::format(
      "        <DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">", name, components);
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{}", i % static_cast<std::size_t>(components) == 0 ? "\n          " : " ", values[i]);
  return text + "\n        </DataArray>\n";
}

double radius_mm(const scene::Scene& scene, const scene::Section& section) {
  const auto* circle = std::get_if<scene::CircularSection>(&section.cross_section);
  return circle ? circle->outer_diameter_mm / 2 : drawn_radius_over_L * scene::length_mm(scene);
}

struct PointData {
  std::vector<double> s_mm, radius_mm, rotation, force_N, moment_Nmm, curvature_per_mm, position_mm;
};

PointData point_data(const scene::Scene& scene, const scene::Equilibrium& result) {
  PointData data;
  const auto append = [](std::vector<double>& list, const auto& numbers) {
    list.insert(list.end(), numbers.begin(), numbers.end());
  };
  for (const scene::Station& station : result.stations) {
    const scene::Section& section = scene::section_at(scene, station.s_mm);
    data.s_mm.push_back(station.s_mm);
    data.radius_mm.push_back(radius_mm(scene, section));
    for (int row = 0; row < 3; ++row) append(data.rotation, Eigen::Vector3d(station.X_BS.rotation_BS.row(row)));
    append(data.force_N, station.force_B_N);
    append(data.moment_Nmm, station.moment_B_Nmm);
    append(data.curvature_per_mm,
           scene::curvature_per_mm(section, station.X_BS.rotation_BS.transpose() * station.moment_B_Nmm));
    append(data.position_mm, station.X_BS.position_B_mm);
  }
  return data;
}

std::string cells(std::size_t points) {
  std::string text =
      "      <Cells>\n        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n         ";
  for (std::size_t i = 0; i < points; ++i) text += fmt::format(" {}", i);
  return text + fmt::format(
                    "\n        </DataArray>\n"
                    "        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{}</DataArray>\n"
                    "        <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">{}</DataArray>\n"
                    "      </Cells>\n",
                    points, poly_line_cell);
}

std::string xml_file(const std::string& type, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <{0}>\n{1}  </{0}>\n</VTKFile>\n",
      type, content);
}

std::string xml_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    const std::string_view special = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : "";
    if (special.empty()) escaped += c;
    else escaped += special;
  }
  return escaped;
}

}  // namespace

std::string to_vtu(const scene::Scene& scene, const scene::Equilibrium& result, const RodNumbers& rod_numbers) {
  const PointData data = point_data(scene, result);
  std::string text = fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"1\">\n", data.s_mm.size());
  text += "      <PointData Scalars=\"radius_mm\">\n";
  text += data_array("s_mm", 1, data.s_mm) + data_array("radius_mm", 1, data.radius_mm);
  text += data_array("rotation", 9, data.rotation);
  text += data_array("force_N", 3, data.force_N) + data_array("moment_Nmm", 3, data.moment_Nmm);
  text += data_array("curvature_per_mm", 3, data.curvature_per_mm);
  text += "      </PointData>\n      <CellData>\n";
  text += data_array("error_estimate_mm", 1, {result.error_estimate_mm});
  text += data_array("stable", 1, {result.stable ? double(*result.stable) : -1});
  for (const auto& [name, value] : rod_numbers) text += data_array(name, 1, {value});
  text += "      </CellData>\n      <Points>\n" + data_array("position_mm", 3, data.position_mm) + "      </Points>\n";
  return xml_file("UnstructuredGrid", text + cells(data.s_mm.size()) + "    </Piece>\n");
}

void RodCollection::add(std::size_t step, const scene::Scene& scene, const scene::Equilibrium& result,
                        const RodNumbers& rod_numbers) {
  vtu_[step] = to_vtu(scene, result, rod_numbers);
}

void RodCollection::write() const {
  const std::filesystem::path folder = path_.stem().string() + "_rods";
  std::string sets;
  for (const auto& [step, text] : vtu_) {
    const std::filesystem::path file = folder / fmt::format("rod_{:05}.vtu", step);
    studies::write_file(path_.parent_path() / file, text);
    sets += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", step, xml_escaped(file.generic_string()));
  }
  studies::write_file(path_, xml_file("Collection", sets));
}

}  // namespace apps
