#include "estimation/analysis/cycle/characteristics.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "estimation/analysis/spectra/line_phase.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

using Complexes = std::vector<std::complex<double>>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMinBlockPeriods = kFewestPeriods;
constexpr double kBlocksPerRecord = 24.0;
constexpr double kLeastDiffusion = 5e-12;  // rad^2 a period: a steadier phase counts as this steady

// The incoherent share of the floor next to the peak: the median incoherent power of p over its
// median power, over the bins of the floor's running median outside the peak's main lobe. With nu
// averages a coherence of zero comes out as 1 / nu, which is corrected for.
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

double MeanSquare(const Complexes& z) {
  double sum = 0.0;
  for (const auto& value : z) sum += std::norm(value);
  return z.empty() ? 0.0 : sum / static_cast<double>(z.size());
}

double SecondDifferenceVariance(const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double d = x[i + 1] - 2.0 * x[i] + x[i - 1];
    sum += d * d;
  }
  return sum / static_cast<double>(x.size());
}

// The phase of the cycle from p's fundamental, improved by every other component that is locked to
// it: component h of a channel has h times the fundamental's phase plus a constant.
void ImprovePhase(std::span<const std::pair<int, Complexes>> others, std::vector<double>& phase) {
  const std::vector<double> base = phase;
  double total = 1.0 / std::max(SecondDifferenceVariance(base), 1e-30);
  std::vector<double> sum(base.size());
  for (std::size_t b = 0; b < base.size(); ++b) sum[b] = total * base[b];
  for (const auto& [harmonic, blocks] : others) {
    Complexes relative(base.size());
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

void EstimateRatio(const Complexes& p, const Complexes& q, Characteristics* result) {
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
  Complexes scores(p.size());  // relative: real part gain, imaginary part phase
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

// Envelope statistics, with the noise floor's share of the blocks' power taken out:
// E|s+n|^4 = E|s|^4 + 4 E|s|^2 v + 2 v^2 for circular noise of power v.
void EstimateEnvelope(const Complexes& p, double hop_s, Characteristics* result) {
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

void Classify(const CharacteristicsOptions& options, double duration_s, Characteristics* result) {
  const double fluctuation = result->power_fluctuation.value;
  result->state = fluctuation > options.no_cycle_fluctuation       ? CycleState::kNoLimitCycle
                  : fluctuation > options.intermittent_fluctuation ? CycleState::kIntermittent
                                                                   : CycleState::kLimitCycle;
  result->stationary = result->state == CycleState::kLimitCycle &&
                       !Drifts(result->amplitude_drift_per_s, kMostAmplitudeDrift / duration_s) &&
                       !Drifts(result->frequency_drift_hz_per_s,
                               kMostFrequencyDrift * result->frequency_hz.value / duration_s);
}

}  // namespace

double LowestSearched(double sampling_hz, double duration_s) {
  constexpr double kRumbleHz = 20.0;
  constexpr double kShare = 1.0 / 250.0;  // 20 Hz of the paper's 5 kHz
  return std::max(std::min(kRumbleHz, kShare * sampling_hz), kMinBlockPeriods / duration_s);
}

std::string_view CycleStateName(CycleState state) {
  switch (state) {
    case CycleState::kLimitCycle:
      return "limit_cycle";
    case CycleState::kIntermittent:
      return "intermittent";
    case CycleState::kNoLimitCycle:
      break;
  }
  return "no_limit_cycle";
}

Characteristics PaperCharacteristics(std::span<const double> p, std::span<const double> q,
                                     double sampling_hz, double min_frequency_hz,
                                     double max_frequency_hz) {
  const Complexes fp = RealFft(p), fq = RealFft(q);
  const double bin_hz = sampling_hz / static_cast<double>(p.size());
  const auto first = static_cast<std::size_t>(std::ceil(min_frequency_hz / bin_hz));
  const auto last = std::min(static_cast<std::size_t>(max_frequency_hz / bin_hz), fp.size() - 6);
  std::size_t best = std::max<std::size_t>(first, 5);
  for (std::size_t k = best; k <= last; ++k) {
    if (std::norm(fp[k]) > std::norm(fp[best])) best = k;
  }
  double weights = 0.0, gain = 0.0, phase = 0.0;
  const double reference = std::arg(fp[best] / fq[best]);
  for (std::size_t k = best - 5; k <= best + 5; ++k) {
    const double weight = std::abs(fp[k]);
    const std::complex<double> ratio = fp[k] / fq[k];
    weights += weight;
    gain += weight * std::abs(ratio);
    phase += weight * std::arg(ratio * std::polar(1.0, -reference));  // no jump at 180 degrees
  }
  Characteristics result;
  result.frequency_hz.value = static_cast<double>(best) * bin_hz;
  result.phase_deg.value = WrapDeg((reference + phase / weights) * kDegPerRad);
  result.gain.value = gain / weights;
  return result;
}

Characteristics CharacteristicsAt(const Record& record, const CrossSpectrum& spectrum,
                                  const SpectralPeak& peak, const CharacteristicsOptions& options,
                                  const SlowOscillation* slow) {
  Characteristics result;
  const std::vector<double> p = RemoveMean(record.pressure);
  const std::vector<double> q = RemoveMean(record.heat_release);
  const double duration_s = static_cast<double>(p.size()) / record.sampling_hz;
  result.peak = peak.test;
  if (!peak.significant || duration_s * peak.frequency_hz < kMinBlockPeriods) return result;

  // Blocks: 24 to a record, but at least eight periods, long enough for ten times the noise's
  // power, and no longer than the phase stays coherent.
  double frequency = peak.frequency_hz;
  const double longest_s = duration_s / 8.0;
  const double for_noise_s = 10.0 * 1.5 * peak.noise_psd / std::max(peak.power, 1e-300);
  const bool follows_slow = slow != nullptr && Follows(kMinBlockPeriods / frequency, *slow);
  const double planned_s = follows_slow ? 0.0 : duration_s / kBlocksPerRecord;
  double length_s =
      std::clamp(planned_s, std::min(kMinBlockPeriods / frequency, longest_s), longest_s);
  length_s = std::min(std::max(length_s, for_noise_s), longest_s);
  Blocks p_blocks, q_blocks;
  PhaseSeries phase;
  LineFrequency line;
  for (int pass = 0; pass < options.block_passes; ++pass) {
    const int length = static_cast<int>(length_s * record.sampling_hz);
    p_blocks = Demodulate(p, record.sampling_hz, frequency, length);
    result.block_samples = length;
    phase = UnwrapPhase(p_blocks.amplitude);
    if (pass == options.block_passes - 1) break;
    line = EstimateLineFrequency(p_blocks.amplitude, phase, p_blocks.hop_s);
    if (std::isfinite(line.offset_hz.value)) frequency += line.offset_hz.value;
    const double coherent_s =
        2.0 / std::max(line.diffusion_rad2_per_s, kLeastDiffusion * frequency);
    const double shortest_s = std::min(kMinBlockPeriods / frequency, longest_s);
    length_s = std::clamp(std::min(length_s, coherent_s), shortest_s, longest_s);
  }
  if (!q.empty()) {
    q_blocks = Demodulate(q, record.sampling_hz, frequency, result.block_samples);
    const int apart =
        static_cast<int>(std::min(options.least_ratio_block_s, longest_s) * record.sampling_hz);
    if (apart > result.block_samples) {
      EstimateRatio(Demodulate(p, record.sampling_hz, frequency, apart).amplitude,
                    Demodulate(q, record.sampling_hz, frequency, apart).amplitude, &result);
    } else {
      EstimateRatio(p_blocks.amplitude, q_blocks.amplitude, &result);
    }
    result.q_amplitude = std::sqrt(MeanSquare(q_blocks.amplitude));
  }
  if (phase.reliable) {
    std::vector<std::pair<int, Complexes>> others;
    if (!q.empty()) others.emplace_back(1, q_blocks.amplitude);
    for (int h = 2; h <= 3 && h * frequency < 0.45 * record.sampling_hz; ++h) {
      for (const std::vector<double>* x : {&p, &q}) {
        if (x->empty()) continue;
        others.emplace_back(
            h, Demodulate(*x, record.sampling_hz, h * frequency, result.block_samples).amplitude);
      }
    }
    ImprovePhase(others, phase.phase_rad);
  }
  line = EstimateLineFrequency(p_blocks.amplitude, phase, p_blocks.hop_s);
  if (slow != nullptr) {
    const Blocks straight = WithoutPhaseSwing(p, record.sampling_hz, frequency, p_blocks, *slow);
    line =
        EstimateLineFrequency(straight.amplitude, UnwrapPhase(straight.amplitude), straight.hop_s);
  }
  result.frequency_hz = {frequency + line.offset_hz.value, line.offset_hz.std};
  result.frequency_drift_hz_per_s = line.drift_hz_per_s;
  result.line_width_hz = line.diffusion_rad2_per_s / kRadPerSPerHz;
  result.block_noise_power = 3.0 * peak.noise_psd / p_blocks.length_s;
  result.floor_incoherent_share = IncoherentShare(spectrum, peak.frequency_hz);
  EstimateEnvelope(p_blocks.amplitude, p_blocks.hop_s, &result);
  if (slow != nullptr) {
    result.slow_modulation = PeriodicFluctuation(p_blocks, *slow, record.sampling_hz);
    // A^2 = M R, M periodic and R independent of it with mean one: 1 + F = (1 + F_M) (1 + F_R).
    result.power_fluctuation.value = std::max(
        (1.0 + result.power_fluctuation.value) / (1.0 + result.slow_modulation) - 1.0, 0.0);
  }
  Classify(options, duration_s, &result);

  if (options.method == CharacteristicsMethod::kPaper && !q.empty()) {
    const double top =
        options.max_frequency_hz > 0 ? options.max_frequency_hz : 0.4 * record.sampling_hz;
    const Characteristics paper =
        PaperCharacteristics(p, q, record.sampling_hz, peak.test.low_hz, top);
    result.frequency_hz = {paper.frequency_hz.value, kNan};
    result.phase_deg = {paper.phase_deg.value, kNan};
    result.gain = {paper.gain.value, kNan};
  }
  return result;
}

Characteristics EstimateCharacteristics(const Record& record, const CrossSpectrum& spectrum,
                                        const CharacteristicsOptions& options) {
  const double duration_s = static_cast<double>(record.pressure.size()) / record.sampling_hz;
  const double lowest_hz = options.min_frequency_hz > 0.0
                               ? options.min_frequency_hz
                               : LowestSearched(record.sampling_hz, duration_s);
  return CharacteristicsAt(
      record, spectrum, FindPeak(spectrum, options.max_frequency_hz, lowest_hz, record.sampling_hz),
      options);
}

}  // namespace howl
