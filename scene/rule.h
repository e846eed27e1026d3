// One rule of a file's format: a value that breaks it is named by one line.
#pragma once

#include "scene/scene.h"

#include <charconv>

namespace scene {

inline std::string text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

template <class Vector>
std::string text(const Eigen::MatrixBase<Vector>& values) {
  std::string list = "[";
  for (int i = 0; i < values.size(); ++i) list += (i ? ", " : "") + text(static_cast<double>(values[i]));
  return list + "]";
}

// Throws SceneError: "<source>: <path> = <value>: <rule>".
template <class Value>
void require(bool rule_holds, const std::string& source, const std::string& path, const Value& value,
             const std::string& rule) {
  if (!rule_holds) throw SceneError(source + ": " + path + " = " + text(value) + ": " + rule);
}

}  // namespace scene
