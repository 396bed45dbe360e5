#include "io/records/known_instruments.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "estimation/analysis/instruments/remove_instruments.h"
#include "io/number_range.h"
#include "io/records/columns/number_text.h"
#include "io/records/response_table.h"
#include "io/user_error.h"

namespace howl {

InstrumentResponse ResponseOf(const ResponseSpec& known) {
  return known.formula ? *known.formula : ReadResponseTable(known.table);
}

void TakeOutInstruments(const RecordSpec& spec, const std::string& config_file, Record& record) {
  const auto response = [](const std::optional<ResponseSpec>& known) {
    return known ? std::optional(ResponseOf(*known)) : std::nullopt;
  };
  const Instruments instruments = {response(spec.pressure_response),
                                   response(spec.heat_release_response), spec.delay_s,
                                   spec.pressure_in_heat_release};
  if (instruments.None()) return;
  const double length_s = static_cast<double>(record.pressure.size()) / record.sampling_hz;
  const double most_s = kMostDroppedShare * length_s;
  if (!(std::abs(spec.delay_s) <= most_s)) {
    throw UserError(config_file, spec.delay_line, "delay_s",
                    NumberText(spec.delay_s) + " s, expected at most a fiftieth of the record's " +
                        NumberText(length_s, 6) + " s");
  }
  const auto fail = [&](Channel channel, const std::string& what) {
    const bool pressure = channel == Channel::kPressure;
    const auto& known = pressure ? spec.pressure_response : spec.heat_release_response;
    if (known) {
      throw UserError(config_file, known->line,
                      pressure ? "pressure_response" : "heat_release_response", what);
    }
    throw UserError(config_file, spec.pressure_in_heat_release_line, "pressure_in_heat_release",
                    what);
  };
  if (const auto fault = RemoveInstruments(instruments, record)) {
    fail(fault->channel, fault->zero
                             ? "is zero at every frequency of the record, expected a "
                               "response that lets something through"
                             : "has no finite value at " + NumberText(fault->frequency_hz, 6) +
                                   " Hz, expected one at every frequency above 0 Hz up to "
                                   "half of the sampling rate");
  }
  const auto check = [&](const std::vector<double>& signal, Channel channel) {
    if (signal.empty()) return;
    const auto [least, most] = std::minmax_element(signal.begin(), signal.end());
    const bool good = std::abs(*least) <= kMostMagnitude && std::abs(*most) <= kMostMagnitude &&
                      *most - *least >= kLeastMagnitude;
    if (!good) {
      fail(channel, "leaves a signal from " + NumberText(*least) + " to " + NumberText(*most) +
                        ", expected one that moves by 1e-30 or more and is within 1e30");
    }
  };
  check(record.pressure, Channel::kPressure);
  check(record.heat_release, Channel::kHeatRelease);
}

}  // namespace howl
