#include "studies/study.h"

#include "scene/scene_file.h"
#include "studies/output_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace studies {

void progress(const std::string& study, const std::string& what) {
  fmt::print(stderr, "{}: {}\n", study, what);
}

scene::Scene read_case(const StudyOptions& options, const std::string& name) {
  return scene::read_scene_file((options.cases / (name + ".json")).string());
}

void write_index(const std::filesystem::path& output) {
  std::string text =
      "# Results\n\nWritten by `./reproduce`. Accuracy is deterministic and compared in the tests; timing is not, and\n"
      "stands in files of its own. Each folder has its page, its CSV files, its pictures and its `provenance.json`.\n";
  for (const char* study : {"study1", "fe_verification", "benchmarks", "segmentation", "torsion", "study2",
                            "work_precision", "stability"}) {
    std::ifstream headline(output / study / "headline.md");
    if (headline) text += "\n" + std::string(std::istreambuf_iterator<char>(headline), {});
  }
  write_file(output / "README.md", text);
}

}  // namespace studies
