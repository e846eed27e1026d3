#include "exact_reference/solution_vector.h"

#include <algorithm>
#include <cmath>

namespace exact_reference {
namespace {

using Eigen::VectorXd;

}  // namespace

NodeStates node_states_of(const VectorXd& x) {
  NodeStates y(static_cast<std::size_t>(x.size() / core_size), State::Zero());
  for (std::size_t k = 0; k < y.size(); ++k) {
    y[k].head<core_size>() = x.segment<core_size>(core_size * static_cast<long>(k));
  }
  return y;
}

VectorXd solution_of(const NodeStates& y, double parameter) {
  VectorXd x(core_size * static_cast<long>(y.size()) + 1);
  for (std::size_t k = 0; k < y.size(); ++k) {
    x.segment<core_size>(core_size * static_cast<long>(k)) = y[k].head<core_size>();
  }
  x.tail<1>()[0] = parameter;
  return x;
}

VectorXd interpolated(const VectorXd& a, const std::vector<double>& from, const std::vector<double>& to) {
  VectorXd result(core_size * static_cast<long>(to.size()) + 1);
  std::size_t i = 0;
  for (std::size_t k = 0; k < to.size(); ++k) {
    while (i + 2 < from.size() && to[k] > from[i + 1]) ++i;
    const double share = std::clamp((to[k] - from[i]) / (from[i + 1] - from[i]), 0.0, 1.0);
    const long first = core_size * static_cast<long>(i);
    result.segment<core_size>(core_size * static_cast<long>(k)) =
        (1 - share) * a.segment<core_size>(first) + share * a.segment<core_size>(first + core_size);
  }
  result.tail<1>() = a.tail<1>();
  return result;
}

VectorXd turned_about_axis(const VectorXd& x) {
  VectorXd turn = VectorXd::Zero(x.size());
  for (long i = 0; i + 1 < x.size(); i += core_size) {
    for (const long pair : {2, 5, 8}) {  // of q, N, M
      turn[i + pair] = -x[i + pair + 1];
      turn[i + pair + 1] = x[i + pair];
    }
  }
  return turn;
}

VectorXd any_vector(long size, double seed) {
  VectorXd v(size);
  for (long i = 0; i < size; ++i) v[i] = std::sin(seed + 1.7 * static_cast<double>(i * i));
  return v.normalized();
}

}  // namespace exact_reference
