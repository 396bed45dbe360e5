// How well a structure foretells what it was not fitted to. The operating points are divided into
// two sets, and each record into two halves. What all points share (delay, effects, model error)
// is fitted to one set; a point's own parameters to one half of its record, given the shared ones
// of the other set; the other half is then predicted:
//
//   nats of a point and half: its log-likelihood there      gap: prediction_gap.h
//
// With fewer than four operating points the shared parameters are of the same points' other half.
#ifndef HOWL_DIAGNOSIS_BUDGET_HELD_OUT_H_
#define HOWL_DIAGNOSIS_BUDGET_HELD_OUT_H_

#include <array>
#include <vector>

#include "diagnosis/budget/prediction_gap.h"
#include "diagnosis/held_out/held_out_score.h"
#include "diagnosis/structure/structure_fit.h"

namespace howl {

// Lines that are no harmonics of the cycle are masked: they are no matter of transfer functions.
struct BudgetRecords {
  std::vector<CutRecord> records;
  std::vector<JointBand> whole;
  std::array<std::vector<JointBand>, 2> halves;
};
BudgetRecords MakeBudgetRecords(const std::vector<DiagnosisExperiment>& experiments,
                                const BaseModel& model);

// The fit's part that is about these operating points.
StructureFit OfPoints(const StructureFit& fit, const std::vector<std::size_t>& which);

// `fit`: to all the records, from which the fits to parts of them begin.
HeldOutScore ScoreHeldOut(const BudgetRecords& records, const StructureFit& fit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_HELD_OUT_H_
