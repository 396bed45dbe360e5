#include <array>
#include <cmath>

#include "estimation/family/answers/conflict/limits.h"
#include "estimation/family/answers/conflict/single_change.h"

namespace howl {

namespace {

double* BoundOf(FamilyProblem& problem, const ChangeTarget& target) {
  Range& range = problem.domain[target.parameter];
  return target.is_upper ? &range.hi : &range.lo;
}

double* DatumOf(FamilyProblem& problem, const ChangeTarget& target) {
  Experiment& experiment = problem.experiments[target.experiment];
  switch (target.datum) {
    case Datum::kFrequency:
      return &experiment.frequency_hz;
    case Datum::kPhase:
      return &experiment.phase_deg;
    case Datum::kGain:
      return &experiment.gain;
    case Datum::kFlameSlope:
      return experiment.flame_slope ? &*experiment.flame_slope : nullptr;
    case Datum::kReliable:
      break;
  }
  return nullptr;
}

}  // namespace

std::string_view DatumName(Datum datum) {
  constexpr std::array<std::string_view, 5> kDatumNames = {"frequency_hz", "phase_deg", "gain",
                                                           "flame_slope", "reliable"};
  return kDatumNames[static_cast<std::size_t>(datum)];
}

std::vector<ChangeTarget> ChangeTargets(const FamilyProblem& problem) {
  std::vector<ChangeTarget> targets;
  for (const Condition condition : kConditions) {
    if (Binds(problem, condition)) {
      targets.push_back({.kind = ChangeKind::kCondition, .condition = condition});
    }
  }
  for (const ParameterKind kind : kParameterKinds) {
    if (!problem.model.Uses(kind) || problem.model[kind].fixed) continue;
    for (const bool is_upper : {false, true}) {
      const Range range = problem.domain[kind];
      if (is_upper ? !std::isfinite(range.hi) : !(range.lo > 0.0)) continue;
      targets.push_back({.kind = ChangeKind::kBound, .parameter = kind, .is_upper = is_upper});
    }
  }
  const bool looks_at_slope = Binds(problem, Condition::kLoopGain);
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    const auto add = [&](Datum datum) {
      targets.push_back({.kind = ChangeKind::kDatum, .experiment = i, .datum = datum});
    };
    add(Datum::kFrequency);
    if (Binds(problem, Condition::kPhase)) add(Datum::kPhase);
    if (Binds(problem, Condition::kGain)) add(Datum::kGain);
    const Experiment& experiment = problem.experiments[i];
    if (!looks_at_slope || !experiment.reliable || !experiment.flame_slope) continue;
    if (*experiment.flame_slope != 0.0) add(Datum::kFlameSlope);
    add(Datum::kReliable);
  }
  return targets;
}

double ValueNow(const FamilyProblem& problem, const ChangeTarget& target) {
  if (target.IsSwitch()) return 1.0;
  FamilyProblem copy = problem;
  switch (target.kind) {
    case ChangeKind::kCondition:
      return *LimitOf(copy.test, target.condition);
    case ChangeKind::kBound:
      return *BoundOf(copy, target);
    case ChangeKind::kDatum:
      break;
  }
  return *DatumOf(copy, target);
}

FamilyProblem Changed(const FamilyProblem& problem, const ChangeTarget& target, double value) {
  FamilyProblem changed = problem;
  if (target.kind == ChangeKind::kCondition) {
    if (double* const limit = LimitOf(changed.test, target.condition)) {
      *limit = value;
    } else {
      changed.test.xi_increasing = value != 0.0;
    }
  } else if (target.kind == ChangeKind::kBound) {
    *BoundOf(changed, target) = value;
  } else if (target.datum == Datum::kReliable) {
    changed.experiments[target.experiment].reliable = value != 0.0;
  } else {
    *DatumOf(changed, target) = value;
  }
  return changed;
}

}  // namespace howl
