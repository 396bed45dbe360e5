#include <cmath>
#include <string>

#include "estimation/health/analysis_health.h"
#include "estimation/health/number_words.h"

namespace howl {
namespace {

// Rates up to this many times the lowest frequency that is searched may be a thousand times too
// low: above it the range is wide enough for the cycles that the user expects.
constexpr double kSuspectRates = 50.0;

struct OtherUnit {
  double per_second;
  const char* time;
  const char* rate;
};
constexpr OtherUnit kOtherUnits[] = {{1e3, "milliseconds", "kHz"}, {1e6, "microseconds", "MHz"}};

// The cycle that the record has at another rate.
Analysis AtRate(const NamedRecord& record, const AnalysisOptions& options, double sampling_hz) {
  AnalysisOptions quick = options;
  quick.model.reset();
  Record other = record.record;
  other.sampling_hz = sampling_hz;
  other.heat_release.clear();
  return AnalyseRecord(other, quick);
}

}  // namespace

Health CheckSampling(const NamedRecord& record, const Analysis& analysis,
                     const AnalysisOptions& options, RateSource source) {
  const PeakTest& peak = analysis.characteristics.peak;
  const double rate_hz = record.record.sampling_hz;
  const bool empty = !(peak.low_hz < peak.high_hz);
  const bool suspect = analysis.characteristics.state == CycleState::kNoLimitCycle &&
                       rate_hz <= kSuspectRates * options.characteristics.min_frequency_hz;
  if (!empty && !suspect) return {};
  const std::string origin =
      source == RateSource::kTimeColumn
          ? "the time column steps by " + NumberWord(1.0 / rate_hz) + ": if it is in "
          : "sampling_hz is " + NumberWord(rate_hz, 6) + ": if it is in ";
  Finding finding{FindingKind::kSampling, record.name, "sampling_hz", rate_hz};
  for (const OtherUnit& unit : kOtherUnits) {
    const double other_hz = rate_hz * unit.per_second;
    const Analysis other = AtRate(record, options, other_hz);
    if (other.characteristics.state == CycleState::kNoLimitCycle) continue;
    finding.limit = other_hz;
    finding.text = record.name + ": " + origin +
                   (source == RateSource::kTimeColumn ? unit.time : unit.rate) +
                   ", the sampling rate is " + NumberWord(other_hz, 6) +
                   " Hz, and the record has a cycle at " +
                   NumberWord(other.characteristics.frequency_hz.value, 4) + " Hz";
    return {finding};
  }
  if (!empty) return {};
  finding.limit = rate_hz * kOtherUnits[0].per_second;
  finding.text = record.name + ": " + origin +
                 (source == RateSource::kTimeColumn ? kOtherUnits[0].time : kOtherUnits[0].rate) +
                 ", the sampling rate is " + NumberWord(finding.limit, 6) + " Hz; at " +
                 NumberWord(rate_hz, 6) + " Hz no cycle above " + NumberWord(peak.low_hz) +
                 " Hz can be seen (analysis: min_frequency_hz)";
  return {finding};
}

}  // namespace howl
