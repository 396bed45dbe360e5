// The gap between model and rig: how wide it is, where it lies, which effect causes it, and how far
// that effect shrinks it.
//
// Gap: for each experiment and cut the mean of |E|^2 / V less one, V being the noise (sensor noise
// of cut A without a model; combustion noise of cut B by the best fit); the root of the mean of its
// positive parts. 0: the residuals are noise. Held out: tau and an effect's parameters come from
// the other experiments.
//
// Verdict: `none` while neither an effect nor free slack gains more log-likelihood than noise
// gives; `unknown` if the gain that free slack still has after the best effect is not small against
// the effect's own gain; else the best effect, with those that come close to it.
#ifndef HOWL_DIAGNOSIS_DIAGNOSIS_H_
#define HOWL_DIAGNOSIS_DIAGNOSIS_H_

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/budget/budget.h"
#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/fit/fit_memory.h"
#include "diagnosis/fit/moved_parameters.h"
#include "diagnosis/gap/gap_map.h"
#include "diagnosis/records/cut_record.h"
#include "model/effects/catalogue.h"

namespace howl {

enum class VerdictKind : std::uint8_t { kNone, kEffect, kUnknown };

struct Candidate {
  std::string effect;
  LoopBlock block = LoopBlock::kAcoustics;
  double gain = 0.0;  // of log-likelihood over the base, less half a log(data) a parameter
  double gap_after = 0.0;
  double shrinkage = 0.0;
  double shrinkage_low = 0.0;  // 95 %, over the experiments
  double shrinkage_high = 0.0;
  // Of the largest gain in the catalogue: by the bootstrap if there was one, else roughly by
  // chi-square.
  double p_value = 1.0;
  double probability = 0.0;
  std::vector<EstimatedParameter> parameters;
};

struct Diagnosis {
  VerdictKind kind = VerdictKind::kNone;
  std::string effect;  // empty unless kEffect; "a+b": two at once
  // p_clipping where it was detected in the samples and taken out of them before the search; else
  // empty. It comes first in `effect` and in every candidate; a verdict of unknown is then about
  // what is left once it is repaired.
  std::string repaired;
  std::vector<std::string> indistinguishable;
  // With the verdict unknown: two effects of the catalogue that together would leave little; empty
  // if there are none.
  std::string together;
  double probability_none = 0.0;
  double probability_unknown = 0.0;
  std::vector<Place> where;
  double gap_before = 0.0;
  double gap_after = 0.0;
  double gap_floor = 0.0;
  // Median shrinkage of the gap by placebo effects with as many parameters as the best candidate
  // (placebo.h); NaN where the best is no transfer function.
  double placebo_shrinkage = std::numeric_limits<double>::quiet_NaN();
  std::vector<GapCell> map;           // before and after the best effect
  std::vector<Candidate> candidates;  // the most probable first
  BaseModel model;                    // the base to which effects were added
  // The gain in log-likelihood by a second mode, less the price of its coefficients, where the
  // records choose the modes (choose_modes.h); NaN where the model states them.
  double second_mode_gain = std::numeric_limits<double>::quiet_NaN();
  // The gain in log-likelihood by own delays, given the best effect or none, where the records
  // choose the delays; NaN where the model states them.
  double own_delays_gain = std::numeric_limits<double>::quiet_NaN();
  double delay_scatter = 0.0;  // of log tau over the experiments, in the best fit
  // The loop's parameters that moved, where the verdict is an effect whose fit has them.
  std::vector<MovedParameter> base_parameters;
  // The gain in log-likelihood by free slack before and after the best effect, in cuts A and B.
  double slack_acoustic_before = 0.0;
  double slack_flame_before = 0.0;
  double slack_acoustic_after = 0.0;
  double slack_flame_after = 0.0;
  // The largest gain of each replicate of the bootstrap, ascending; empty if there was none.
  std::vector<double> bootstrap_gains;
  std::string advice;
  // Where no single cause was found, what a search for several adds to the base (budget/budget.h).
  std::optional<Budget> budget;
  bool stopped = false;  // the run was stopped before its end, and the rest is empty
};

struct DiagnosisOptions {
  BaseModel model;
  bool choose_modes = false;   // by the records, whatever the model says
  bool choose_delays = false;  // the same: one for all, or each experiment's own
  int threads = 0;             // 0: as many as the machine has
  std::uint64_t seed = 1;      // of the bootstrap's replicates
  std::size_t bootstrap = 0;   // replicates (bootstrap/bootstrap.h)
  // Where it is set, only these replicates are run, for the memory, and the diagnosis then ends as
  // if it had been stopped: one of several processes' shares.
  std::function<bool(std::size_t replicate)> owns_replicate;
  // Where no single cause is found, several are searched for (Diagnosis::budget).
  bool find_budget = true;
  std::vector<std::string> withheld;   // identifiers of the catalogue that are not tried
  std::vector<EffectPointer> further;  // effects of the user's own
  // Records that take the model's place (reference.h); none: the base alone is the model.
  std::vector<DiagnosisExperiment> reference;
  // Progress in starts of the search, of which an effect has a few or many.
  std::function<void(std::size_t done, std::size_t total)> progress;
  std::function<void(std::size_t done, std::size_t total)> bootstrap_progress;
  std::function<void(std::size_t done, std::size_t total)> budget_progress;
  FitMemory* memory = nullptr;    // of an interrupted run of the same inputs
  std::function<bool()> stopped;  // asked between effects
};

// The diagnosis is the same for any number of threads; nothing in it is random but the bootstrap.
Diagnosis Diagnose(const std::vector<DiagnosisExperiment>& experiments,
                   const DiagnosisOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_DIAGNOSIS_H_
