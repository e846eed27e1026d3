#include "fam/solve.h"

#include "fam/embedding.h"
#include "fam/tolerance.h"
#include "scene/load_visitor.h"

namespace fam {
namespace {

using scene::Equilibrium;
using scene::Span;
using scene::Status;

// Why the published law cannot take a load, empty where it can.
std::string beyond_published(const scene::Load& load) {
  return scene::visit_load(
      load,
      [](const scene::Force& force) { return force.frame == scene::Frame::fixed ? "a force in a fixed frame" : ""; },
      [](const scene::Moment& moment) {
        return moment.frame == scene::Frame::fixed ? "a moment in a fixed frame" : "";
      },
      [](const scene::DistributedForce&) { return "a distributed force"; },
      [](const scene::Gravity&) { return "gravity"; },  //
      [](const scene::Tendon&) { return ""; });
}

std::string unsupported(const scene::Scene& scene, std::span<const Span> spans, const Options& options) {
  if (facts_of(options.law).coupled) return {};
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const std::string what = beyond_published(scene.loads[i]);
    if (!what.empty()) return "loads[" + std::to_string(i) + "]: the published law cannot solve " + what;
  }
  if (options.model == RodModel::reissner) return "the published law is a Kirchhoff rod's: no shear, no stretch";
  for (const Span& span : spans) {
    if (span.stiffness.bending_Nmm2[0] != span.stiffness.bending_Nmm2[1]) {
      return "the published law needs sections with one bending stiffness, EI_y = EI_z";
    }
  }
  return {};
}

}  // namespace

Equilibrium solve(const scene::Scene& scene, const Options& options) {
  const std::vector<Span> spans = scene::spans_of(scene);
  const std::string why_not = unsupported(scene, spans, options);
  if (!why_not.empty()) {
    Equilibrium result;
    result.status = Status::unsupported;
    result.message = why_not;
    return result;
  }
  const double tolerance_mm = options.tolerance_mm > 0 ? options.tolerance_mm : 1e-3 * spans.back().end_mm;
  const Choice choice = choose(spans, options, tolerance_mm);
  const Task task{scene, spans, choice.solved_spans(spans), options, choice, tolerance_mm};
  return options.arcs > 0 ? solve_fixed(task) : solve_to_tolerance(task);
}

std::optional<Prepared> prepare(const scene::Scene& scene, const Options& options, std::string& reason) {
  const std::vector<Span> spans = scene::spans_of(scene);
  reason = unsupported(scene, spans, options);
  if (!reason.empty()) return std::nullopt;
  std::vector<int> arcs = scene::cells_per_span(spans, options.arcs);
  Choice choice = choose(spans, options, options.tolerance_mm);
  Engine solver = make_engine(spans, arcs, choice, options);
  const std::span<const Span> solved = choice.solved_spans(spans);
  std::vector<Span> solved_spans(solved.begin(), solved.end());
  return Prepared{std::move(solver), std::move(choice), std::move(solved_spans), std::move(arcs)};
}

Status run_prepared(Prepared& prepared) {
  const Status status = std::visit([](auto& solver) { return solver.run(); }, prepared.solver);
  if (status != Status::converged) return status;
  return verdict(prepared.solver, prepared.choice.law,
                 extent_of_arcs(prepared.solver, prepared.spans, prepared.arcs_per_span));
}

std::vector<Arc> arcs_of(const Prepared& prepared) {
  const Matrix3d rotation = prepared.choice.rotation_BP();
  std::vector<Arc> result;
  std::visit(
      [&](const auto& solver) {
        result.reserve(solver.arcs().size());
        for (const auto& arc : solver.arcs()) {
          result.push_back(
              {{rotation * embedded_angular(arc.screw.rotation), rotation * embedded(arc.screw.translation_mm)},
               arc.twist_before_rad,
               arc.twist_after_rad});
        }
      },
      prepared.solver);
  return result;
}

std::vector<SectionPose> poses_of(const Prepared& prepared) {
  const Matrix3d rotation = prepared.choice.rotation_BP();
  std::vector<SectionPose> result;
  std::visit(
      [&](const auto& solver) {
        result.reserve(solver.poses().size());
        for (const auto& pose : solver.poses()) result.push_back(in_base(pose, rotation));
      },
      prepared.solver);
  return result;
}

}  // namespace fam
