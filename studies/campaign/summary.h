// The files of a whole campaign beside its chunks.
#pragma once

#include "studies/campaign/tally.h"

#include <filesystem>

namespace studies {

// counts.csv, histograms.csv, worst.csv, failures.csv, and the scenes of the first failures and of the worst of each
// measure as scene files in scenes/.
void write_summary(const Tally& tally, std::uint64_t campaign, const std::filesystem::path& folder);

// Upper bound with 95 % confidence of a rate of which `found` of `asked` were seen (Clopper-Pearson; none found: 1 -
// 0.05^(1/asked), the rule of three).
double rate_bound(std::uint64_t found, std::uint64_t asked);

}  // namespace studies
