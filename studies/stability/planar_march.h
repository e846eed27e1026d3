// The midpoint law in the plane once more, on any scalar: what single precision does to a march. Not a part of the
// library. Sines are taken in double precision and rounded, so that all results depend on IEEE arithmetic alone.
#pragma once

#include <array>
#include <cmath>

namespace studies {

// Tip over L of a straight uniform rod of `arcs` arcs under a follower force across its tip, load = F L^2/EI.
template <class T>
std::array<T, 2> planar_march(double load, int arcs) {
  const T length = T(1) / T(arcs);
  const auto sine = [](T angle) { return T(std::sin(static_cast<double>(angle))); };
  const auto cosine = [](T angle) { return T(std::cos(static_cast<double>(angle))); };
  // An arc's chord in its proximal frame.
  const auto chord = [&](T angle, T arc_length) {
    const T half = angle / 2;
    const T size = half == 0 ? arc_length : arc_length * (sine(half) / half);
    return std::array<T, 2>{size * cosine(half), size * sine(half)};
  };
  std::array<T, 2> force{T(0), T(load)}, tip{T(0), T(0)};  // in the section frame; tip as seen from the section
  T moment = 0;
  const auto rotated = [&](const std::array<T, 2>& v, T angle) {
    const T c = cosine(angle), s = sine(angle);
    return std::array<T, 2>{c * v[0] - s * v[1], s * v[0] + c * v[1]};
  };
  const auto moment_before = [&](T angle, T arc_length) {
    const std::array<T, 2> turned = rotated(force, angle), reach = chord(angle, arc_length);
    return moment + (reach[0] * turned[1] - reach[1] * turned[0]);
  };
  for (int i = 0; i < arcs; ++i) {
    const T half_angle = moment * (length / 2);
    const T angle = moment_before(half_angle, length / 2) * length;
    const std::array<T, 2> reach = chord(angle, length), turned = rotated(tip, angle);
    moment = moment_before(angle, length);
    force = rotated(force, angle);
    tip = {turned[0] + reach[0], turned[1] + reach[1]};
  }
  return tip;
}

}  // namespace studies
