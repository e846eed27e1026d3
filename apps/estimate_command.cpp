#include "apps/estimate_command.h"

#include "fam/estimator.h"
#include "scene/estimation_file.h"
#include "scene/json_file.h"
#include "scene/scene_file.h"
#include "studies/compare/stopwatch.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace apps {
namespace {

using scene::Json;
using scene::Unknown;

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// As the file names it.
Json keys_of(const Unknown& unknown, const scene::EstimationProblem& problem) {
  using Kind = Unknown::Kind;
  Json json;
  const bool of_load = unknown.kind == Kind::component || unknown.kind == Kind::place;
  if (of_load && problem.scenes.size() > 1) json["scene"] = unknown.scene;
  json[of_load ? "load" : "section"] = unknown.index;
  if (unknown.kind == Kind::place) json["at_mm"] = true;
  if (unknown.kind == Kind::bending_factor) json["bending_factor"] = true;
  if (unknown.kind == Kind::torsion_factor) json["torsion_factor"] = true;
  if (unknown.kind == Kind::rest_curvature)
    json[unknown.component == 1 ? "rest_curvature_y" : "rest_curvature_z"] = true;
  if (unknown.kind == Kind::component) {
    const std::string name = scene::name_of(unknown, problem);
    const std::size_t dot = name.rfind('.', name.find(','));
    json["component"] = name.substr(dot + 1, name.find(',') - dot - 1);
  }
  if (unknown.prior_sd) {
    json["prior_mean"] = unknown.prior_mean;
    json["prior_sd"] = *unknown.prior_sd;
  }
  return json;
}

// "0.71 loads[0].x - 0.71 loads[1].x", each unknown in its own unit.
std::string in_words(const Eigen::VectorXd& direction, const scene::EstimationProblem& problem) {
  std::string text;
  for (Eigen::Index k = 0; k < direction.size(); ++k) {
    if (direction[k] == 0) continue;
    const std::string name = scene::name_of(problem.unknowns[static_cast<std::size_t>(k)], problem);
    const char* sign = direction[k] < 0 ? (text.empty() ? "-" : " - ") : (text.empty() ? "" : " + ");
    text += fmt::format("{}{:.3g} {}", sign, std::abs(direction[k]), name.substr(0, name.find(',')));
  }
  return text;
}

Json scene_json(const scene::Scene& scene) {
  return Json::parse(scene::write_scene(scene));
}

std::string to_json(const fam::Estimate& estimate, const scene::EstimationProblem& problem, double time_us) {
  Json json{{"status", scene::name(estimate.status)}};
  if (!estimate.message.empty()) json["message"] = estimate.message;
  json["unknowns"] = Json::array();
  const bool solved = estimate.converged();
  const auto count = static_cast<Eigen::Index>(problem.unknowns.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    Json entry = keys_of(problem.unknowns[static_cast<std::size_t>(k)], problem);
    entry["mean"] = solved ? number_or_null(estimate.mean[k]) : Json(nullptr);
    entry["sd"] = solved ? number_or_null(estimate.sd[k]) : Json(nullptr);
    entry["observable"] =
        solved ? Json(static_cast<bool>(estimate.observable[static_cast<std::size_t>(k)])) : Json(nullptr);
    json["unknowns"].push_back(entry);
  }
  json["covariance"] = nullptr;
  json["chi_squared"] = json["degrees_of_freedom"] = json["fits"] = nullptr;
  json["unobservable"] = Json::array();
  if (solved) {
    json["covariance"] = Json::array();
    for (Eigen::Index i = 0; i < count; ++i) {
      Json row = Json::array();
      for (Eigen::Index k = 0; k < count; ++k) row.push_back(number_or_null(estimate.covariance(i, k)));
      json["covariance"].push_back(row);
    }
    json["chi_squared"] = estimate.chi_squared;
    json["degrees_of_freedom"] = estimate.degrees_of_freedom;
    json["fits"] = estimate.fits;
    for (const Eigen::VectorXd& direction : estimate.unobservable) {
      const std::vector<double> combination(direction.begin(), direction.end());
      json["unobservable"].push_back({{"combination", combination}, {"text", in_words(direction, problem)}});
    }
    if (problem.scenes.size() == 1) {
      json["scene"] = scene_json(estimate.problem.scenes.front().scene);
    } else {
      json["scenes"] = Json::array();
      for (const scene::MeasuredScene& each : estimate.problem.scenes) json["scenes"].push_back(scene_json(each.scene));
    }
  }
  json["iterations"] = estimate.iterations;
  json["time_us"] = time_us;
  return json.dump(2) + "\n";
}

std::string to_text(const fam::Estimate& estimate, const scene::EstimationProblem& problem, double time_us) {
  std::string text = fmt::format("estimated in {:.3g} us, {} iterations\n\n", time_us, estimate.iterations);
  for (std::size_t k = 0; k < problem.unknowns.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const std::string name = scene::name_of(problem.unknowns[k], problem);
    text += estimate.observable[k] ? fmt::format("{:36}{:14.6g} +- {:.2g}\n", name, estimate.mean[i], estimate.sd[i])
                                   : fmt::format("{:36}not observable\n", name);
  }
  for (const Eigen::VectorXd& direction : estimate.unobservable)
    text += fmt::format("not observable: {}\n", in_words(direction, problem));
  text += fmt::format("\nchi-squared {:.4g} with {} degrees of freedom: {}\n", estimate.chi_squared,
                      estimate.degrees_of_freedom, estimate.fits ? "the model fits" : estimate.message);
  return text;
}

}  // namespace

CLI::App* add_estimate_command(CLI::App& app, EstimateArguments& arguments) {
  CLI::App* estimate = app.add_subcommand("estimate", "Find loads, places and stiffness from measured shape");
  add_scene_and_options(estimate, arguments.path, arguments.fam, "Estimation file (JSON), or - for standard input");
  estimate->add_option("--format", arguments.format, "Output")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  return estimate;
}

int run_estimate(const EstimateArguments& arguments) {
  const scene::EstimationProblem problem = scene::read_estimation_file(arguments.path);
  fam::Estimate estimate;
  const double time_us =
      1e6 * studies::seconds_of([&] { estimate = fam::Estimator(problem, arguments.fam).estimate(); });
  if (arguments.format == "json") fmt::print("{}", to_json(estimate, problem, time_us));
  else if (estimate.converged()) fmt::print("{}", to_text(estimate, problem, time_us));
  if (estimate.converged()) return exit_solved;
  const std::string source = arguments.path == "-" ? "(standard input)" : arguments.path;
  fmt::print(stderr, "{}: {}: {}\n", source, scene::name(estimate.status), estimate.message);
  return exit_not_converged;
}

}  // namespace apps
