#include "estimation/record_fit/loop/pressure_noise.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/spectra/unitary_transform.h"
#include "estimation/record_fit/whittle/noise_covariance.h"

namespace howl {
namespace {

using C = std::complex<double>;

// What noise exceeds with probability 1e-4. E^H Sigma^-1 E of a right loop is half of chi-squared
// with four degrees of freedom, beyond t with probability (1 + t) e^-t; the power of one bin, over
// its mean, with e^-t.
constexpr double kMostOfNoise = 11.76;
constexpr double kMostOfBin = 9.21;
// Where the taper is smaller than this, the noise is left small.
constexpr double kLeastTaper = 0.1;

// How much of it recorded p shows.
double ShareInPressure(LoopNoise source, double background_ratio) {
  if (IsOfPressure(source)) return 1.0;
  return source == LoopNoise::kBackground ? background_ratio : 0.0;
}

// The signal that has these bins under the taper: each is a bin of the transform of the signal
// times 1 - e^(-2 pi j n / N).
Eigen::VectorXd WithoutTaper(const Eigen::VectorXcd& tapered, Eigen::Index first,
                             Eigen::Index samples) {
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(samples / 2 + 1);
  spectrum.segment(first, tapered.size()) = tapered;
  const Eigen::VectorXd real = UnitarySignal(spectrum, samples);
  const Eigen::VectorXd imaginary = UnitarySignal(C(0.0, -1.0) * spectrum, samples);
  Eigen::VectorXd out(samples);
  for (Eigen::Index n = 0; n < samples; ++n) {
    const double turn =
        2.0 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(samples);
    const C taper = 1.0 - std::polar(1.0, -turn);
    const double power = std::max(std::norm(taper), 4.0 * kLeastTaper * kLeastTaper);
    out[n] = (C(real[n], imaginary[n]) * std::conj(taper)).real() / power;
  }
  return out;
}

}  // namespace

Eigen::VectorXd PressureNoise(const RecordSpectra& record, const PointStructure& structure,
                              const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  const LoopResiduals at = ResidualsOf(record, structure, point);
  std::vector<double> share;
  for (const NoiseTerm& term : structure.noise) {
    share.push_back(ShareInPressure(term.source, point.background_ratio));
  }
  const auto spectrum = [&](Eigen::Index i, std::size_t j) {
    return at.spectra(i, static_cast<Eigen::Index>(j));
  };
  const Eigen::Index above = record.above.size();
  Eigen::VectorXcd noise = Eigen::VectorXcd::Zero(record.bins() + above);
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const NoiseDirections directions = DirectionsOf(structure.noise, at, i);
    const ComplexPair error{at.acoustic[i], at.flame[i]};
    const ComplexPair weighted = CovarianceOf(directions, at, i).Inverse().Apply(error);
    if (!(Inner(error, weighted).real() < kMostOfNoise)) continue;
    for (std::size_t j = 0; j < share.size(); ++j) {
      noise[i] += share[j] * spectrum(i, j) * Inner(directions[j], weighted);
    }
  }
  double behind = 0.0;  // p's instrument
  double before = 0.0;
  for (std::size_t j = 0; j < share.size(); ++j) {
    (IsOfPressure(structure.noise[j].source) ? behind : before) +=
        share[j] * share[j] * spectrum(record.bins() - 1, j);
  }
  const double bin = record.bin_hz / record.scale.cycle_hz;
  const auto instrument_power = [&](C s) {
    return std::norm(ValueAt(record.pressure_instrument, s) *
                     ValueAt(record.known_pressure_instrument, s));
  };
  behind *= instrument_power(record.s[record.bins() - 1]);
  Eigen::VectorXcd edges(above + 1);
  edges << record.pressure.tail(1), record.above;
  const Eigen::VectorXcd tapered = Tapered(edges);
  for (Eigen::Index i = 0; i < above; ++i) {
    const C s = record.s[record.bins() - 1] + C(0.0, bin * static_cast<double>(i + 1));
    const double power = before + behind / instrument_power(s);
    if (std::norm(tapered[i]) < kMostOfBin * power) noise[record.bins() + i] = tapered[i];
  }
  return WithoutTaper(noise, record.below.size(), record.Samples());
}

}  // namespace howl
