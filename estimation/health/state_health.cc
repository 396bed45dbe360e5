#include <cmath>
#include <string>

#include "estimation/health/analysis_health.h"
#include "estimation/health/number_words.h"

namespace howl {
namespace {

std::string PlusMinus(const Estimate& estimate) {
  std::string text = NumberWord(estimate.value);
  if (std::isfinite(estimate.std)) text += " ± " + NumberWord(kNormal95 * estimate.std, 2);
  return text;
}

// The finding where there is no peak that could be followed.
Finding Peakless(const Analysis& analysis) {
  const PeakTest& peak = analysis.characteristics.peak;
  Finding finding{FindingKind::kState, analysis.name};
  const std::string name = analysis.name + ": no limit cycle: ";
  if (!(peak.low_hz < peak.high_hz)) {
    finding.subject = "search_range";
    finding.value = peak.high_hz;
    finding.limit = peak.low_hz;
    finding.text = name + "between " + NumberWord(peak.low_hz) + " and " +
                   NumberWord(peak.high_hz) + " Hz there is nowhere to look for one";
  } else if (peak.frequency_hz < peak.low_hz || peak.frequency_hz > peak.high_hz) {
    finding.subject = "search_range";
    finding.value = peak.frequency_hz;
    finding.limit = peak.frequency_hz < peak.low_hz ? peak.low_hz : peak.high_hz;
    finding.text = name + "what is highest between " + NumberWord(peak.low_hz) + " and " +
                   NumberWord(peak.high_hz) + " Hz is the skirt of an oscillation at " +
                   NumberWord(peak.frequency_hz, 4) + " Hz";
  } else if (peak.over_floor <= peak.threshold) {
    finding.subject = "peak_over_floor";
    finding.value = peak.over_floor;
    finding.limit = peak.threshold;
    finding.text = name + "the highest peak of p, at " + NumberWord(peak.frequency_hz, 4) +
                   " Hz, stands " + NumberWord(peak.over_floor) + " times over its floor, where " +
                   NumberWord(peak.threshold) + " is needed";
  } else {
    finding.subject = "periods";
    finding.value = peak.frequency_hz * analysis.duration_s;
    finding.limit = kFewestPeriods;
    finding.text = name + "the record has " + NumberWord(finding.value) + " periods of " +
                   NumberWord(peak.frequency_hz, 4) + " Hz, where " + NumberWord(kFewestPeriods) +
                   " are needed";
  }
  return finding;
}

}  // namespace

Health CheckState(const Analysis& analysis, const CharacteristicsOptions& options) {
  const Characteristics& cycle = analysis.characteristics;
  const Estimate& fluctuation = cycle.power_fluctuation;
  if (cycle.state == CycleState::kNoLimitCycle && !std::isfinite(fluctuation.value)) {
    return {Peakless(analysis)};
  }
  const auto state = [&](const char* subject, double value, double limit, const std::string& text) {
    return Finding{FindingKind::kState,        analysis.name, subject, value, limit,
                   analysis.name + ": " + text};
  };
  const std::string power =
      "the squared amplitude varies by " + PlusMinus(fluctuation) + " of its squared mean, ";
  switch (cycle.state) {
    case CycleState::kNoLimitCycle:
      return {state("power_fluctuation", fluctuation.value, options.no_cycle_fluctuation,
                    "no limit cycle: " + power + "a cycle by at most " +
                        NumberWord(options.no_cycle_fluctuation))};
    case CycleState::kIntermittent:
      return {state("power_fluctuation", fluctuation.value, options.intermittent_fluctuation,
                    "intermittent: " + power + "a steady cycle by at most " +
                        NumberWord(options.intermittent_fluctuation))};
    case CycleState::kLimitCycle:
      break;
  }
  Health health;
  const auto drift = [&](const char* what, const Estimate& rate, double scale, double most) {
    const double whole = std::abs(rate.value) * analysis.duration_s / scale;
    if (!Drifts(rate, most * scale / analysis.duration_s)) return;
    health.push_back(state(what, whole, most,
                           std::string("not stationary: the ") + what + " drifts by " +
                               NumberWord(100.0 * whole) + " % over the record, " +
                               NumberWord(100.0 * most) + " % is allowed"));
  };
  drift("amplitude", cycle.amplitude_drift_per_s, 1.0, kMostAmplitudeDrift);
  drift("frequency", cycle.frequency_drift_hz_per_s, cycle.frequency_hz.value, kMostFrequencyDrift);
  return health;
}

}  // namespace howl
