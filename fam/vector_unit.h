// Code compiled twice: for the processor that the library is built for, and for AVX2 and FMA where GCC can; the one
// that runs is chosen by the processor. Results differ by round-off.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define FAM_HAS_AVX2_UNIT
#pragma GCC diagnostic ignored "-Wpsabi"  // wide vectors are passed on between functions inlined into one alone
#endif

namespace fam {

enum class VectorUnit { portable, avx2 };

inline VectorUnit widest_unit() {
#ifdef FAM_HAS_AVX2_UNIT
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return VectorUnit::avx2;
#endif
  return VectorUnit::portable;
}

// Calls f, with all that is inlined into it compiled for AVX2 and FMA; what is not stays as it is.
#ifdef FAM_HAS_AVX2_UNIT
template <class F>
[[gnu::target("avx2,fma"), gnu::flatten, gnu::noinline]] auto call_by_avx2(const F& f) {
  return f();
}
#endif

template <class F>
auto call_on([[maybe_unused]] VectorUnit unit, const F& f) {
#ifdef FAM_HAS_AVX2_UNIT
  if (unit == VectorUnit::avx2) return call_by_avx2(f);
#endif
  return f();
}

}  // namespace fam
