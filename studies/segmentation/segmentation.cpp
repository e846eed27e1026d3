// fam-studies segmentation: reads studies/cases/study1/{P,S}{1..8}_follower.json and _fixed.json, marches them with 1
// to 1 000 000 arcs, finds the fewest arcs for a wanted error and the load that N arcs carry, runs the ablation
// (ablation.h), and writes tables, pictures and pages to results/segmentation. Some thirty seconds.
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/segmentation/ablation.h"
#include "studies/segmentation/sweep.h"
#include "studies/study.h"

namespace studies {
namespace {

void take_times(const StudyOptions& options, const std::map<std::string, scene::Scene>& scenes,
                SegmentationData& data) {
  for (const SweepLaw& law : sweep_laws()) {
    for (const int arcs : all_arcs) {
      if (options.quick && arcs > 10'000) continue;
      const auto march = law.row(law.with(arcs))->bare_solve(scenes.at("P4"));
      data.times.push_back({"P4", law.key, arcs, time_of(options, march)});
    }
  }
  for (const std::string& load_case : study1_cases()) {
    const auto solve = method_row("fam")()->bare_solve(scenes.at(load_case));
    data.times.push_back({load_case, "fam", 0, time_of(options, solve)});
  }
}

}  // namespace

void segmentation(const StudyOptions& options) {
  const auto read = [&](const std::string& name) { return read_case(options.cases, "study1/" + name); };
  Progress progress("segmentation", study1_cases().size() + 3, options.progress);
  std::map<std::string, scene::Scene> scenes;
  SegmentationData data;
  for (const std::string& load_case : study1_cases()) {
    progress.step(load_case);
    scenes[load_case] = read(load_case + "_follower");
    sweep_case(load_case, scenes[load_case], read(load_case + "_fixed"), data);
    find_fewest_arcs(load_case, scenes[load_case], data);
  }
  const scene::Scene& p4 = scenes.at("P4");
  data.p4 = cantilever_of(p4);
  draw_shapes(p4, data);
  progress.step("budgets");
  find_budgets(p4, data);
  progress.step("ablation");
  const Eigen::Vector3d fe_tip_mm = method_row("fe")()->solve(p4).tip().position_B_mm;
  const AblationData ablation = run_ablation(data.p4, fe_tip_mm.head<2>());
  progress.step("times");
  take_times(options, scenes, data);

  const std::filesystem::path words = options.pages / "segmentation";
  std::map<std::string, std::string> files = segmentation_tables(data);
  files.merge(segmentation_pictures(data));
  files.merge(segmentation_pages(data, words / "page.md"));
  files.merge(ablation_files(ablation, data.reference("P4").frame_mm, words / "ablation_page.md"));
  write_results(options.output / "segmentation", "fam-studies segmentation", files);
}

}  // namespace studies
