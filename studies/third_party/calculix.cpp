#include "studies/compare/stopwatch.h"
#include "studies/report/output_file.h"
#include "studies/third_party/data.h"
#include "studies/third_party/deck.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace studies {

namespace {

// The load that the last increment reached; of an attempt that was cut back (it ends in U), what was reached before.
double load_share_of(const std::filesystem::path& status_file) {
  std::ifstream lines(status_file);
  double share = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string step, increment, attempt, iterations;
    double time = 0;
    if (words >> step >> increment >> attempt >> iterations >> time) share = time;
  }
  return share;
}

}  // namespace

bool calculix_is_there() {
  return std::system("command -v ccx >/dev/null 2>&1") == 0;
}

ThirdPartyTip solve_by_calculix(const scene::Scene& scene, int elements) {
  return solve_by_calculix(scene, deck(scene, scene.title, DeckFormat::calculix, elements), elements);
}

ThirdPartyTip solve_by_calculix(const scene::Scene& scene, const std::string& text, int elements) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("fam_calculix_" + std::to_string(getpid()));
  write_file(folder / "job.inp", text);
  ThirdPartyTip tip{"", calculix_key, elements, "not_converged"};
  int status = 0;
  tip.time_us =
      1e6 * seconds_of([&] { status = std::system(("cd '" + folder.string() + "' && ccx job >log 2>&1").c_str()); });
  std::vector<std::string> words;
  std::ifstream output(folder / "job.dat");
  for (std::string word; output >> word;) words.push_back(word);
  if (status == 0 && words.size() >= 4) {
    tip.status = "converged";
    for (int i = 0; i < 3; ++i) tip.position_mm[i] = std::stod(words[words.size() - 3 + static_cast<std::size_t>(i)]);
    tip.position_mm[0] += scene::length_mm(scene);
  }
  tip.load_share = load_share_of(folder / "job.sta");
  std::filesystem::remove_all(folder);
  return tip;
}

}  // namespace studies
