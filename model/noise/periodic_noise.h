// Gaussian noise of any spectrum: each frequency of its discrete Fourier transform is drawn by
// itself (M. Shinozuka and C.-M. Jan, J. Sound Vib. 25:111, 1972),
//
//   x_m = (1 / M) sum_k X_k e^(2 pi j k m / M),   E |X_k|^2 = S(k f_s / M) f_s M / 2,   X_0 = 0
//
// with S the one-sided power spectral density. It repeats after M samples, and at each of its
// frequencies is exactly Gaussian with exactly this density; there is none between them. Draws are
// made from the lowest frequency up, so that a higher rate over the same time, of a spectrum that
// ends below, is the same noise sampled more finely.
#ifndef HOWL_MODEL_NOISE_PERIODIC_NOISE_H_
#define HOWL_MODEL_NOISE_PERIODIC_NOISE_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace howl {

// S(f), in squares a Hz.
using PowerDensity = std::function<double(double f_hz)>;

// `samples` of them at rate_hz: one period.
std::vector<double> PeriodicNoise(const PowerDensity& density, double rate_hz, std::size_t samples,
                                  std::uint64_t seed);

// The smallest even number from `least` on that has no other factor than 2, 3 and 5, whose
// transforms are quick.
std::size_t FastPeriod(std::size_t least);

}  // namespace howl

#endif  // HOWL_MODEL_NOISE_PERIODIC_NOISE_H_
