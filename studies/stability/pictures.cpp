#include "studies/report/chart.h"
#include "studies/stability/data.h"

#include <algorithm>

namespace studies {
namespace {

constexpr double cell_width = 38, cell_height = 17, left = 74, gap = 34, head = 74;
constexpr int columns = 3;

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

void draw_cell(Svg& svg, Point corner, double width, Verdict verdict) {
  const Point centre{corner.x + width / 2, corner.y + cell_height / 2};
  if (verdict == Verdict::unsupported) {
    svg.text({centre.x, centre.y + 4}, "–", Anchor::middle, 11, colour::grey);
    return;
  }
  svg.rectangle({corner.x + 0.5, corner.y + 0.5}, width - 1, cell_height - 1, fill_of(verdict));
  if (is_silent(verdict)) svg.cross(centre, 5, {"#ffffff", 2.4, ""});
  if (verdict == Verdict::flagged) svg.text({centre.x, centre.y + 4}, "!", Anchor::middle, 11, colour::black);
  if (verdict == Verdict::not_converged) svg.cross(centre, 4, {colour::grey, 1.4, ""});
  if (verdict == Verdict::work_limit) svg.text({centre.x, centre.y + 4}, "w", Anchor::middle, 10, colour::black);
}

void draw_legend(Svg& svg, double y) {
  const std::vector<std::pair<Verdict, std::string>> entries = {
      {Verdict::right_to_1e6, "right to 1e-6 L"}, {Verdict::right_to_1e4, "to 1e-4 L"},
      {Verdict::right_to_1e2, "to 1e-2 L"},       {Verdict::flagged, "wrong, flagged"},
      {Verdict::wrong, "wrong, not flagged"},     {Verdict::wrong_branch, "wrong branch"},
      {Verdict::not_converged, "not converged"},  {Verdict::work_limit, "work limit"},
      {Verdict::unsupported, "unsupported"}};
  double x = 20;
  for (const auto& [verdict, text] : entries) {
    draw_cell(svg, {x, y}, 22, verdict);
    svg.text({x + 27, y + 13}, text, Anchor::start, 11);
    x += 40 + 6.1 * static_cast<double>(text.size());
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

void draw_method(Svg& svg, const StabilityData& data, const StabilityMap& map, const std::string& method,
                 Point corner) {
  const std::vector<double> rows = rows_of(data, map, method);
  svg.text({corner.x, corner.y - 8}, method, Anchor::start, 13);
  double bottom = corner.y;
  for (auto y = rows.rbegin(); y != rows.rend(); ++y, bottom += cell_height) {
    double right = corner.x;
    for (const double x : map.x.values) {
      if (const StabilityCell* cell = data.find(map.name, method, x, *y)) {
        draw_cell(svg, {right, bottom}, cell_width, cell->judgement.verdict);
      }
      right += cell_width;
    }
    const bool one_row = map.y_is_cells && data.find(map.name, method, map.x.values.front(), *y)->cells == 0;
    svg.text({corner.x - 5, bottom + 13}, one_row ? "automatic" : axis_text(*y), Anchor::end, 10);
  }
  for (std::size_t i = 0; i < map.x.values.size(); ++i) {
    svg.text({corner.x + (static_cast<double>(i) + 0.5) * cell_width, bottom + 12}, axis_text(map.x.values[i]),
             Anchor::middle, 10);
  }
  svg.text({corner.x + cell_width * static_cast<double>(map.x.values.size()) / 2, bottom + 27}, map.x.label,
           Anchor::middle, 11);
  if (rows.size() > 1) {
    svg.text({corner.x - 50, (corner.y + bottom) / 2}, map.y.label, Anchor::middle, 11, "#222", -90);
  }
}

std::string picture(const StabilityData& data, const StabilityMap& map) {
  const double panel_width = left + cell_width * static_cast<double>(map.x.values.size()) + gap;
  std::vector<double> row_heights;
  std::vector<std::string> methods;
  std::copy_if(data.methods.begin(), data.methods.end(), std::back_inserter(methods),
               [&](const std::string& method) { return !rows_of(data, map, method).empty(); });
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const double height = 66 + cell_height * static_cast<double>(rows_of(data, map, methods[i]).size());
    if (i % columns == 0) row_heights.push_back(0);
    row_heights.back() = std::max(row_heights.back(), height);
  }
  double height = head;
  for (const double row : row_heights) height += row;
  Svg svg(std::max(1120.0, columns * panel_width), height, map.title, map.title);
  draw_legend(svg, 38);
  double top = head + 22;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    draw_method(svg, data, map, methods[i], {left + panel_width * static_cast<double>(i % columns), top});
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
