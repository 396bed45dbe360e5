// What a plan begins with: the records, and the fit of the loop with no effect.
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_RECORDS_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_RECORDS_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/records/cut_record.h"

namespace howl {

// Everything that an effect is put into.
struct PlanRecords {
  const std::vector<DiagnosisExperiment>* experiments = nullptr;
  const std::vector<CutRecord>* records = nullptr;  // cut from them
  const EffectFit* base = nullptr;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_RECORDS_H_
