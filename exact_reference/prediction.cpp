#include "exact_reference/prediction.h"

#include <Eigen/Geometry>

#include <utility>

namespace exact_reference {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond quaternion(const Eigen::Vector4d& q) {
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace

Prediction::Rates Prediction::rates_of(const State& y, const Core& tangent) {
  const Quaterniond q = quaternion(y.head<4>());
  const Vector3d turn_B = 2 * (quaternion(tangent.head<4>()) * q.conjugate()).vec();
  const Vector3d moment_B = tangent.segment<3>(7) - turn_B.cross(y.segment<3>(7));
  Rates rates;
  rates << turn_B, tangent.segment<3>(4), q.conjugate() * moment_B;
  return rates;
}

void Prediction::start_at(const NodeStates& y, double load, const std::vector<Core>& tangent) {
  last_rates_ = std::exchange(rates_, {});
  for (std::size_t k = 0; k < y.size(); ++k) rates_.push_back(rates_of(y[k], tangent[k]));
  last_step_ = is_smooth() ? load - load_ : 0;
  load_ = load;
}

bool Prediction::is_smooth() const {
  constexpr double small = 0.5;
  if (last_rates_.size() != rates_.size()) return false;
  double change = 0, size = 0;
  for (std::size_t k = 0; k < rates_.size(); ++k) {
    change += (rates_[k] - last_rates_[k]).squaredNorm();
    size += rates_[k].squaredNorm();
  }
  return change <= small * small * size;
}

NodeStates Prediction::ahead(const NodeStates& y, double step) const {
  NodeStates result = y;
  for (std::size_t k = 0; k < y.size(); ++k) {
    Rates change = step * rates_[k];
    if (last_step_ > 0) change += step * step / (2 * last_step_) * (rates_[k] - last_rates_[k]);
    const Quaterniond q = quaternion(y[k].head<4>());
    const Vector3d turn_B = change.head<3>();
    const Quaterniond next = Eigen::AngleAxisd(turn_B.norm(), turn_B.stableNormalized()) * q;
    result[k].head<4>() << next.w(), next.vec();
    result[k].segment<3>(4) += change.segment<3>(3);
    result[k].segment<3>(7) = next * Vector3d(q.conjugate() * Vector3d(y[k].segment<3>(7)) + change.tail<3>());
  }
  return result;
}

}  // namespace exact_reference
