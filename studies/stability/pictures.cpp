#include "studies/report/chart.h"

#include "studies/report/table.h"
#include "studies/stability/data.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

constexpr double width = 890, panel_width = 440, left = 72, cell_height = 18, head = 98, above_panel = 28,
                 below_panel = 46;
constexpr std::size_t columns = 2;

// Dark to light: how right. Orange and purple with a white cross: wrong and silent. Grey with a cross: says so.
std::string fill_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right_to_1e6: return "#0b3c5d";
    case Verdict::right_to_1e4: return "#3d84b8";
    case Verdict::right_to_1e2: return "#a9d0ea";
    case Verdict::flagged: return "#fdf3cf";
    case Verdict::wrong: return colour::orange;
    case Verdict::wrong_branch: return colour::purple;
    default: return colour::faint;
  }
}

void draw_cell(Svg& svg, Point corner, double cell_width, Verdict verdict) {
  const Point centre{corner.x + cell_width / 2, corner.y + cell_height / 2};
  if (verdict == Verdict::unsupported) return svg.text({centre.x, centre.y + 4}, "–", Anchor::middle);
  svg.rectangle({corner.x + 0.5, corner.y + 0.5}, cell_width - 1, cell_height - 1, fill_of(verdict));
  if (is_silent(verdict)) svg.cross(centre, 5, {"#ffffff", 2.4, ""});
  if (verdict == Verdict::flagged) svg.text({centre.x, centre.y + 4}, "!", Anchor::middle, 12, colour::black);
  if (verdict == Verdict::not_converged) svg.cross(centre, 4, {colour::grey, 1.4, ""});
  if (verdict == Verdict::work_limit) svg.text({centre.x, centre.y + 4}, "w", Anchor::middle, 12, colour::black);
}

const std::vector<std::pair<Verdict, std::string>>& legend() {
  static const std::vector<std::pair<Verdict, std::string>> entries = {
      {Verdict::right_to_1e6, "right to 1e-6 L"}, {Verdict::right_to_1e4, "to 1e-4 L"},
      {Verdict::right_to_1e2, "to 1e-2 L"},       {Verdict::flagged, "wrong, says so"},
      {Verdict::wrong, "wrong and silent"},       {Verdict::wrong_branch, "silent, wrong branch"},
      {Verdict::not_converged, "no answer"},      {Verdict::work_limit, "work limit"}};
  return entries;
}

bool shows(const StabilityData& data, const StabilityMap& map, Verdict verdict) {
  return std::any_of(data.cells.begin(), data.cells.end(),
                     [&](const StabilityCell& c) { return c.map == map.name && c.judgement.verdict == verdict; });
}

void draw_legend(Svg& svg, const StabilityData& data, const StabilityMap& map) {
  Point at{26, 40};
  for (const auto& [verdict, text] : legend()) {
    if (!shows(data, map, verdict)) continue;
    draw_cell(svg, at, 22, verdict);
    svg.text({at.x + 27, at.y + 13}, text);
    at.x += 42 + text_width(text, 12);
    if (at.x > width - 150) at = {26, at.y + 22};
  }
}

// The rows of y at which a method was asked.
std::vector<double> rows_of(const StabilityData& data, const StabilityMap& map, const std::string& method) {
  std::vector<double> rows;
  std::copy_if(map.y.values.begin(), map.y.values.end(), std::back_inserter(rows), [&](double y) {
    return std::any_of(map.x.values.begin(), map.x.values.end(),
                       [&](double x) { return data.find(map.name, method, x, y) != nullptr; });
  });
  return rows;
}

double cell_width_of(const StabilityMap& map) {
  return std::min(64.0, (panel_width - left - 14) / static_cast<double>(map.x.values.size()));
}

void draw_axes(Svg& svg, const StabilityMap& map, const std::vector<double>& rows, Point corner, bool one_row) {
  const double cell_width = cell_width_of(map), count = static_cast<double>(map.x.values.size());
  const double bottom = corner.y + cell_height * static_cast<double>(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = bottom - cell_height * static_cast<double>(i);
    svg.text({corner.x - 5, y - 5}, one_row ? "chosen" : for_reader(axis_text(rows[i])), Anchor::end);
  }
  for (std::size_t i = 0; i < map.x.values.size(); ++i) {
    const std::string value = for_reader(axis_text(map.x.values[i]));
    svg.text({corner.x + (static_cast<double>(i) + 0.5) * cell_width, bottom + 14}, value, Anchor::middle,
             text_width(value, 12) < cell_width ? 12 : 10);
  }
  svg.text({corner.x + cell_width * count / 2, bottom + 30}, map.x.label, Anchor::middle);
  if (!one_row) svg.text({corner.x - 62, (corner.y + bottom) / 2}, map.y.label, Anchor::middle, 12, colour::black, -90);
}

void draw_method(Svg& svg, const StabilityData& data, const StabilityMap& map, const std::string& method,
                 Point corner) {
  const std::vector<double> rows = rows_of(data, map, method);
  const double cell_width = cell_width_of(map);
  svg.text({corner.x, corner.y - 8}, contender(method).name(), Anchor::start, 13);
  double top = corner.y;
  for (auto y = rows.rbegin(); y != rows.rend(); ++y, top += cell_height) {
    for (std::size_t i = 0; i < map.x.values.size(); ++i) {
      if (const StabilityCell* cell = data.find(map.name, method, map.x.values[i], *y))
        draw_cell(svg, {corner.x + cell_width * static_cast<double>(i), top}, cell_width, cell->judgement.verdict);
    }
  }
  draw_axes(svg, map, rows, corner, map.y_is_cells && contender(method).automatic());
}

constexpr const char* index_panel = "index";  // beside those of the methods

bool has_index(const StabilityData& data, const StabilityMap& map) {
  return std::any_of(data.indices.begin(), data.indices.end(),
                     [&](const ExactIndex& i) { return i.map == map.name && i.falling.value_or(0) > 0; });
}

void draw_index(Svg& svg, const StabilityData& data, const StabilityMap& map, Point corner) {
  const double cell_width = cell_width_of(map);
  svg.text({corner.x, corner.y - 8}, "Directions in which the exact answer is unstable", Anchor::start, 13);
  double top = corner.y;
  for (auto y = map.y.values.rbegin(); y != map.y.values.rend(); ++y, top += cell_height) {
    for (std::size_t i = 0; i < map.x.values.size(); ++i) {
      const ExactIndex* index = data.index_at(map, map.x.values[i], *y);
      if (index == nullptr) continue;
      const Point at{corner.x + cell_width * static_cast<double>(i), top};
      const bool falls = index->falling.value_or(0) > 0;
      svg.rectangle({at.x + 0.5, at.y + 0.5}, cell_width - 1, cell_height - 1, falls ? "#b9a3d6" : "#eef1f4");
      svg.text({at.x + cell_width / 2, at.y + cell_height / 2 + 4},
               index->falling ? std::to_string(*index->falling) : "n", Anchor::middle, 12, colour::black);
    }
  }
  draw_axes(svg, map, map.y.values, corner, false);
}

bool refuses(const StabilityData& data, const StabilityMap& map, const std::string& method) {
  const auto cells = data.find_all(map.name, method);
  return std::all_of(cells.begin(), cells.end(),
                     [](const StabilityCell* c) { return c->judgement.verdict == Verdict::unsupported; });
}

// "FAM published": those without a panel.
std::string refusing(const StabilityData& data, const StabilityMap& map) {
  std::string names;
  for (const std::string& method : data.methods) {
    if (data.find_all(map.name, method).empty() || !refuses(data, map, method)) continue;
    names += (names.empty() ? "" : ", ") + contender(method).name();
  }
  return names;
}

// Those that choose their own resolution first; a method that refuses all of the map has no panel.
std::vector<std::string> panels_of(const StabilityData& data, const StabilityMap& map) {
  std::vector<std::string> methods;
  for (const std::string& method : data.methods) {
    if (!data.find_all(map.name, method).empty() && !refuses(data, map, method)) methods.push_back(method);
  }
  std::stable_partition(methods.begin(), methods.end(),
                        [](const std::string& method) { return contender(method).automatic(); });
  return methods;
}

// The map in words: axes, and of each method how many cells are right, fail and say so, or are silent.
std::string told(const StabilityData& data, const StabilityMap& map) {
  std::string text = fmt::format(
      "A grid of cells a method: {} along, {} upwards; dark blue cells are right, pale and grey "
      "ones say that they are not, orange and purple ones with a white cross are silent.",
      map.x.label, map.y.label);
  for (const std::string& method : panels_of(data, map)) {
    const auto cells = data.find_all(map.name, method);
    const auto count = [&](bool (*is)(Verdict)) {
      return std::count_if(cells.begin(), cells.end(), [&](const auto* c) { return is(c->judgement.verdict); });
    };
    const auto silent = count(is_silent);
    text += fmt::format(" {}: {} of {} right", contender(method).name(), count(is_right), cells.size());
    text += silent > 0 ? fmt::format(", {} silent.", silent) : ".";
  }
  return text;
}

std::string picture(const StabilityData& data, const StabilityMap& map) {
  std::vector<std::string> panels = panels_of(data, map);
  if (has_index(data, map)) panels.push_back(index_panel);
  std::vector<double> row_heights;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i % columns == 0) row_heights.push_back(0);
    const std::size_t rows = panels[i] == index_panel ? map.y.values.size() : rows_of(data, map, panels[i]).size();
    const double cells = cell_height * static_cast<double>(rows);
    row_heights.back() = std::max(row_heights.back(), above_panel + cells + below_panel);
  }
  double height = head;
  for (const double row : row_heights) height += row;
  Svg svg(width, height, map.title, told(data, map));
  draw_legend(svg, data, map);
  if (const std::string names = refusing(data, map); !names.empty())
    svg.text({width - 20, 24}, "refused by " + names, Anchor::end, 12, colour::grey);
  double top = head;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Point corner{8 + left + panel_width * static_cast<double>(i % columns), top + above_panel - 10};
    if (panels[i] == index_panel) draw_index(svg, data, map, corner);
    else draw_method(svg, data, map, panels[i], corner);
    if (i % columns == columns - 1) top += row_heights[i / columns];
  }
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> stability_pictures(const StabilityData& data) {
  std::map<std::string, std::string> files;
  for (const StabilityMap& map : data.maps) files[map.name + ".svg"] = picture(data, map);
  return files;
}

}  // namespace studies
