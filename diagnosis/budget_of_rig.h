// Where a diagnosis finds no single cause: the budget of several, from the paper's loop on, by the
// likelihood of the rig's records (loop_budget.h).
#ifndef HOWL_DIAGNOSIS_BUDGET_OF_RIG_H_
#define HOWL_DIAGNOSIS_BUDGET_OF_RIG_H_

#include <optional>
#include <vector>

#include "diagnosis/loop_budget/forms/loop_form.h"
#include "diagnosis/loop_budget/forms/loop_records.h"
#include "diagnosis/search/diagnosis_options.h"
#include "diagnosis/verdict/budget.h"

namespace howl {

// With the cycle's frequency of each record. Nothing keeps them from being cut
// (make_cut_records.h).
std::vector<LoopRecord> LoopRecordsOf(const std::vector<DiagnosisExperiment>& experiments);

// The paper's loop as records show it: its modes at a ratio of three, with one damping and real
// residues, flame driven by dp/dt; each point's delay is its own.
LoopForm PapersForm(int modes);

// From PapersForm(modes) on, with the options' memory, progress and seed. None where it was
// stopped; what it has fitted until then is in the memory.
std::optional<Budget> BudgetOfRig(const std::vector<DiagnosisExperiment>& experiments, int modes,
                                  const DiagnosisOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_OF_RIG_H_
