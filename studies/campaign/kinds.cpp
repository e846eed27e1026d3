#include "studies/campaign/kinds.h"

#include "studies/campaign/kind_rows.h"
#include "studies/campaign/summary.h"
#include "studies/engine/engine.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {

std::span<const CampaignKind> campaign_kinds() {
  static const CampaignKind all[] = {random_kind, audit_kind, promise_kind, shape_kind, batch_kind};
  return all;
}

const CampaignKind& campaign_kind(const std::string& name) {
  const auto kinds = campaign_kinds();
  return *std::find_if(kinds.begin(), kinds.end(), [&](const CampaignKind& kind) { return name == kind.name; });
}

Tally run_campaign(const CampaignKind& kind, const CampaignSize& size, const std::filesystem::path& folder,
                   Progress::Style style) {
  const CampaignPlan plan{kind.name, fmt::format("seed {}", size.seed), size.scenes, size.chunk, folder};
  Crew crew;
  const auto work = [&](std::uint64_t from, std::uint64_t to, const std::function<void()>& help) {
    Tally tally;
    for (std::uint64_t index = from; index < to; ++index) {
      tally.add(kind.outcome(size.seed, index));
      help();
    }
    return tally.text();
  };
  Tally whole;
  if (!run_chunks(crew, plan, work, style) || !crew.leads()) return whole;
  read_chunks(plan, [&](const std::string& text) { whole.add(Tally::from_text(text)); });
  write_summary(whole, size.seed, folder);
  return whole;
}

}  // namespace studies
