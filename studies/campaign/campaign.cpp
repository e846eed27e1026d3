// fam-studies campaign: the campaigns `random` and `audit`, and their page. A stopped run goes on where it was. With
// --quick the first scenes of both are judged, the whole is read back from results/.
#include "studies/campaign/data.h"
#include "studies/campaign/kinds.h"
#include "studies/engine/engine.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/study.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace studies {
namespace {

struct Part {
  const char* kind;
  std::uint64_t seed, scenes, chunk;
};

// The chunks of `random` are few enough to be committed: its run goes on from them on another machine.
constexpr Part random_part{"random", 1, 1'000'000, 10'000}, audit_part{"audit", 2, 100'000, 100};
constexpr std::uint64_t first_scenes = 60;

std::string text_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Tally whole(const Part& part, const StudyOptions& options) {
  if (options.quick)
    return Tally::from_text(text_in(options.committed / "campaign" / (std::string(part.kind) + ".csv")));
  return run_campaign(campaign_kind(part.kind), {part.scenes, part.seed, part.chunk},
                      options.output / "campaign" / "runs" / part.kind, options.progress);
}

// Of the runs that timing.csv holds, by number of ranks.
std::string timing_text(const StudyOptions& options) {
  std::ifstream file(options.committed / "campaign" / "timing.csv");
  std::string line, text;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::size_t a = line.find(','), b = line.find(',', a + 1), c = line.find(',', b + 1);
    text +=
        fmt::format("{}{} scenes by {} in {} s: {} a second", text.empty() ? "" : "; ", line.substr(a + 1, b - a - 1),
                    line.substr(0, a) == "1" ? "one process" : line.substr(0, a) + " ranks",
                    line.substr(b + 1, c - b - 1), line.substr(c + 1));
  }
  return text.empty() ? "Not timed." : text + ".";
}

}  // namespace

void campaign(const StudyOptions& options) {
  CampaignData data{whole(random_part, options), whole(audit_part, options), {}, timing_text(options)};
  for (const Part& part : {random_part, audit_part}) {
    for (std::uint64_t index = 0; index < first_scenes; ++index)
      data.first.add(campaign_kind(part.kind).outcome(part.seed, index));
  }
  write_results(options.output / "campaign", "fam-studies campaign",
                campaign_files(data, options.pages / "campaign" / "page.md"));
}

}  // namespace studies
