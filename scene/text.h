// Numbers as error messages show them.
#pragma once

#include <Eigen/Core>

#include <charconv>
#include <string>

namespace scene {

// The fewest digits that give the same double.
inline std::string text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

// "[1, 2, 3]"
template <class Vector>
std::string text(const Eigen::MatrixBase<Vector>& values) {
  std::string list = "[";
  for (int i = 0; i < values.size(); ++i) list += (i ? ", " : "") + text(static_cast<double>(values[i]));
  return list + "]";
}

}  // namespace scene
