#include "scene/equilibrium_file.h"
#include "studies/own_scene/comparison.h"
#include "studies/report/table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace studies {
namespace {

using Json = nlohmann::ordered_json;

// A title of the user's as one line.
std::string one_line(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return text;
}

std::string heading(const Comparison& comparison) {
  const std::string title = one_line(comparison.scene.title);
  return title.empty() ? one_line(comparison.source) : title + " (" + one_line(comparison.source) + ")";
}

double tip_distance_mm(const ComparedMethod& method, const ComparedMethod& truth) {
  return (method.result.tip().position_B_mm - truth.result.tip().position_B_mm).norm();
}

// Every digit; empty where there is none.
std::string digits(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::vector<std::string> csv_row(const Comparison& comparison, const ComparedMethod& method) {
  std::vector<std::string> row = {comparison.source, method.key, scene::name(method.result.status)};
  const ComparedMethod* truth = comparison.truth();
  if (!method.result.converged() || !truth) {
    row.resize(11);
  } else {
    for (const double coordinate : method.result.tip().position_B_mm) row.push_back(digits(coordinate));
    const Distance most = farthest(method.distances);
    for (const double number :
         {tip_distance_mm(method, *truth), most.mm, most.s_mm, method.result.error_estimate_mm, method.time_us}) {
      row.push_back(digits(number));
    }
  }
  row.insert(row.end(), {truth ? truth->key : "", method.model});
  return row;
}

std::string comparison_csv(const std::vector<Comparison>& comparisons) {
  Table table({"scene", "method", "status", "tip_x_mm", "tip_y_mm", "tip_z_mm", "tip_distance_mm",
               "largest_distance_mm", "at_s_mm", "error_estimate_mm", "time_us", "distances_from", "model"});
  for (const Comparison& comparison : comparisons) {
    for (const ComparedMethod& method : comparison.methods) table.add(csv_row(comparison, method));
    if (!comparison.file || comparison.file->distances.empty()) continue;
    const Distance most = farthest(comparison.file->distances);
    table.add({comparison.source, "file", "", "", "", "", "", digits(most.mm), digits(most.s_mm), "", "",
               comparison.truth()->key, comparison.file->source});
  }
  return table.csv();
}

Json distances_json(const std::vector<Distance>& distances) {
  Json list = Json::array();
  for (const Distance& distance : distances) list.push_back({{"s_mm", distance.s_mm}, {"distance_mm", distance.mm}});
  return list;
}

Json comparison_json(const Comparison& comparison, double gate_mm) {
  Json json{{"scene", comparison.source}, {"title", comparison.scene.title}};
  const ComparedMethod* truth = comparison.truth();
  json["distances_from"] = truth ? Json(truth->key) : Json(nullptr);
  for (const ComparedMethod& method : comparison.methods) {
    Json answer = Json::parse(scene::to_json(method.result, method.key, method.time_us));
    if (!method.distances.empty()) {
      answer["tip_distance_mm"] = tip_distance_mm(method, *truth);
      answer["largest_distance_mm"] = farthest(method.distances).mm;
      answer["distances"] = distances_json(method.distances);
    }
    json["methods"].push_back(std::move(answer));
  }
  if (comparison.file) {
    json["against"] = {{"file", comparison.file->source}, {"distances", distances_json(comparison.file->distances)}};
  }
  if (gate_mm > 0) json["gate"] = {{"mm", gate_mm}, {"failures", gate_failures(comparison, gate_mm)}};
  return json;
}

std::string words_of(const Comparison& comparison, double gate_mm) {
  const ComparedMethod* truth = comparison.truth();
  std::string words = "## " + heading(comparison) + "\n\n" + comparison_table(comparison);
  if (truth) words += "\nDistances are from *" + truth->name + "*, at the arc lengths that both give; lengths in mm.\n";
  if (comparison.file && !comparison.file->distances.empty()) {
    const Distance most = farthest(comparison.file->distances);
    words += fmt::format("\n{}: at most {} mm from *{}*, at s = {:.6g} mm, of {} stations.\n", comparison.file->source,
                         error_for_reader(most.mm), truth->name, most.s_mm, comparison.file->distances.size());
  }
  for (const ComparedMethod& method : comparison.methods) {
    if (!method.result.converged()) words += "\n" + method.name + ": " + method.result.message + "\n";
  }
  if (gate_mm <= 0) return words;
  const std::vector<std::string> failures = gate_failures(comparison, gate_mm);
  words += fmt::format("\nGate of {:g} mm: {}\n", gate_mm, failures.empty() ? "passed." : "**failed**.");
  for (const std::string& failure : failures) words += "- " + failure + "\n";
  return words;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  Table table(
      {"method", "tip x", "tip y", "tip z", "tip differs", "shape differs", "at s", "estimate", "time", "model"});
  const ComparedMethod* truth = comparison.truth();
  for (const ComparedMethod& method : comparison.methods) {
    const scene::Equilibrium& result = method.result;
    std::vector<std::string> row{method.name};
    if (!result.converged()) {
      row.insert(row.end(), {scene::name(result.status), "–", "–", "–", "–", "–", "–", "–", method.model});
    } else {
      for (const double coordinate : result.tip().position_B_mm) row.push_back(fixed(coordinate, 6));
      if (&method == truth) {
        row.insert(row.end(), {"–", "–", "–"});
      } else {
        const Distance most = farthest(method.distances);
        row.insert(row.end(), {error_for_reader(tip_distance_mm(method, *truth)), error_for_reader(most.mm),
                               significant(most.s_mm, 4)});
      }
      row.insert(row.end(), {error_for_reader(result.error_estimate_mm), time_text(method.time_us), method.model});
    }
    table.add(std::move(row));
  }
  return table.markdown();
}

std::map<std::string, std::string> comparison_files(const std::vector<Comparison>& comparisons, double gate_mm) {
  std::string words = "# Methods beside each other\n\n![The shapes, and how far they lie apart](compare.svg)\n";
  Json json = Json::array();
  for (const Comparison& comparison : comparisons) {
    words += "\n" + words_of(comparison, gate_mm);
    json.push_back(comparison_json(comparison, gate_mm));
  }
  return {{"compare.md", words},
          {"compare.csv", comparison_csv(comparisons)},
          {"compare.json", Json{{"scenes", json}}.dump(2) + "\n"},
          {"compare.svg", comparison_picture(comparisons, gate_mm)}};
}

}  // namespace studies
