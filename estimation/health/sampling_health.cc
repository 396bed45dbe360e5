#include <cmath>
#include <string>

#include "estimation/health/analysis_health.h"
#include "estimation/health/number_words.h"

namespace howl {
namespace {

// A record without a cycle is read again at another rate up to this one: at faster sampling the
// range of frequencies is wide enough for the cycles that a user expects.
constexpr double kSuspectRateHz = 1000.0;
// A duct whose lowest mode is slower is longer than a hundred metres.
constexpr double kSlowestCycleHz = 1.0;

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
  const Characteristics& cycle = analysis.characteristics;
  const bool has_cycle = cycle.state != CycleState::kNoLimitCycle;
  const bool suspect =
      has_cycle ? cycle.frequency_hz.value < kSlowestCycleHz : rate_hz <= kSuspectRateHz;
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
    finding.text =
        record.name + ": " + origin + (source == RateSource::kTimeColumn ? unit.time : unit.rate) +
        ", the sampling rate is " + NumberWord(other_hz, 6) +
        " Hz, and the record has a cycle at " +
        NumberWord(other.characteristics.frequency_hz.value, 4) + " Hz" +
        (has_cycle ? ", not at " + NumberWord(cycle.frequency_hz.value, 4) + " Hz" : std::string());
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
