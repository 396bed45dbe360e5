#include "model/numerics/dilogarithm.h"

#include <array>
#include <cstddef>

namespace howl {
namespace {

// B_2, B_4, ... B_18.
constexpr std::array<double, 9> kBernoulli = {1.0 / 6.0,   -1.0 / 30.0,     1.0 / 42.0,
                                              -1.0 / 30.0, 5.0 / 66.0,      -691.0 / 2730.0,
                                              7.0 / 6.0,   -3617.0 / 510.0, 43867.0 / 798.0};

}  // namespace

std::complex<double> Dilogarithm(std::complex<double> z) {
  const std::complex<double> u = -std::log(1.0 - z);
  std::complex<double> power = u;  // u^(n + 1) / (n + 1)!
  std::complex<double> out = u - 0.25 * u * u;
  for (std::size_t k = 0; k < kBernoulli.size(); ++k) {
    const double n = 2.0 * static_cast<double>(k) + 2.0;
    power *= u * u / (n * (n + 1.0));
    out += kBernoulli[k] * power;
  }
  return out;
}

}  // namespace howl
