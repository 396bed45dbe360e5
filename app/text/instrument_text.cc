#include "app/text/instrument_text.h"

#include <algorithm>
#include <cmath>

#include "app/text/text_table.h"
#include "estimation/analysis/instruments/remove_instruments.h"
#include "io/records/columns/number_text.h"
#include "io/records/known_instruments.h"

namespace howl {
namespace {

constexpr int kBins = 2000;  // in which the largest response is looked for

double LargestMagnitude(const InstrumentResponse& response, double high_hz) {
  double largest = 0.0;
  for (int k = 1; k <= kBins; ++k) {
    largest = std::max(largest, std::abs(response.At(high_hz * k / kBins)));
  }
  return largest;
}

std::string ChannelText(const std::string& name, const ResponseSpec& spec, const char* channel,
                        const Analysis& analysis) {
  const InstrumentResponse response = ResponseOf(spec);
  const double high_hz = analysis.sampling_hz / 2.0;
  const Characteristics& cycle = analysis.characteristics;
  std::string text;
  const auto band = response.TableBand();
  if (band && (band->low_hz > 0.0 || band->high_hz < high_hz)) {
    text +=
        Wrapped(name + ": " + channel + "_response is a table from " + NumberText(band->low_hz, 4) +
                    " to " + NumberText(band->high_hz, 4) + " Hz: beyond, from 0 to " +
                    NumberText(high_hz, 4) + " Hz, its ends are held",
                2) +
        "\n";
  }
  if (cycle.state == CycleState::kNoLimitCycle) return text;
  const double frequency_hz = cycle.frequency_hz.value;
  const double share = std::abs(response.At(frequency_hz)) / LargestMagnitude(response, high_hz);
  if (share < kLeastResponseShare) {
    text += Wrapped(name + ": at the cycle's " + Fixed(frequency_hz, 1) + " Hz |" + channel +
                        "_response| is " + NumberText(share, 2) +
                        " of its largest: the division is limited below " +
                        NumberText(kLeastResponseShare, 2) + ", and " + channel + " comes back " +
                        NumberText(kLeastResponseShare / share, 2) + " times too small",
                    2) +
            "\n";
  }
  return text;
}

}  // namespace

std::string InstrumentText(const Config& config, const AnalysisSet& set) {
  std::string text;
  auto analysis = set.analyses.begin();
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record || analysis == set.analyses.end()) continue;
    const std::string& name = each.experiment.name;
    const RecordSpec& record = *each.record;
    if (record.pressure_response) {
      text += ChannelText(name, *record.pressure_response, "pressure", *analysis);
    }
    if (record.heat_release_response) {
      text += ChannelText(name, *record.heat_release_response, "heat_release", *analysis);
    }
    ++analysis;
  }
  return text;
}

}  // namespace howl
