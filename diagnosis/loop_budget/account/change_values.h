// What a slow change (slow_changes.h) is at an operating point, in the units of the catalogue.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_CHANGE_VALUES_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_CHANGE_VALUES_H_

#include <functional>
#include <string>

#include "diagnosis/loop_budget/forms/loop_item.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// Without a unit, and zero where nothing changes.
struct PointValue {
  std::string name;
  std::function<double(const RecordSpectra&, const LoopPoint&)> of;
};

PointValue ValueOfChange(const LoopItem& item);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_CHANGE_VALUES_H_
