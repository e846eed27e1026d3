// What a campaign asks of each scene. A scene's outcome is a function of kind of campaign, seed and index alone.
#pragma once

#include "studies/campaign/tally.h"
#include "studies/report/progress.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace studies {

struct CampaignKind {
  const char* name;
  const char* question;
  SceneOutcome (*outcome)(std::uint64_t campaign, std::uint64_t index);
};

// random    fam::solve to 1e-4 L: is the answer right? By the certificate (exact_reference/certificate.h), by the exact
//           reference where that doubts and on one scene of 100.
// audit     the same, every scene by both: does the certificate miss what the exact reference finds? Answers of FAM, of
//           FAM on a quarter of the arcs, and of plain shooting, which is often on another branch.
// promise   tolerances 1e-2 to 1e-8 L in turn: does the whole rod keep them?
// shape     a kept solver's poses and wrenches anywhere along the rod.
// batch     16 rods of a scene by fam::solve_batch, each beside a cold Solver.
std::span<const CampaignKind> campaign_kinds();
const CampaignKind& campaign_kind(const std::string& name);

struct CampaignSize {
  std::uint64_t scenes = 0, seed = 0, chunk = 100;
};

// All scenes 0 .. scenes - 1 by the processes at hand, their chunks, tables and scenes in the folder (engine.h,
// summary.h). The tally of all; empty in processes that do not lead and where one of the others failed.
Tally run_campaign(const CampaignKind& kind, const CampaignSize& size, const std::filesystem::path& folder,
                   Progress::Style style);

}  // namespace studies
