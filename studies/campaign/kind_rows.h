// What the kinds of campaign share, and their rows for kinds.cpp.
#pragma once

#include "studies/campaign/kinds.h"
#include "studies/scenes/random_scene.h"

namespace studies {

extern const CampaignKind random_kind, audit_kind, promise_kind, shape_kind, batch_kind;

// One of `every`, of all kinds of scene, which go by the index's last digit.
inline bool in_sample(std::uint64_t index, std::uint64_t every) {
  return index / 10 % every == 0;
}

inline SceneOutcome started(std::uint64_t campaign, std::uint64_t index) {
  return {index, kind_of(campaign_seed(campaign, index)), {}, false, {}};
}

inline void set_failure(SceneOutcome& outcome, const std::string& words) {
  outcome.outcome = words;
  outcome.failure = true;
}

}  // namespace studies
