// Peaks of arithmetic on one thread. The unit is one operation on one number: a product and a sum,
// fused or not, are two.
//
// The project's libraries are built with -O3 for any x86-64 machine, so with scalar numbers or two
// lanes; some of its loops (model/simulation/lane_loop.cc) have copies for four and eight lanes as
// well, in which products and sums are never fused.
#include <cstddef>
#include <utility>

#include "bench/limits/measured.h"

#define HOWL_INLINE [[gnu::always_inline]] inline

namespace howl::limits {
namespace {

// More than a unit's latency times the units of a core; one register each.
using Chains = std::make_index_sequence<12>;
constexpr int kRepeats = 1000000;

// The compiler may neither join, reorder nor leave out what makes this value.
template <typename V>
HOWL_INLINE void Keep(V& value) {
#if defined(__x86_64__)
  asm volatile("" : "+x"(value));
#else
  asm volatile("" : "+w"(value));
#endif
}

template <typename V>
constexpr std::size_t kLanes = sizeof(V) / sizeof(double);

template <typename V, bool kFused>
HOWL_INLINE void MultiplyAddOnce(V& x, const V& m, const V& a) {
  V product = x * m;
  if (!kFused) Keep(product);
  x = product + a;
  Keep(x);
}

// x <- m x + a in independent chains, one for each I, each in a register.
template <typename V, bool kFused, std::size_t... I>
HOWL_INLINE double MultiplyAdd(std::index_sequence<I...>) {
  V x[] = {(V{} + static_cast<double>(I))...};
  V m = V{} + 0.999999;
  V a = V{} + 1e-6;
  Keep(m);
  Keep(a);
  for (int n = 0; n < kRepeats; ++n) (MultiplyAddOnce<V, kFused>(x[I], m, a), ...);
  return 2.0 * static_cast<double>(sizeof...(I) * kLanes<V>) * kRepeats;
}

template <typename V>
HOWL_INLINE void DivideOnce(V& x, const V& a) {
  x = a / x;
  Keep(x);
}

// x <- a / x in independent chains: quotients alone.
template <typename V, std::size_t... I>
HOWL_INLINE double Divide(std::index_sequence<I...>) {
  V x[] = {(V{} + (1.0 + static_cast<double>(I)))...};
  V a = V{} + 1.7;
  Keep(a);
  constexpr int kTimes = kRepeats / 4;
  for (int n = 0; n < kTimes; ++n) (DivideOnce(x[I], a), ...);
  return static_cast<double>(sizeof...(I) * kLanes<V>) * kTimes;
}

typedef double Two __attribute__((vector_size(16)));

double Chain() { return MultiplyAdd<double, false>(std::make_index_sequence<1>()); }
double Scalar() { return MultiplyAdd<double, false>(Chains()); }
double TwoLanes() { return MultiplyAdd<Two, false>(Chains()); }
double DivideScalar() { return Divide<double>(Chains()); }
double DivideTwoLanes() { return Divide<Two>(Chains()); }

Measured Always(const char* id, double (*run)()) {
  return {id, "operation", [run] { return std::function<double()>(run); }};
}

// clang checks the registers of an inlined function against the narrowest machine.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));

__attribute__((target("avx2"))) double FourLanes() { return MultiplyAdd<Four, false>(Chains()); }
__attribute__((target("avx2,fma"))) double FourLanesFused() {
  return MultiplyAdd<Four, true>(Chains());
}
__attribute__((target("avx512f"))) double EightLanes() {
  return MultiplyAdd<Eight, false>(Chains());
}
__attribute__((target("avx512f,fma"))) double EightLanesFused() {
  return MultiplyAdd<Eight, true>(Chains());
}
__attribute__((target("avx2"))) double DivideFourLanes() { return Divide<Four>(Chains()); }
__attribute__((target("avx512f"))) double DivideEightLanes() { return Divide<Eight>(Chains()); }

void AddWiderLanes(std::vector<Measured>& peaks) {
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    peaks.push_back(Always("multiply-add, 4 lanes (AVX2)", FourLanes));
    peaks.push_back(Always("multiply-add, 4 lanes, fused (AVX2, FMA)", FourLanesFused));
    peaks.push_back(Always("division, 4 lanes (AVX2)", DivideFourLanes));
  }
  if (__builtin_cpu_supports("avx512f")) {
    peaks.push_back(Always("multiply-add, 8 lanes (AVX-512)", EightLanes));
    peaks.push_back(Always("multiply-add, 8 lanes, fused (AVX-512)", EightLanesFused));
    peaks.push_back(Always("division, 8 lanes (AVX-512)", DivideEightLanes));
  }
}
#else
void AddWiderLanes(std::vector<Measured>&) {}
#endif

}  // namespace

std::vector<Measured> ArithmeticPeaks() {
  std::vector<Measured> peaks = {
      Always("multiply-add, one chain", Chain), Always("multiply-add, scalar", Scalar),
      Always("multiply-add, 2 lanes (SSE2)", TwoLanes), Always("division, scalar", DivideScalar),
      Always("division, 2 lanes (SSE2)", DivideTwoLanes)};
  AddWiderLanes(peaks);
  return peaks;
}

}  // namespace howl::limits
