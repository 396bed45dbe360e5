#include "estimation/analysis/oscillations/cycle_beside_others.h"

#include "estimation/analysis/oscillations/carrier.h"
#include "estimation/analysis/oscillations/notches_beside.h"
#include "estimation/analysis/oscillations/strong_lines.h"

namespace howl {
namespace {

// A line that is weaker than this beside the cycle moves no estimate by more than the blocks'
// side lobes of a hundredth let it.
constexpr double kLeastRemovedShare = 0.001;
constexpr double kFarBelowCycle = 0.25;

}  // namespace

std::optional<CycleBesideOthers> ReadCycleBesideOthers(const Record& record,
                                                       const CrossSpectrum& spectrum,
                                                       const CharacteristicsOptions& options) {
  const double duration_s = static_cast<double>(record.pressure.size()) / record.sampling_hz;
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
  patient.block_passes = kBlockPassesBesideOthers;
  patient.least_ratio_block_s = BlockApart(notches, peak.frequency_hz);
  CycleBesideOthers beside;
  beside.characteristics = CharacteristicsAt(WithoutOscillations(record, notches), spectrum, peak,
                                             patient, slow ? &*slow : nullptr);
  for (const Notch& notch : notches) {
    if (notch.frequency_hz < kFarBelowCycle * peak.frequency_hz) beside.slow.push_back(notch);
  }
  return beside;
}

}  // namespace howl
