// A finished step of the search, as text for the memory of an interrupted run (fit_memory.h): which
// item was added, and what the trials of the others found, from which the next step's begin. The
// item's own fit is made anew, and is bit for bit the same.
#ifndef HOWL_DIAGNOSIS_BUDGET_STEP_MEMORY_H_
#define HOWL_DIAGNOSIS_BUDGET_STEP_MEMORY_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace howl {

struct FinishedStep {
  struct Fitted {
    std::size_t item = 0;
    std::size_t form = 0;
    std::vector<double> values;
  };
  std::optional<std::size_t> added;  // no value: none paid
  std::vector<std::string> equals;
  std::vector<Fitted> fitted;
};

std::string ToText(const FinishedStep& step);
// No value where the text is no step of so many items.
std::optional<FinishedStep> StepFromText(const std::string& text, std::size_t items);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_STEP_MEMORY_H_
