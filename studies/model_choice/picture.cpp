#include "studies/model_choice/data.h"
#include "studies/report/svg.h"
#include "studies/report/table.h"

#include <fmt/format.h>

namespace studies {
namespace {

constexpr double row_height = 19, column_width = 88, first_column = 340, first_row = 112, group_gap = 26;
const std::string with_shear_fill = "#cfe4f2", no_shear_fill = "#f4f4f4";

void draw_choice(Svg& svg, Point corner, const ChosenModel& choice) {
  const double half = column_width / 2 - 1, baseline = corner.y + row_height - 6;
  const auto cell = [&](double x, bool exists, bool shear, int arcs, const std::string& colour) {
    svg.rectangle({x, corner.y + 1}, half - 1, row_height - 2, exists && shear ? with_shear_fill : no_shear_fill);
    if (exists) svg.text({x + half - 8, baseline}, std::to_string(arcs), Anchor::end, 12, colour);
    else svg.cross({x + half - 12, corner.y + row_height / 2}, 4, {colour::orange, 1.6, ""});
  };
  cell(corner.x, choice.fewest_arcs > 0, choice.shear_needed, choice.fewest_arcs, colour::black);
  const bool suffices = choice.rung.suffices(choice.tolerance);
  cell(corner.x + half, suffices, choice.rung.model.shear, choice.rung.model.count, colour::blue);
}

void draw_head(Svg& svg, double y, const std::string& group) {
  svg.text({26, y + 14}, group, Anchor::start, 13);
  for (std::size_t i = 0; i < choice_tolerances.size(); ++i) {
    const double x = first_column + column_width * static_cast<double>(i);
    svg.text({x + column_width / 2 - 2, y + 14}, for_reader(scientific(choice_tolerances[i], 0)) + " L", Anchor::middle,
             12, "#666");
  }
}

void draw_key(Svg& svg) {
  const double y = 62;
  double x = 26;
  const auto swatch = [&](const std::string& fill, const std::string& text) {
    svg.rectangle({x, y}, 22, 15, fill);
    svg.text({x + 28, y + 12}, text);
    x += 52 + text_width(text, 12);
  };
  swatch(no_shear_fill, "without shear");
  swatch(with_shear_fill, "with shear and stretch");
  svg.text({x, y + 12}, "left, black: smallest sufficient");
  x += 24 + text_width("left, black: smallest sufficient", 12);
  svg.text({x, y + 12}, "right, blue: fam solve", Anchor::start, 12, colour::blue);
  x += 24 + text_width("right, blue: fam solve", 12);
  svg.cross({x + 6, y + 8}, 4, {colour::orange, 1.6, ""});
  svg.text({x + 18, y + 12}, "none does");
}

}  // namespace

std::string model_choice_picture(const ModelChoiceData& data) {
  const std::vector<std::string> groups = data.groups();
  const double height = first_row + row_height * static_cast<double>(data.scenes.size()) +
                        (group_gap + 14) * static_cast<double>(groups.size());
  Svg svg(
      first_column + column_width * static_cast<double>(choice_tolerances.size()) + 20, height,
      "Arcs that a scene needs, and arcs that fam solve takes",
      "A table of numbers: a row a scene, a column an error from 1e-2 to 1e-8 of the rod's length. In each cell the "
      "fewest arcs that are within it, on the left, and the number that fam solve takes when asked for it, on the "
      "right; a tinted half has shear and stretch, a pale one has not. Look at how little the two differ.",
      "a column an accuracy: largest error of any place along the rod, over its length L; numbers: arcs, the smallest "
      "shared out by length");
  draw_key(svg);
  double y = first_row - group_gap + 8;
  for (const std::string& group : groups) {
    draw_head(svg, y, group);
    y += group_gap;
    for (const ChoiceScene* scene : data.of(group)) {
      svg.text({26, y + row_height - 6}, scene->name);
      svg.text({first_column - 12, y + row_height - 6},
               fmt::format("{}, {}", scene->facts.planar ? "plane" : "space",
                           scene->facts.march ? "march" : "boundary value"),
               Anchor::end, 11, "#666");
      for (std::size_t i = 0; i < choice_tolerances.size(); ++i) {
        draw_choice(svg, {first_column + column_width * static_cast<double>(i), y}, scene->chosen[i]);
      }
      y += row_height;
    }
    y += 14;
  }
  return svg.str();
}

}  // namespace studies
