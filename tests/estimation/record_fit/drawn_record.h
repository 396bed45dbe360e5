// Records of linear loops whose flame answers by any path.
#ifndef HOWL_TESTS_ESTIMATION_RECORD_FIT_DRAWN_RECORD_H_
#define HOWL_TESTS_ESTIMATION_RECORD_FIT_DRAWN_RECORD_H_

#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "estimation/record_fit/loop/flame_path.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/modal_loop.h"

namespace howl {

// A record of a linear loop below onset that repeats itself, drawn frequency by frequency. A source
// in the duct shows what the flame makes of p:
//   P = R Q + E_A,   Q = F P + E_B.
inline Record DrawnRecord(const ModalLoop& loop, const FlamePath& path, double seconds,
                          std::uint64_t seed) {
  using C = std::complex<double>;
  RandomStream random(seed);
  const auto n = static_cast<std::size_t>(seconds * loop.sampling_hz);
  const auto highest = static_cast<std::size_t>(1500.0 * seconds);
  Record out;
  out.sampling_hz = loop.sampling_hz;
  out.pressure.assign(n, 0.0);
  out.heat_release.assign(n, 0.0);
  for (std::size_t k = 1; k < highest; ++k) {
    const double hz = static_cast<double>(k) / seconds;
    const C s(0.0, 2.0 * std::numbers::pi * hz);
    C r = 0.0;
    for (const ModalLoop::Mode& mode : loop.modes) {
      const double w = 2.0 * std::numbers::pi * mode.omega_hz;
      r += (mode.a * s + mode.b * w) / (s * s + 2.0 * mode.xi * w * s + w * w);
    }
    const C f = -loop.slope * s * path.At(s);
    const auto draw = [&](double std) { return std * C(random.Normal(), random.Normal()); };
    const C of_flame = draw(1.0);
    const C of_duct = r * draw(3.0);
    const C p = (of_duct + r * of_flame) / (1.0 - r * f);
    const C q = f * p + of_flame;
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    const C step = std::polar(1.0, turn);
    C at = 1.0;
    for (std::size_t i = 0; i < n; ++i) {
      out.pressure[i] += (p * at).real();
      out.heat_release[i] += (q * at).real();
      at *= step;
    }
  }
  return out;
}

// A duct so damped that p is broad.
inline ModalLoop BroadDuct() {
  ModalLoop loop = DuctOfModes(2);
  for (ModalLoop::Mode& mode : loop.modes) mode.xi *= 4.0;
  loop.slope *= 2.0;
  return loop;
}

}  // namespace howl

#endif  // HOWL_TESTS_ESTIMATION_RECORD_FIT_DRAWN_RECORD_H_
