#include "estimation/analysis/flame/flame_curve.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "estimation/analysis/flame/flame_dither.h"
#include "estimation/analysis/flame/flame_polynomial.h"
#include "estimation/analysis/flame/flame_regressor.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr int kFewestSamples = 100;
constexpr double kClearPreference = 2.0;  // standard errors
constexpr double kLargestNoise = 0.3;     // s^2 / X^2: beyond, first order says nothing
// The flame's input is taken with p's harmonics, or with what lies below one and a half times the
// cycle's frequency alone.
constexpr double kFundamentalBand = 1.5;

void FillBins(const std::vector<double>& x, const std::vector<double>& q, double limit, int count,
              std::vector<FlameCurveBin>* bins) {
  struct Sums {
    double x = 0, q = 0, qq = 0;
    int samples = 0, passages = 0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>(count));
  int previous = -1;
  for (std::size_t t = 0; t < x.size(); ++t) {
    const int bin = static_cast<int>(std::floor((x[t] + limit) / (2.0 * limit) * count));
    if (bin >= 0 && bin < count) {
      Sums& s = sums[static_cast<std::size_t>(bin)];
      s.x += x[t];
      s.q += q[t];
      s.qq += q[t] * q[t];
      ++s.samples;
      s.passages += bin != previous ? 1 : 0;
    }
    previous = bin;
  }
  for (const Sums& s : sums) {
    if (s.samples < 2) continue;
    const double mean = s.q / s.samples;
    const double variance = std::max(s.qq / s.samples - mean * mean, 0.0);
    bins->push_back({s.x / s.samples, mean, std::sqrt(variance / s.passages), s.samples});
  }
}

FlameSamples Collect(const Record& record, const FlameRegressor& regressor, bool with_harmonics) {
  FlameSamples samples;
  for (int t = regressor.first(); t < regressor.last(); ++t) {
    const std::complex<double> z = regressor.Fundamental(t);
    const double q = record.heat_release[static_cast<std::size_t>(t)];
    samples.x.push_back(z.real() + (with_harmonics ? regressor.Harmonics(z) : 0.0));
    samples.q.push_back(q);
    samples.q_mean += q;
  }
  samples.q_mean /= static_cast<double>(samples.x.size());
  return samples;
}

// The mean cycle of q over the phase of x: its first harmonic and the others relative to it.
void FillMeanCycle(const Record& record, const FlameRegressor& regressor, double q_mean,
                   FlameCurve& curve) {
  std::complex<double> weighted = 0.0;  // by the amplitude of x
  std::array<std::complex<double>, kMeanCycleHarmonics + 1> sum{};
  for (int t = regressor.first(); t < regressor.last(); ++t) {
    const std::complex<double> z = regressor.Fundamental(t);
    const double q = record.heat_release[static_cast<std::size_t>(t)] - q_mean;
    const std::complex<double> back = std::conj(z) / std::abs(z);
    weighted += q * std::conj(z);
    std::complex<double> power = 1.0;
    for (auto& harmonic : sum) {
      harmonic += q * power;
      power *= back;
    }
  }
  curve.hysteresis = weighted.imag() / std::abs(weighted);
  for (int k = 1; k <= kMeanCycleHarmonics; ++k) {
    // The cycle is turned so that its first harmonic is real, which leaves its shape without an
    // error of tau.
    const std::complex<double> turn = std::polar(1.0, -k * std::arg(-sum[1]));
    curve.mean_cycle.push_back(sum[static_cast<std::size_t>(k)] * turn / -std::abs(sum[1]));
  }
}

// The regressor with fundamental and harmonics, at the delay near the given one that leaves q least
// scattered. Where x has harmonics, the phase of q's fundamental is no longer that of x's, and (3)
// misses the delay by a little. The search is by golden section within a hundredth of the period.
FlameSamples CollectWithHarmonics(const Record& record, const FlameRegressor& regressor,
                                  double period_s, double limit, double range) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 8;
  const auto scatter = [&](double shift) {
    const FlameSamples samples =
        Collect(record, regressor.Delayed(regressor.tau_s() + shift * period_s), true);
    return FlamePolynomial(samples, limit, range).MeanSquareResidual(samples);
  };
  double low = -0.01, high = 0.01;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = scatter(a), at_b = scatter(b);
  for (int i = 0; i < kSteps; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = scatter(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = scatter(b);
    }
  }
  const double shift = at_a < at_b ? a : b;
  return Collect(record, regressor.Delayed(regressor.tau_s() + shift * period_s), true);
}

// Means of q beyond the fitted range, on either side.
void FillSaturation(const FlameSamples& samples, double edge, FlameCurve& curve) {
  double low_sum = 0.0, high_sum = 0.0;
  int low_count = 0, high_count = 0;
  for (std::size_t t = 0; t < samples.x.size(); ++t) {
    if (samples.x[t] > edge) high_sum += samples.q[t], ++high_count;
    if (samples.x[t] < -edge) low_sum += samples.q[t], ++low_count;
  }
  const double positive = high_count > 0 ? high_sum / high_count : samples.q_mean;
  const double negative = low_count > 0 ? low_sum / low_count : samples.q_mean;
  curve.saturation_low = std::min(positive, negative);
  curve.saturation_high = std::max(positive, negative);
}

}  // namespace

FlameCurve EstimateFlameCurve(const Record& record, const CrossSpectrum& spectrum,
                              const Characteristics& cycle, double tau_s,
                              const FlameCurveOptions& options) {
  CHECK_EQ(record.heat_release.size(), record.pressure.size());
  const FlameRegressor regressor(record, cycle, tau_s, options.max_harmonic);
  FlameCurve curve;
  if (regressor.last() - regressor.first() < kFewestSamples) return curve;
  const double limit = kRadPerSPerHz * cycle.frequency_hz.value * cycle.p_amplitude;
  curve.x_amplitude = limit;

  FlameSamples samples = Collect(record, regressor, false);
  double undecided = 0.0;
  if (regressor.locked_harmonics() > 0) {
    FlameSamples full = CollectWithHarmonics(record, regressor, 1.0 / cycle.frequency_hz.value,
                                             limit, options.fit_range);
    const FlamePolynomial fit(samples, limit, options.fit_range);
    const FlamePolynomial full_fit(full, limit, options.fit_range);
    // The degree is high, because what a low one misses of the curve is no scatter.
    constexpr int kDegree = 9;
    const double preference =
        ScatterPreference(samples, FlamePolynomial(samples, limit, options.fit_range, kDegree),
                          full, FlamePolynomial(full, limit, options.fit_range, kDegree));
    // Where the scatter cannot tell the two apart, the paper's (4) stands, and the slope is known
    // no better than to half of their distance.
    if (preference > kClearPreference) {
      samples = std::move(full);
      curve.harmonics = regressor.locked_harmonics();
      undecided = full_fit.Coefficient(1) / limit * std::sqrt(regressor.harmonic_slope_variance());
    } else if (preference > -kClearPreference) {
      undecided = 0.5 * (full_fit.Coefficient(1) - fit.Coefficient(1)) / limit;
    }
  }
  FillMeanCycle(record, regressor, samples.q_mean, curve);
  FillBins(samples.x, samples.q, 1.05 * limit, options.bins, &curve.bins);
  FillSaturation(samples, options.fit_range * limit, curve);
  const FlameSlopeFit fit = FitFlameSlope(samples, limit, options.fit_range);
  curve.degree = fit.degree;
  curve.offset = fit.offset;

  // Joining the blocks leaves 0.79 of their noise's variance, half of it in the real part. The part
  // of the floor that is coherent with q is pressure that acted on the flame, and no error of x.
  curve.regressor_noise = 0.5 * 0.79 * cycle.floor_incoherent_share * cycle.block_noise_power *
                          cycle.block_samples / regressor.block_samples() /
                          (cycle.p_amplitude * cycle.p_amplitude);
  const double band = curve.harmonics > 0 ? options.max_harmonic + 0.5 : kFundamentalBand;
  curve.dither = DitherVariance(spectrum, cycle.frequency_hz.value,
                                regressor.block_samples() / record.sampling_hz,
                                band * cycle.frequency_hz.value) /
                 (limit * limit);
  const double noise = std::min(curve.regressor_noise, kLargestNoise);
  const double smoothing = std::min(curve.regressor_noise + curve.dither, kLargestNoise);
  const double corrected = fit.slope.value / (1.0 + noise) - 3.0 * smoothing * fit.cubic;
  const double correction = corrected - fit.slope.value;
  curve.relative_correction = fit.slope.value != 0.0 ? correction / fit.slope.value : 0.0;
  curve.slope = {corrected / limit,
                 std::hypot(fit.slope.std / limit, 0.5 * correction / limit, undecided)};
  return curve;
}

Estimate LoopGainFromSlope(const Estimate& gain, const Estimate& frequency_hz,
                           const Estimate& flame_slope) {
  const double value =
      gain.value * kRadPerSPerHz * frequency_hz.value * std::abs(flame_slope.value);
  const auto relative = [](const Estimate& e) {
    return std::isfinite(e.std) && e.value != 0.0 ? e.std / e.value : 0.0;
  };
  return {value, value * std::hypot(relative(gain), relative(frequency_hz), relative(flame_slope))};
}

}  // namespace howl
