#include "estimation/analysis/cycle/cycle_blocks.h"

#include <algorithm>
#include <cmath>

#include "model/numerics/units.h"

namespace howl {
namespace {

double SecondDifferenceVariance(const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double d = x[i + 1] - 2.0 * x[i] + x[i - 1];
    sum += d * d;
  }
  return sum / static_cast<double>(x.size());
}

}  // namespace

double MeanSquare(const BlockAmplitudes& z) {
  double sum = 0.0;
  for (const auto& value : z) sum += std::norm(value);
  return z.empty() ? 0.0 : sum / static_cast<double>(z.size());
}

double IncoherentShare(const CrossSpectrum& spectrum, double frequency_hz) {
  constexpr int kReach = 30;  // bins, as NoiseFloor's
  const double nu = spectrum.degrees_of_freedom;
  if (!spectrum.HasHeatRelease() || nu < 2.0) return 1.0;
  const int peak = static_cast<int>(std::lround(frequency_hz / spectrum.bin_hz));
  const int last = static_cast<int>(spectrum.pp.size()) - 1;
  std::vector<double> power, incoherent;
  for (int k = std::max(peak - kReach, 3); k <= std::min(peak + kReach, last); ++k) {
    if (std::abs(k - peak) <= kBlackmanHarrisMainLobeBins) continue;
    const auto i = static_cast<std::size_t>(k);
    if (!(spectrum.qq[i] > 0.0)) return 1.0;
    power.push_back(spectrum.pp[i]);
    incoherent.push_back(
        std::max(spectrum.pp[i] - std::norm(spectrum.qp[i]) / spectrum.qq[i], 0.0));
  }
  if (power.empty()) return 1.0;
  return std::clamp(Median(incoherent) / Median(power) * nu / (nu - 1.0), 0.0, 1.0);
}

void ImprovePhase(std::span<const std::pair<int, BlockAmplitudes>> others,
                  std::vector<double>& phase) {
  const std::vector<double> base = phase;
  double total = 1.0 / std::max(SecondDifferenceVariance(base), 1e-30);
  std::vector<double> sum(base.size());
  for (std::size_t b = 0; b < base.size(); ++b) sum[b] = total * base[b];
  for (const auto& [harmonic, blocks] : others) {
    BlockAmplitudes relative(base.size());
    std::complex<double> mean = 0.0;
    double size = 0.0;
    for (std::size_t b = 0; b < base.size(); ++b) {
      relative[b] = blocks[b] * std::polar(1.0, -harmonic * base[b]);
      mean += relative[b];
      size += std::abs(relative[b]);
    }
    if (std::abs(mean) < 0.9 * size) continue;  // too noisy, or not locked
    std::vector<double> own(base.size());
    for (std::size_t b = 0; b < base.size(); ++b) {
      own[b] = base[b] + std::arg(relative[b] * std::conj(mean)) / harmonic;
    }
    const double weight = 1.0 / std::max(SecondDifferenceVariance(own), 1e-30);
    total += weight;
    for (std::size_t b = 0; b < base.size(); ++b) sum[b] += weight * own[b];
  }
  for (std::size_t b = 0; b < base.size(); ++b) phase[b] = sum[b] / total;
}

void EstimateRatio(const BlockAmplitudes& p, const BlockAmplitudes& q, Characteristics* result) {
  std::complex<double> cross = 0.0;
  double pp = 0.0, qq = 0.0;
  for (std::size_t b = 0; b < p.size(); ++b) {
    cross += std::conj(q[b]) * p[b];
    pp += std::norm(p[b]);
    qq += std::norm(q[b]);
  }
  if (!(qq > 0.0) || !(std::abs(cross) > 0.0)) return;
  const std::complex<double> h = cross / qq;
  const double mean_qq = qq / static_cast<double>(p.size());
  BlockAmplitudes scores(p.size());  // relative: real part gain, imaginary part phase
  for (std::size_t b = 0; b < p.size(); ++b) {
    scores[b] = std::conj(q[b]) * (p[b] - h * q[b]) / (mean_qq * h);
  }
  const MeanError error = ErrorOfMean(scores, kHannOverlapCorrelation);
  const double inflation = StudentInflation(error.degrees_of_freedom);
  result->coherence = std::min(std::norm(cross) / (pp * qq), 1.0);
  result->gain_bias_bound = 0.5 * std::log(1.0 / result->coherence);
  const double bias_variance = result->gain_bias_bound * result->gain_bias_bound / 3.0;
  const double gain = std::abs(h) / std::sqrt(result->coherence);
  result->gain = {gain,
                  gain * std::sqrt(error.covariance(0, 0) * inflation * inflation + bias_variance)};
  result->phase_deg = {std::arg(h) * kDegPerRad,
                       std::sqrt(error.covariance(1, 1)) * inflation * kDegPerRad};
}

void EstimateEnvelope(const BlockAmplitudes& p, double hop_s, Characteristics* result) {
  const double m2 = MeanSquare(p);
  const double v = std::min(result->block_noise_power, 0.5 * m2);
  const double signal = m2 - v;
  std::vector<double> scores;
  double m4 = 0.0, low = 0.0, mean_amplitude = 0.0;
  for (const auto& z : p) {
    const double power = std::norm(z);
    m4 += power * power / static_cast<double>(p.size());
    mean_amplitude += std::abs(z) / static_cast<double>(p.size());
    low += power < 0.25 * m2 ? 1.0 : 0.0;
    result->envelope.push_back(std::abs(z));
  }
  result->low_amplitude_share = low / static_cast<double>(p.size());
  result->p_amplitude = std::sqrt(signal);
  const double ratio = (m4 - 4.0 * signal * v - 2.0 * v * v) / (signal * signal);
  for (const auto& z : p) {  // influence of each block on m4 / m2^2
    const double power = std::norm(z);
    scores.push_back((power * power - m4) / (m2 * m2) - 2.0 * m4 * (power - m2) / (m2 * m2 * m2));
  }
  const MeanError error = ErrorOfMean(scores, kHannOverlapCorrelation);
  result->power_fluctuation = {
      std::max(ratio - 1.0, 0.0),
      std::sqrt(error.covariance(0, 0)) * StudentInflation(error.degrees_of_freedom)};

  // Slope of the envelope as a mean of influences, relative to its own mean.
  const double n = static_cast<double>(p.size());
  double slope = 0.0;
  for (std::size_t b = 0; b < p.size(); ++b) {
    slope += (static_cast<double>(b) - 0.5 * (n - 1)) * std::abs(p[b]) * 12.0 / (n * (n * n - 1));
  }
  std::vector<double> influence;
  for (std::size_t b = 0; b < p.size(); ++b) {
    const double t = static_cast<double>(b) - 0.5 * (n - 1);
    influence.push_back(12.0 * t / (n * n - 1) * (std::abs(p[b]) - mean_amplitude - slope * t));
  }
  const MeanError slope_error = ErrorOfMean(influence, kHannOverlapCorrelation);
  const double scale = 1.0 / (mean_amplitude * hop_s);
  result->amplitude_drift_per_s = {slope * scale,
                                   std::sqrt(slope_error.covariance(0, 0)) * scale *
                                       StudentInflation(slope_error.degrees_of_freedom)};
}

}  // namespace howl
