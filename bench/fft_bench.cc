// Transforms of complex values of lengths p 2^k near 2^14 and 2^18, p a prime. `vs_kissfft`: the
// speed of chirps as a multiple of kissfft's in the same run; where it passes one is the largest
// factor that is left to kissfft (model/numerics/chirp_transform.cc).
#include <benchmark/benchmark.h>

#include <bit>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "bench/seconds.h"
#include "model/numerics/chirp_transform.h"

namespace howl {
namespace {

using Values = std::vector<std::complex<double>>;

void BM_Chirps(benchmark::State& state) {
  const auto prime = static_cast<std::size_t>(state.range(0));
  const auto near = static_cast<std::size_t>(state.range(1));
  const std::size_t length = prime * std::bit_floor(near / prime);
  Values x(length);
  for (std::size_t n = 0; n < length; ++n) x[n] = std::sin(0.7 * static_cast<double>(n));
  Values spectrum(length);
  Eigen::FFT<double> fft;
  ChirpTransform chirps(length, &fft);
  fft.fwd(spectrum.data(), x.data(), std::ssize(x));
  double by_kissfft = 0.0;
  double by_chirps = 0.0;
  for (auto _ : state) {
    const double begun = Seconds();
    fft.fwd(spectrum.data(), x.data(), std::ssize(x));
    const double between = Seconds();
    chirps.Forward(x, spectrum);
    by_kissfft += between - begun;
    by_chirps += Seconds() - between;
    benchmark::DoNotOptimize(spectrum.data());
  }
  state.counters["vs_kissfft"] = by_kissfft / by_chirps;
}

BENCHMARK(BM_Chirps)
    ->ArgNames({"prime", "near"})
    ->ArgsProduct({{2, 31, 61, 97, 251, 1009, 8191}, {1 << 14, 1 << 18}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace howl
