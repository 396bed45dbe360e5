#include "estimation/analysis/cycle/characteristics.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "estimation/analysis/cycle/cycle_blocks.h"
#include "estimation/analysis/spectra/line_phase.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMinBlockPeriods = kFewestPeriods;
constexpr double kBlocksPerRecord = 24.0;
constexpr double kLeastDiffusion = 5e-12;  // rad^2 a period: a steadier phase counts as this steady

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
    std::vector<std::pair<int, BlockAmplitudes>> others;
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
