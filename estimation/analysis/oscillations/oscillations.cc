#include "estimation/analysis/oscillations/oscillations.h"

#include <algorithm>
#include <cmath>

#include "estimation/analysis/oscillations/carrier.h"
#include "estimation/analysis/oscillations/notches_beside.h"
#include "estimation/analysis/oscillations/strong_lines.h"

namespace howl {
namespace {

double Duration(const Record& record) {
  return static_cast<double>(record.pressure.size()) / record.sampling_hz;
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
  options.block_passes = kBlockPassesBesideOthers;
  const CrossSpectrum& own = by_q ? PressureForHeatRelease(spectrum) : spectrum;
  SpectralPeak peak = PeakOf(line, own, record.sampling_hz);
  const std::optional<SlowOscillation> slow = ModulationOf(record, own, others, &peak);
  const Characteristics c = CharacteristicsAt(by_q ? PressureForHeatRelease(cleaned) : cleaned, own,
                                              peak, options, slow ? &*slow : nullptr);
  return by_q ? Exchanged(c) : c;
}

}  // namespace

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
