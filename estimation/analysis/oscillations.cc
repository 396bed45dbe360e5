#include "estimation/analysis/oscillations.h"

#include <algorithm>
#include <cmath>

#include "estimation/analysis/oscillation_lines.h"
#include "model/units.h"

namespace howl {
namespace {

// A line that is weaker than this beside the cycle moves no estimate by more than the blocks'
// side lobes of a hundredth let it.
constexpr double kLeastRemovedShare = 0.001;
constexpr double kFarBelowCycle = 0.25;
constexpr double kSidebandShare = 0.1;   // of the carrier's spectrum
constexpr double kSidebandReach = 3.5;   // slow frequencies on either side hold most of the power
constexpr double kMainLobeWidths = 2.0;  // of a Hann block, from its peak to the first null
constexpr int kBlockPasses = 8;

double Duration(const Record& record) {
  return static_cast<double>(record.pressure.size()) / record.sampling_hz;
}

// A cycle whose phase a slow oscillation swings far has sidebands above its carrier. The mean
// frequency over the spectrum of all of them is the carrier's. False where there are none.
bool MoveToCarrier(const CrossSpectrum& spectrum, double slow_hz, SpectralPeak* peak) {
  const auto power_at = [&](double hz) {
    const int middle = static_cast<int>(std::lround(hz / spectrum.bin_hz));
    double highest = 0.0;
    for (int k = std::max(middle - 2, 0);
         k <= std::min(middle + 2, static_cast<int>(spectrum.pp.size()) - 1); ++k) {
      highest = std::max(highest, spectrum.pp[static_cast<std::size_t>(k)]);
    }
    return highest;
  };
  const double f = peak->frequency_hz;
  if (std::max(power_at(f - slow_hz), power_at(f + slow_hz)) < kSidebandShare * power_at(f)) {
    return false;
  }
  for (int pass = 0; pass < 3; ++pass) {
    double sum = 0.0, moment = 0.0;
    const double reach = kSidebandReach * slow_hz;
    for (std::size_t k = 1; k < spectrum.pp.size(); ++k) {
      const double hz = spectrum.Frequency(static_cast<int>(k));
      if (std::abs(hz - peak->frequency_hz) > reach) continue;
      const double above = std::max(spectrum.pp[k] - peak->noise_psd, 0.0);
      sum += above;
      moment += above * hz;
    }
    if (!(sum > 0.0)) break;
    peak->frequency_hz = moment / sum;
    peak->power = sum * spectrum.bin_hz;
  }
  return true;
}

// The slow oscillation that modulates the cycle at the peak, which then moves to its carrier.
std::optional<SlowOscillation> ModulationOf(const Record& record, const CrossSpectrum& spectrum,
                                            std::span<const OscillationLine> lines,
                                            SpectralPeak* peak) {
  std::optional<SlowOscillation> slow = SlowBeside(record, lines, peak->frequency_hz);
  if (!slow || !MoveToCarrier(spectrum, slow->frequency_hz, peak)) return std::nullopt;
  return slow;
}

// Notches for all lines but the cycle itself, its multiples and the sidebands of its modulation.
std::vector<Notch> NotchesBeside(std::span<const OscillationLine> lines, double cycle_hz,
                                 double slow_hz, double duration_s) {
  std::vector<OscillationLine> own = {{cycle_hz, 0.0, 1.0, 1.0}};
  if (slow_hz > 0.0) own.push_back({slow_hz, 0.0, 1.0, 1.0});
  std::vector<Notch> notches;
  for (const OscillationLine& line : lines) {
    const bool is_slow = slow_hz > 0.0 && line.frequency_hz == slow_hz;
    if (!is_slow && IsCombination(line, own)) continue;
    const auto notch = NotchBeside(line.frequency_hz, cycle_hz, duration_s);
    if (notch) notches.push_back(*notch);
  }
  return notches;
}

// Notches for the lines outside a range, each as wide as leaves the range's middle alone.
std::vector<Notch> NotchesOutside(std::span<const OscillationLine> lines, double low_hz,
                                  double high_hz, double duration_s) {
  std::vector<Notch> notches;
  for (const OscillationLine& line : lines) {
    if (line.frequency_hz >= low_hz && line.frequency_hz <= high_hz) continue;
    const auto notch = NotchBeside(line.frequency_hz, 0.5 * (low_hz + high_hz), duration_s);
    if (notch) notches.push_back(*notch);
  }
  return notches;
}

// Blocks in which every notched oscillation lies beyond the main lobe.
double BlockApart(std::span<const Notch> notches, double cycle_hz) {
  double longest = 0.0;
  for (const Notch& notch : notches) {
    longest = std::max(longest, kMainLobeWidths / std::abs(notch.frequency_hz - cycle_hz));
  }
  return longest;
}

Record PressureForHeatRelease(const Record& record) {
  return {record.sampling_hz, record.heat_release, record.pressure};
}

CrossSpectrum PressureForHeatRelease(const CrossSpectrum& spectrum) {
  CrossSpectrum swapped = spectrum;
  std::swap(swapped.pp, swapped.qq);
  for (std::complex<double>& s : swapped.qp) s = std::conj(s);
  return swapped;
}

// What was found with p and q in each other's place.
Characteristics Exchanged(Characteristics c) {
  std::swap(c.p_amplitude, c.q_amplitude);
  c.phase_deg.value = -c.phase_deg.value;
  c.gain = {1.0 / c.gain.value, c.gain.std / (c.gain.value * c.gain.value)};
  return c;
}

// The narrow range about a line in which its own peak is looked for.
SpectralPeak PeakOf(const OscillationLine& line, const CrossSpectrum& spectrum,
                    double sampling_hz) {
  const double reach = std::max(line.tolerance_hz, 2.0 * spectrum.bin_hz);
  return FindPeak(spectrum, line.frequency_hz + reach,
                  std::max(line.frequency_hz - reach, spectrum.bin_hz), sampling_hz);
}

Characteristics CharacteristicsOf(const OscillationLine& line, std::span<const OscillationLine> all,
                                  const Record& record, const CrossSpectrum& spectrum,
                                  CharacteristicsOptions options) {
  const bool by_q = !record.heat_release.empty() && line.q_share > line.p_share;
  std::vector<OscillationLine> others;
  for (const OscillationLine& other : all) {
    if (other.frequency_hz != line.frequency_hz) others.push_back(other);
  }
  const std::vector<Notch> notches =
      NotchesBeside(others, line.frequency_hz, 0.0, Duration(record));
  const Record cleaned = WithoutOscillations(record, notches);
  options.least_ratio_block_s = BlockApart(notches, line.frequency_hz);
  options.method = CharacteristicsMethod::kLocal;
  options.block_passes = kBlockPasses;
  const CrossSpectrum& own = by_q ? PressureForHeatRelease(spectrum) : spectrum;
  SpectralPeak peak = PeakOf(line, own, record.sampling_hz);
  const std::optional<SlowOscillation> slow = ModulationOf(record, own, others, &peak);
  const Characteristics c = CharacteristicsAt(by_q ? PressureForHeatRelease(cleaned) : cleaned, own,
                                              peak, options, slow ? &*slow : nullptr);
  return by_q ? Exchanged(c) : c;
}

}  // namespace

std::optional<CycleBesideOthers> ReadCycleBesideOthers(const Record& record,
                                                       const CrossSpectrum& spectrum,
                                                       const CharacteristicsOptions& options) {
  const double duration_s = Duration(record);
  const double lowest_hz = options.min_frequency_hz > 0.0
                               ? options.min_frequency_hz
                               : LowestSearched(record.sampling_hz, duration_s);
  const std::vector<OscillationLine> lines = StrongLines(record, spectrum, kLeastRemovedShare);
  // What lies outside a range that the config picks is not asked for: its skirt may be higher than
  // the peak inside.
  std::vector<double> searched = record.pressure;
  if (options.min_frequency_hz > 0.0 && options.max_frequency_hz > 0.0) {
    searched = WithoutOscillations({record.sampling_hz, record.pressure, {}},
                                   NotchesOutside(lines, options.min_frequency_hz,
                                                  options.max_frequency_hz, duration_s))
                   .pressure;
  }
  SpectralPeak peak = PeakAtAnyResolution(RemoveMean(searched), options.max_frequency_hz, lowest_hz,
                                          record.sampling_hz);
  if (!peak.significant || duration_s * peak.frequency_hz < kFewestPeriods) return std::nullopt;
  const std::optional<SlowOscillation> slow = ModulationOf(record, spectrum, lines, &peak);
  const std::vector<Notch> notches =
      NotchesBeside(lines, peak.frequency_hz, slow ? slow->frequency_hz : 0.0, duration_s);
  CharacteristicsOptions patient = options;
  patient.block_passes = kBlockPasses;
  patient.least_ratio_block_s = BlockApart(notches, peak.frequency_hz);
  CycleBesideOthers beside;
  beside.characteristics = CharacteristicsAt(WithoutOscillations(record, notches), spectrum, peak,
                                             patient, slow ? &*slow : nullptr);
  for (const Notch& notch : notches) {
    if (notch.frequency_hz < kFarBelowCycle * peak.frequency_hz) beside.slow.push_back(notch);
  }
  return beside;
}

std::vector<Oscillation> ListOscillations(const Record& record, const CrossSpectrum& spectrum,
                                          const Characteristics& cycle,
                                          const CharacteristicsOptions& options) {
  const double p_power = Variance(record.pressure);
  const double q_power = Variance(record.heat_release);
  const auto share = [](double amplitude, double power) {
    return power > 0.0 ? 0.5 * amplitude * amplitude / power : 0.0;
  };
  std::vector<OscillationLine> kept;
  std::vector<Oscillation> found;
  if (cycle.state != CycleState::kNoLimitCycle) {
    const double width_hz = std::max(cycle.line_width_hz, spectrum.bin_hz);
    found.push_back(
        {cycle, share(cycle.p_amplitude, p_power), share(cycle.q_amplitude, q_power), true});
    kept.push_back({cycle.frequency_hz.value, width_hz, found[0].p_share, found[0].q_share});
  }
  const std::vector<OscillationLine> lines = StrongLines(record, spectrum, kLeastOscillationShare);
  for (const OscillationLine& line : lines) {
    if (IsCombination(line, kept)) continue;
    kept.push_back(line);
    found.push_back(
        {CharacteristicsOf(line, lines, record, spectrum, options), line.p_share, line.q_share});
  }
  std::ranges::stable_sort(found, std::greater<>(), [](const Oscillation& one) {
    return std::max(one.p_share, one.q_share);
  });
  return found;
}

}  // namespace howl
