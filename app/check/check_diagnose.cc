#include "app/check/check_diagnose.h"

#include <algorithm>

#include "app/input/diagnose_input.h"
#include "app/input/usable_records.h"
#include "io/user_error.h"

namespace howl {

std::string WhatDiagnoseCanDo(const Config& config, const ProblemInput& input) {
  if (input.records.empty()) {
    const bool any_line = std::ranges::any_of(
        input.experiments, [](const Experiment& each) { return !each.lines.empty(); });
    if (!any_line) {
      throw UserError(config.source.string(), 0, "", "no experiment has a record or lines");
    }
    return "a table: bounds on the lag of the q sensor alone";
  }
  RequireUsable(config, input.records, *input.analysis);
  const std::size_t records = input.records.size();
  std::string text = std::to_string(records) + (records == 1 ? " record" : " records") +
                     " of p and q; modes: " + std::to_string(ModesOfLoop(config));
  if (records == 1) text += "; what varies from one operating point to the next cannot be told";
  return text;
}

}  // namespace howl
