// fam-studies population: sets of loads by the thousand through every mechanism, beside the statistics that the paper
// prints. With --quick the first sets are solved, all else is read back from results/.
#include "studies/population/data.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/study.h"

#include <fstream>
#include <iterator>

namespace studies {
namespace {

TextFiles solved_files(const StudyOptions& options) {
  const PopulationRod rod;
  const PrintedStudy printed = printed_study1();
  const Targets targets = reconciled(printed);
  const PopulationSample sample = sample_population(rod, population_sets, options.progress);
  TextFiles files = shown_files(rod, sample);
  files["printed.csv"] = printed_csv(printed, targets);
  files["verdicts.csv"] = verdicts_csv(sample, targets);
  files["distributions.csv"] = distributions_csv(sample, targets);
  files["redrawn.csv"] = redrawn_csv(sample);
  files["twins.csv"] = twins_csv(trace_back(sample, twin_trials));
  files["trends.csv"] = trends_csv(count_trends(trend_sets, options.progress));
  files["beam_cases.csv"] = beam_csv(check_against_beam(options.progress));
  files["beam_statistics.csv"] = beam_statistics_csv(check_statistics(options.progress));
  return files;
}

// Of before, but for what is solved again.
TextFiles committed_files(const StudyOptions& options) {
  const PopulationRod rod;
  const PrintedStudy printed = printed_study1();
  TextFiles files = shown_files(rod, sample_population(rod, shown_sets, options.progress));
  files["printed.csv"] = printed_csv(printed, reconciled(printed));
  for (const char* name : {"verdicts.csv", "distributions.csv", "redrawn.csv", "twins.csv", "trends.csv",
                           "beam_cases.csv", "beam_statistics.csv"}) {
    const std::filesystem::path path = options.committed / "population" / name;
    std::ifstream file(path);
    if (!file) throw scene::SceneError(path.string() + ": cannot be read; --quick needs the committed run");
    files[name] = std::string(std::istreambuf_iterator<char>(file), {});
  }
  return files;
}

}  // namespace

void population(const StudyOptions& options) {
  const std::filesystem::path folder = options.output / "population";
  TextFiles files = options.quick ? committed_files(options) : solved_files(options);
  write_files(folder, files);  // the page is written from them
  files.merge(population_pictures(folder));
  files.merge(population_page(folder, options.pages / "population" / "page.md"));
  write_results(folder, "fam-studies population", files);
}

}  // namespace studies
