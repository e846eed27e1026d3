#include "fam/batch.h"
namespace fam {
// Provisional.
BatchResult solve_batch(const scene::Scene&, std::span<const BatchColumn>, Eigen::Ref<const RowMajorMatrix>,
                        const Options&) {
  return {};
}
}  // namespace fam
