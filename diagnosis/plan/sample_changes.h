// The records' samples with an effect put into them, and what the diagnosis' own estimators find
// there.
#ifndef HOWL_DIAGNOSIS_PLAN_SAMPLE_CHANGES_H_
#define HOWL_DIAGNOSIS_PLAN_SAMPLE_CHANGES_H_

#include <cstdint>
#include <vector>

#include "diagnosis/plan/plan_records.h"
#include "model/loop/instrument.h"

namespace howl {

inline constexpr std::uint64_t kPlanSeed = 21;

// What the estimators say of a trial: the gain of the effect itself and of its rival, both with
// their parameters paid for.
struct SampleFinding {
  bool seen = false;
  double own = 0.0;
  double rival = 0.0;
  bool model_free = false;
};

// Less the price of the parameters.
SampleFinding PricedFinding(double own, double rival, double parameters);

// The base's fit with the flame solved for anew, as a search finds it in records with the effect.
EffectFit EvaluatedBase(const std::vector<CutRecord>& records, const EffectFit& base);

// The root of twice the mean square about the mean.
double SampleAmplitude(const std::vector<double>& x);

// A hum on q, with its harmonics, `rel` of q's amplitude.
SampleFinding SeeHum(const PlanRecords& at, double mains_hz, double rel);

// A source s in the acoustics: p = G (q + s) and q = F p at a frequency beside the cycle's.
SampleFinding SeeTone(const PlanRecords& at, double hz, double rel);

// time_s: the correlation's, or the mean time between two changes of level.
SampleFinding SeeFluctuation(const PlanRecords& at, bool coloured, double time_s, double size);

// At this fraction of the amplitude.
SampleFinding SeeClipping(const PlanRecords& at, Channel channel, double fraction);

// p with so many levels.
SampleFinding SeeLevels(const PlanRecords& at, double levels);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_SAMPLE_CHANGES_H_
