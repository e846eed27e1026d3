// fam-studies sensing: loads estimated from noisy shapes of the exact reference; how far off, and how sure.
#include "studies/report/chart.h"
#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/sensing/data.h"
#include "studies/sensing/models.h"
#include "studies/sensing/observability.h"
#include "studies/sensing/placed_load.h"
#include "studies/sensing/trials.h"
#include "studies/study.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

struct SensingRow {
  std::string name;
  SensingSettings settings;
  SensingResult result;
};
using SensingRows = std::vector<SensingRow>;

// 10 000 trials where something is promised, else so few that all of it takes half a minute. The catheter is one truth.
SensingSettings settings_of(Sensing kind, double noise) {
  SensingSettings settings;
  settings.kind = kind;
  settings.noise = noise;
  const bool promised = (kind == Sensing::tip_pose || kind == Sensing::four_positions) && noise == 0.01;
  const bool contacts = kind == Sensing::two_contacts && noise == words_of(kind).noises.front();
  settings.truths = kind == Sensing::catheter      ? 1
                    : kind == Sensing::calibration ? 3
                    : promised                     ? 500
                    : contacts                     ? 100
                                                   : 10;
  settings.noises_each = kind == Sensing::catheter ? 50 : kind == Sensing::calibration ? 4 : promised ? 20 : 10;
  return settings;
}

SensingRows over_noise() {
  SensingRows rows;
  for (const Sensing kind : all_sensing) {
    for (const double noise : words_of(kind).noises)
      rows.push_back({words_of(kind).name, settings_of(kind, noise), {}});
  }
  return rows;
}

SensingRows over_sensors() {
  SensingRows rows;
  for (const int positions : {1, 2, 4, 8, 20}) {
    SensingSettings settings = settings_of(Sensing::four_positions, 0.03);
    settings.positions = positions;
    rows.push_back({std::to_string(positions), settings, {}});
  }
  return rows;
}

// What the model has wrong, at a noise that hides it and at one that does not.
SensingRows over_models() {
  SensingRows rows;
  for (const double noise : {0.01, 0.1}) {
    const SensingSettings right = settings_of(Sensing::four_positions, noise);
    const auto add = [&](const char* name, const auto& change) {
      SensingRow row{name, right, {}};
      row.settings.truths = 5;
      row.settings.noises_each = 10;
      change(row.settings);
      rows.push_back(row);
    };
    add("nothing", [](SensingSettings&) {});
    add("5 % too stiff", [](SensingSettings& s) { s.mismatch = Mismatch::stiffer; });
    add("a force of 0.1 EI/L² at L/2 missing", [](SensingSettings& s) { s.mismatch = Mismatch::load_missing; });
    add("Kirchhoff, of a rod as thick as L/10", [](SensingSettings& s) { s.mismatch = Mismatch::thick_rod; });
  }
  return rows;
}

void run(SensingRows& rows, const StudyOptions& options) {
  for (SensingRow& row : rows) row.result = run_trials(row.settings, options.cases, options.progress);
}

Table table_of(const SensingRows& rows, const char* first) {
  Table table({first, "noise", "trials", "error", "predicted sd", "across: error", "predicted", "NEES", "expected",
               "95 % band", "in it", "chi-squared too large", "not converged", "unobservable", "wrong",
               "wrong, chi-squared passes"});
  for (const auto& [name, settings, r] : rows) {
    table.add({name, fmt::format("{:g}", settings.noise), std::to_string(r.trials), significant(r.error, 2),
               significant(r.predicted_sd, 2), significant(r.error_across, 2), significant(r.predicted_across, 2),
               significant(r.nees, 3), std::to_string(r.unknowns), "±" + significant(r.band(), 2),
               r.in_band() ? "yes" : "no", std::to_string(r.unfit), std::to_string(r.not_converged),
               std::to_string(r.unobservable), std::to_string(r.wrong), std::to_string(r.wrong_and_fitting)});
  }
  return table;
}

// Error (full) and predicted deviation (dashed) of the force across the rod, over the noise.
std::string noise_picture(const SensingRows& rows) {
  Svg svg(760, 440, "Does the error grow as predicted?",
          "Root mean square error of the force and its predicted deviation over the noise of positions, logarithmic.",
          "full: error; dashed: predicted sd; of the force across the rod");
  Panel panel(svg, {80, 66}, 560, 310, {"noise of a position, mm", 0.009, 1.2, true},
              {"force across the rod, N", 1e-6, 10, true});
  panel.frame();
  const std::pair<Sensing, std::string> curves[] = {
      {Sensing::tip_pose, colour::blue}, {Sensing::four_positions, colour::orange}, {Sensing::catheter, colour::green}};
  for (const auto& [kind, tint] : curves) {
    std::vector<Point> error, predicted;
    for (const auto& [name, settings, r] : rows) {
      if (settings.kind != kind || r.counted() == 0) continue;
      error.push_back({settings.noise, std::clamp(r.error_across, 1e-6, 10.0)});
      predicted.push_back({settings.noise, std::clamp(r.predicted_across, 1e-6, 10.0)});
    }
    panel.curve(error, {tint, 1.8, ""});
    panel.curve(predicted, {tint, 1.4, "5 4"});
    if (!error.empty()) panel.name(error[error.size() / 2], words_of(kind).name, tint);
  }
  panel.place_names();
  return svg.str();
}

std::string sensors_picture(const SensingRows& rows) {
  std::vector<Point> error, predicted;
  for (const auto& [name, settings, r] : rows) {
    error.push_back({static_cast<double>(settings.positions), r.error_across});
    predicted.push_back({static_cast<double>(settings.positions), r.predicted_across});
  }
  Svg svg(760, 440, "What are more sensors worth?", "Error of the tip force over the number of measured positions.",
          "full: error; dashed: predicted sd; positions to 0.03 mm");
  Panel panel(svg, {80, 66}, 560, 310, {"positions along the rod", 0.9, 25, true},
              {"force across the rod, N", 1e-5, 0.1, true});
  panel.frame();
  panel.curve(error, {colour::orange, 1.8, ""});
  panel.curve(predicted, {colour::orange, 1.4, "5 4"});
  return svg.str();
}

std::map<std::string, std::string> files_of(const SensingRows& noises, const SensingRows& sensors,
                                            const SensingRows& models, const StudyOptions& options) {
  const auto row_of = [&](Sensing kind) -> const SensingResult& {
    const auto is_kind = [&](const SensingRow& row) { return row.settings.kind == kind; };
    return std::find_if(noises.begin(), noises.end(), is_kind)->result;
  };
  const SensingResult &pose = row_of(Sensing::tip_pose), &four = row_of(Sensing::four_positions),
                      &contacts = row_of(Sensing::two_contacts);
  const auto share = [](const SensingResult& r) { return fmt::format("{} of {}", r.wrong_and_fitting, r.trials); };
  Page page;
  page.set("trials", std::to_string(pose.trials));
  page.set("truths", std::to_string(settings_of(Sensing::tip_pose, 0.01).truths));
  page.set("pose_nees", significant(pose.nees, 3));
  page.set("four_nees", significant(four.nees, 3));
  page.set("band", significant(four.band(), 2));
  page.check("kept", pose.in_band() && four.in_band());
  page.set("pose_wrong", share(pose));
  page.set("four_wrong", share(four));
  page.set("contact_trials", std::to_string(contacts.trials));
  page.set("places", std::to_string(contacts.places));
  page.set("place_share",
           fmt::format("{:.1f} %", 100 - 100.0 * contacts.place_beyond_3sd / std::max(contacts.places, 1)));
  page.set("contacts_lost", std::to_string(contacts.not_converged + contacts.unobservable));
  page.set("contacts_wrong", share(contacts));
  page.set("noise_table", table_of(noises, "problem").markdown());
  page.set("sensor_table", table_of(sensors, "positions").markdown());
  page.set("model_table", table_of(models, "wrong with the model").markdown());
  const PlacedLoads placed = placed_loads(options.cases, options.progress);
  page.set("placed_table", placed.table.markdown());
  page.set("placed_trials", std::to_string(placed.trials));
  page.set("placed_lost", std::to_string(placed.no_answer));
  page.set("placed_hidden", std::to_string(placed.unobservable));
  page.set("placed_higher", std::to_string(placed.not_lowest));
  page.set("placed_far", std::to_string(placed.far_off));
  const Table starts = starts_table(options.cases), laws = laws_table(), times = times_table(options.cases);
  page.set("starts_table", starts.markdown());
  page.set("laws_table", laws.markdown());
  page.set_time("times_table", times.markdown());
  const std::string answer = fmt::format(
      "a tip force from positions to 0.01 mm, {} synthetic trials: NEES {} from the tip's pose, {} from four "
      "positions, where 3 ± {} is expected",
      four.trials, significant(pose.nees, 3), significant(four.nees, 3), significant(four.band(), 2));
  return {{"noise.csv", table_of(noises, "problem").csv({"Synthetic; error and predicted sd are root mean squares."})},
          {"sensors.csv", table_of(sensors, "positions").csv({"Tip force from n positions to 0.03 mm."})},
          {"models.csv", table_of(models, "wrong with the model").csv({"Tip force from four positions."})},
          {"noise.svg", noise_picture(noises)},
          {"sensors.svg", sensors_picture(sensors)},
          {"starts.csv", starts.csv({"Twelve starts for each of 20 truths."})},
          {"placed.csv", placed.table.csv({"One load, its place unknown, between sensors of curvature."})},
          {"laws.csv", laws.csv({"A follower's tip force from four positions without noise."})},
          {"timing.csv", times.csv({"One run, 200 estimates a problem."})},
          {"README.md", page.fill(options.pages / "sensing" / "page.md")},
          {answers_file, answers_json({{"how_sure", answer}})}};
}

}  // namespace

void sensing(const StudyOptions& options) {
  SensingRows noises = over_noise(), sensors = over_sensors(), models = over_models();
  for (SensingRows* rows : {&noises, &sensors, &models}) run(*rows, options);
  std::map<std::string, std::string> files = files_of(noises, sensors, models, options);
  files.merge(sensing_data(options.cases));
  files.merge(observability_files());
  write_results(options.output / "sensing", "fam-studies sensing", files);
}

}  // namespace studies
