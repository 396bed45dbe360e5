// What else the hot loops are made of: functions of the C library, switches of the rounding mode,
// allocations, and memory. The unit is one call; of memory, one byte read or written.
#include <array>
#include <cfenv>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <new>

#include "bench/limits/measured.h"

namespace howl::limits {
namespace {

constexpr std::size_t kArguments = 256;
constexpr int kSweeps = 400;

void Forget(void* at) { asm volatile("" : : "r"(at) : "memory"); }

// Independent calls with arguments spread over lo .. hi.
template <typename F>
Measured Function(const char* id, double lo, double hi, F function) {
  return {id, "call", [=] {
            return std::function<double()>([=] {
              std::array<double, kArguments> x;
              for (std::size_t i = 0; i < kArguments; ++i) {
                // Out of order, so that no branch can be foreseen by the argument before.
                x[i] = lo + (hi - lo) * static_cast<double>(i * 97 % kArguments) / kArguments;
              }
              std::array<double, kArguments> y;
              for (int n = 0; n < kSweeps; ++n) {
                for (std::size_t i = 0; i < kArguments; ++i) y[i] = function(x[i]);
                Forget(y.data());
              }
              return static_cast<double>(kArguments) * kSweeps;
            });
          }};
}

double SwitchRounding() {
  constexpr int kPairs = 50000;
  for (int n = 0; n < kPairs; ++n) {
    std::fesetround(FE_DOWNWARD);
    std::fesetround(FE_UPWARD);
  }
  std::fesetround(FE_TONEAREST);
  return 2.0 * kPairs;
}

double Allocate() {
  constexpr int kBlocks = 200000;
  constexpr std::size_t kBytes = 384;
  for (int n = 0; n < kBlocks; ++n) {
    void* const block = ::operator new(kBytes);
    Forget(block);
    ::operator delete(block);
  }
  return kBlocks;
}

// a = b + s c over three arrays that together are some six times the largest cache that the
// machine at hand has (32 MiB): two reads and one write.
std::function<double()> Triad() {
  constexpr std::size_t kLength = std::size_t{1} << 23;
  struct Arrays {
    std::vector<double> a, b, c;
  };
  static const auto arrays = std::make_shared<Arrays>(Arrays{std::vector<double>(kLength, 0.0),
                                                             std::vector<double>(kLength, 1.0),
                                                             std::vector<double>(kLength, 2.0)});
  return [] {
    double* const a = arrays->a.data();
    const double* const b = arrays->b.data();
    const double* const c = arrays->c.data();
    for (std::size_t i = 0; i < kLength; ++i) a[i] = b[i] + 3.0 * c[i];
    Forget(a);
    return 3.0 * sizeof(double) * kLength;
  };
}

}  // namespace

std::vector<Measured> CallPeaks() {
  return {
      Function("sqrt", 0.1, 9.0, [](double x) { return std::sqrt(x); }),
      Function("exp", -8.0, 8.0, [](double x) { return std::exp(x); }),
      Function("log", 1e-6, 1e3, [](double x) { return std::log(x); }),
      Function("sin", -9.0, 9.0, [](double x) { return std::sin(x); }),
      Function("cos", -9.0, 9.0, [](double x) { return std::cos(x); }),
      Function("tan", -1.5, 1.5, [](double x) { return std::tan(x); }),
      Function("atan", -9.0, 9.0, [](double x) { return std::atan(x); }),
      Function("atan2", -9.0, 9.0, [](double x) { return std::atan2(x, 1.5); }),
      Function("hypot", -9.0, 9.0, [](double x) { return std::hypot(x, 1.5); }),
      {"rounding mode switched", "call", [] { return std::function<double()>(SwitchRounding); }},
      {"384 bytes allocated and freed", "call", [] { return std::function<double()>(Allocate); }},
      {"memory, triad", "byte", Triad},
  };
}

}  // namespace howl::limits
