// What a diagnosis of these records can find before anything is found: the smallest size of each
// effect that would be named, from which size on it is told from each other effect, and which
// further measurement would separate the rest (isolability).
//
// To first order in an effect's size: the base is fitted to the records, each effect changes the
// residuals of both cuts by so much of their noise, and what the base's parameters undo of it is
// subtracted (plan_point.h, plan_gains.h). An effect is seen where its gain, its parameters paid
// for, exceeds what a diagnosis asks for (DetectionGain); it is told from another where the other,
// at its best size, stays behind by odds of 50 to 1 (kClassProbability). Effects that are no
// transfer functions are put into the records' samples, and judged by the diagnosis' own
// estimators (plan_samples.h).
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_H_

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/records/cut_record.h"
#include "model/effects/effect.h"

namespace howl {

// Another effect, against which an effect is weighed.
struct PlannedRival {
  std::string effect;
  // The parameter's value from which on the effect is told from the rival; NaN: at none that was
  // tried.
  double told_apart_at = std::numeric_limits<double>::quiet_NaN();
  // At the reference size: the nats between the two, and how many odds of 50 to 1 take.
  double nats = 0.0;
  double nats_needed = 0.0;
};

// The smallest size with the effect's other parameters at these values.
struct PlannedSize {
  double smallest = std::numeric_limits<double>::quiet_NaN();  // NaN: not within the bounds
  std::vector<std::pair<std::string, double>> others;
  EffectForm form;
};

struct PlannedEffect {
  std::string effect;
  LoopBlock block = LoopBlock::kAcoustics;
  std::string parameter;  // the size
  std::string unit;
  bool from_infinity = false;  // seen at the smallest size and below it: a cut-off
  double null_value = 0.0;
  PlannedSize size;                                             // the median of those below
  std::vector<PlannedSize> sizes;                               // of every form and start
  double gain_needed = 0.0;                                     // nats, its parameters included
  double reference = std::numeric_limits<double>::quiet_NaN();  // twice the smallest size
  double reference_gain = 0.0;  // nats that it gains there over the base
  std::vector<PlannedRival> rivals;
};

// What one further measurement would do for a pair that is not told apart at the reference size.
struct PlannedTrial {
  std::string what;
  double nats = 0.0;
  double nats_needed = 0.0;
};

struct PlannedPair {
  std::string effect;
  std::string other;
  double nats = 0.0;
  double nats_needed = 0.0;
  std::vector<PlannedTrial> trials;  // the best first
};

struct Plan {
  BaseModel model;
  double tau_s = 0.0;
  double delay_scatter = 0.0;
  std::vector<PlannedEffect> effects;             // in the catalogue's order
  std::vector<std::vector<std::string>> classes;  // of two or more, at the reference sizes
  std::vector<PlannedPair> pairs;                 // the closest, with what would separate them
};

struct PlanOptions {
  BaseModel model;
  bool choose_modes = false;
  int threads = 0;
  std::vector<std::string> withheld;
  std::vector<EffectPointer> further;
};

// The same for any number of threads.
Plan MakePlan(const std::vector<DiagnosisExperiment>& experiments, const PlanOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_H_
