// fam-studies random: solves and judges 10 000 random scenes, asks on 10 000 whether the tolerance is kept and on 20
// 000 strips and heavy rods whether the estimate tells the error, and writes results/random. Half an hour on two cores;
// a stopped run goes on where it was.
#include "studies/random/blocks.h"
#include "studies/random/page.h"
#include "studies/report/provenance.h"
#include "studies/scenes/random_scene.h"
#include "studies/study.h"

namespace studies {
namespace {

struct Sizes {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> seeds;
  std::uint64_t promises, estimates;
};

const Sizes whole = {{{0, 5000}, {100'000, 102'000}, {200'000, 203'000}}, 10'000, 20'000};
const Sizes small = {{{0, 1000}}, 200, 200};

}  // namespace

void random(const StudyOptions& options) {
  const Sizes& sizes = options.quick ? small : whole;
  const std::filesystem::path folder = options.output / "random", blocks = folder / "blocks";
  std::filesystem::remove_all(blocks);  // of other code, or half done: it would be skipped
  for (const auto& [from, to] : sizes.seeds) run_blocks(from, to, blocks, options.progress);
  second_opinions(blocks);
  const RandomData data{all_outcomes(blocks), all_promises(sizes.promises, mixed_seed, options.progress),
                        all_promises(sizes.estimates, estimate_seed, options.progress)};
  write_results(folder, "fam-studies random", random_files(data, options.pages / "random" / "page.md"));
}

}  // namespace studies
