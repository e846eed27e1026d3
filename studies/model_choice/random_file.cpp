#include "studies/compare/data_file.h"
#include "studies/model_choice/random_choice.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

namespace studies {
namespace {

const char* flag(bool is) {
  return is ? "1" : "0";
}

RandomChoice read(const DataRow& row) {
  const auto number = [&](const char* column, double otherwise) {
    return row.at(column).empty() ? otherwise : std::stod(row.at(column));
  };
  const auto is = [&](const char* column) { return row.at(column) == "1"; };
  RandomChoice c;
  c.seed = std::stoull(row.at("seed"));
  c.tolerance = number("tolerance_over_L", 0);
  c.status = row.at("status");
  c.judge = row.at("judge");
  c.space = is("space");
  c.shear = is("shear");
  c.march = is("march");
  c.gives_way = is("gives_way");
  c.arcs = static_cast<int>(number("arcs", 0));
  c.error = number("error_over_L", 0);
  c.exact_error = number("exact_error_over_L", -1);
  c.off_plane = number("off_plane_over_L", 0);
  c.shear_needed = is("shear_needed");
  c.arcs_looked_for = !row.at("fewest_arcs").empty();
  c.fewest_arcs = static_cast<int>(number("fewest_arcs", 0));
  c.fewer_by_another_law = is("fewer_by_another_law");
  return c;
}

}  // namespace

std::string random_csv(const std::vector<RandomChoice>& choices) {
  Table table({"seed", "kind", "tolerance_over_L", "status", "judge", "space", "shear", "march", "gives_way", "arcs",
               "error_over_L", "exact_error_over_L", "off_plane_over_L", "shear_needed", "fewest_arcs",
               "fewer_by_another_law"});
  for (const RandomChoice& c : choices) {
    const bool known = c.judged();
    table.add({std::to_string(c.seed), kind_of(c.seed), scientific(c.tolerance, 0), c.status, c.judge, flag(c.space),
               flag(c.shear), flag(c.march), flag(c.gives_way), std::to_string(c.arcs),
               known ? scientific(c.error, 1) : "", c.exact_error >= 0 ? scientific(c.exact_error, 1) : "",
               known && c.space ? scientific(c.off_plane, 1) : "", known && c.shear ? flag(c.shear_needed) : "",
               c.arcs_looked_for ? std::to_string(c.fewest_arcs) : "",
               c.arcs_looked_for ? flag(c.fewer_by_another_law) : ""});
  }
  return table.csv(
      {"judge: FAM asked for a thousandth of the tolerance, or the exact reference where that is no "
       "answer; exact_error: by it on every 25th scene.",
       "off_plane: how far the shape leaves the plane through the undeformed axis that suits it best."});
}

void add_random_choices(const std::filesystem::path& file, std::vector<RandomChoice>& choices) {
  const std::vector<DataRow> rows = data_rows(file);
  for (std::size_t i = choices.size(); i < rows.size(); ++i) choices.push_back(read(rows[i]));
}

}  // namespace studies
