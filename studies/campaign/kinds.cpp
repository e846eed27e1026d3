#include "studies/campaign/kinds.h"

#include "studies/campaign/kind_rows.h"

namespace studies {

std::span<const CampaignKind> campaign_kinds() {
  static const CampaignKind kinds[] = {random_kind, audit_kind, promise_kind, shape_kind, batch_kind};
  return kinds;
}

}  // namespace studies
