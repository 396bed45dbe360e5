// How an effect that is no transfer function is tried at a size (sample_changes.h).
#ifndef HOWL_DIAGNOSIS_PLAN_SAMPLE_TRIAL_H_
#define HOWL_DIAGNOSIS_PLAN_SAMPLE_TRIAL_H_

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/plan/plan_records.h"
#include "diagnosis/plan/sample_changes.h"

namespace howl {

struct SampleTrial {
  std::string rival;      // of the same kind; empty: none
  double first = 0.0;     // trial size
  double factor = 4.0;    // between trial sizes
  bool inverted = false;  // a smaller value is a larger effect
  double most = 0.0;      // value
  double least = 0.0;
  std::vector<std::pair<std::string, double>> others;
  std::function<SampleFinding(double)> at;
};

// `at` must outlive what is returned. Nothing for a kind that a plan does not know.
std::optional<SampleTrial> TrialOf(const PlanRecords& at, const Effect& effect);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_SAMPLE_TRIAL_H_
