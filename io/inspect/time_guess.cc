#include "io/inspect/time_guess.h"

#include <algorithm>
#include <cmath>

#include "io/records/columns/number_text.h"
#include "io/records/columns/time_column.h"
#include "io/records/columns/time_unit.h"

namespace howl {
namespace {

constexpr double kSameRate = 0.01;

struct Steps {
  double step = 0.0;  // in the column's own unit; 0: it does not grow
  double resolution = 0.0;
  std::optional<TimeFault> fault;
};

Steps StepsOf(const ColumnLook& column) {
  Steps steps;
  if (!column.IsSignal() || column.not_finite > 0) return steps;
  steps.resolution = TimeResolution(column.values);
  steps.step = TypicalStep(column.values, steps.resolution);
  if (steps.step > 0.0) {
    steps.fault = FindTimeFault(column.values, steps.step, steps.resolution);
  }
  return steps;
}

// 0, 1, 2, ...: rows that were counted, and no time in any unit that is known.
bool IsCount(const ColumnLook& column, const Steps& steps) {
  return steps.step == 1.0 && (column.values.front() == 0.0 || column.values.front() == 1.0);
}

std::string RateWords(double rate_hz) { return NumberText(rate_hz, 5) + " Hz"; }

void GuessUnit(const ColumnLook& column, const Steps& steps, TimeGuess& time) {
  const double rate_hz = SamplingRateHz(column.values, steps.resolution);  // if in seconds
  const std::optional<double> stated_hz = time.sampling_hz;
  const auto take = [&](double unit_s, const std::string& reason) {
    time.unit_s = unit_s;
    time.unit_reason = reason;
    time.sampling_hz = SamplingRateHz(column.values, steps.resolution) * (1.0 / unit_s);
    time.sampling_reason = "the steps of time";
  };
  if (const auto named = TimeUnitOfName(column.info.label)) {
    time.unit_is_named = true;
    return take(*named, "by its name, \"" + column.info.label + "\"");
  }
  if (const auto unit_s =
          stated_hz ? TimeUnitOfRates(rate_hz, *stated_hz, kSameRate) : std::nullopt) {
    return take(*unit_s, "gives the " + RateWords(*stated_hz) + " of " + time.sampling_reason);
  }
  for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
    const double in_this_hz = rate_hz * (1.0 / unit_s);
    if (in_this_hz < kLeastUsualRateHz || in_this_hz > kMostUsualRateHz) continue;
    const double other_s = unit_s == 1.0 ? 1e-3 : 1.0;
    return take(unit_s, "steps of " + NumberText(1.0 / rate_hz, 4) + " are " +
                            RateWords(in_this_hz) + " (in " + std::string(UnitOfSeconds(other_s)) +
                            " they would be " + RateWords(rate_hz * (1.0 / other_s)) + ")");
  }
  take(1.0, "no unit gives a usual sampling rate: in s it is " + RateWords(rate_hz));
}

}  // namespace

void GuessTime(std::span<const ColumnLook> columns, TimeGuess& time) {
  std::optional<std::size_t> by_values;
  Steps found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const ColumnMeaning meaning = columns[i].words.meaning;
    const bool is_named = meaning == ColumnMeaning::kTime;
    if (!is_named && (meaning != ColumnMeaning::kNone || by_values)) continue;
    Steps steps = StepsOf(columns[i]);
    if (steps.step <= 0.0 || (!is_named && (steps.fault || IsCount(columns[i], steps)))) continue;
    found = std::move(steps);
    by_values = i;
    if (!is_named) continue;
    time.column_reason = "by its name, \"" + columns[i].words.word + "\"";
    break;
  }
  if (!by_values) return;
  time.column = by_values;
  const ColumnLook& column = columns[*by_values];
  time.column_reason += time.column_reason.empty() ? "it grows by even steps" : ", and it grows";
  if (found.fault) {
    time.column_reason += ", but not evenly: sample " + std::to_string(found.fault->row + 1) +
                          ", " + found.fault->what;
  }
  GuessUnit(column, found, time);
}

std::string UnitText(const TimeGuess& time) {
  if (!time.column || time.unit_is_named || time.unit_s == 1.0) return "";
  return std::string(UnitOfSeconds(time.unit_s));
}

}  // namespace howl
