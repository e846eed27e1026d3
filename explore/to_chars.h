// std::to_chars of a double, which emscripten 3.1.6's library lacks: the fewest digits that read back as the same number.
#pragma once

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace std {
inline to_chars_result to_chars(char* first, char*, double value) {
  int length = 0;
  for (int digits = 1; digits <= 17; ++digits) {
    length = snprintf(first, 32, "%.*g", digits, value);
    if (strtod(first, nullptr) == value) break;
  }
  return {first + length, errc()};
}
}  // namespace std
