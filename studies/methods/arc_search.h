// Searches that the ablation sets against each other, for any scalar type.
#pragma once

#include <cmath>
#include <functional>
#include <limits>

namespace studies {

// Golden section until the bracket is no wider than the tolerance; 0: until it is sqrt(eps)/4 of the unknown wide or
// 200 steps are done, beyond what a minimiser can resolve.
template <class T, class Function>
T golden_section(const Function& f, T low, T high, T tolerance) {
  const T share = static_cast<T>(0.6180339887498949);
  T a = high - share * (high - low), b = low + share * (high - low);
  T fa = f(a), fb = f(b);
  const T relative = std::sqrt(std::numeric_limits<T>::epsilon()) / 4;
  for (int i = 0; i < 200; ++i) {
    const T enough = tolerance > 0 ? tolerance : relative * std::abs(low + high) / 2;
    if (high - low <= enough) break;
    if (fa < fb) {
      high = b, b = a, fb = fa;
      a = high - share * (high - low);
      fa = f(a);
    } else {
      low = a, a = b, fa = fb;
      b = low + share * (high - low);
      fb = f(b);
    }
  }
  return (low + high) / 2;
}

template <class T, class Function>
T bisect(const Function& f, T low, T high, T tolerance) {
  for (int i = 0; i < 200 && high - low > tolerance; ++i) {
    const T middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (f(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

// tolerance 0: relative to the loads, as in fam/published_arc.h but for the scalar type.
template <class T, class Function>
T secant(const Function& f, T start, T tolerance, T scale) {
  const T relative = 8 * std::numeric_limits<T>::epsilon();
  T x = start, fx = f(x), step = -fx;
  for (int i = 0; i < 50; ++i) {
    x += step;
    if (std::abs(step) <= (tolerance > 0 ? tolerance : relative * (scale + std::abs(x)))) break;
    const T next = f(x);
    const T slope = (next - fx) / step;
    fx = next;
    step = slope > T(0.1) ? -fx / slope : -fx;
  }
  return x;
}

// gsl_min_fminimizer_brent from the middle of the bracket, stopped by gsl_min_test_interval with the absolute
// tolerance, or after 100 steps (tolerance 0). GSL's own steps resolve sqrt(eps) of the unknown, not more.
double brent_minimum(const std::function<double(double)>& f, double low, double high, double tolerance);

}  // namespace studies
