#include "estimation/family/answers/conflict/limits.h"

#include <algorithm>
#include <cmath>

#include "model/numerics/constants.h"

namespace howl {

namespace {

double LimitPassedByOne(const Experiment& experiment, const LoopModel& model, Condition condition) {
  const ExperimentErrors errors = ComputeErrors(experiment, model);
  switch (condition) {
    case Condition::kGain:
      return std::abs(errors.gain_error);
    case Condition::kPhase:
      return std::abs(errors.phase_error_deg);
    case Condition::kLoopPhase:
      return std::abs(errors.loop_phase_error_deg);
    case Condition::kLoopGain:
      if (!(experiment.reliable && experiment.flame_slope)) return kInfinity;
      return errors.largest_loop_gain;
    case Condition::kSecondCrossing:
      return std::abs(errors.second_crossing_error_deg);
    case Condition::kXiMax:
      return model.xi;
    case Condition::kTransfer:
      return errors.transfer_distance;
    case Condition::kSecondModeShare:
      return errors.second_mode_share;
    case Condition::kSecondCrossingGain:
      if (!(experiment.reliable && std::isfinite(errors.second_crossing_gain))) return kInfinity;
      return errors.second_crossing_gain;
    case Condition::kOmegaSpread:
    case Condition::kXiIncreasing:
      break;
  }
  return 0.0;
}

}  // namespace

double* LimitOf(MembershipTest& test, Condition condition) {
  switch (condition) {
    case Condition::kGain:
      return &test.gain_tolerance;
    case Condition::kPhase:
      return &test.phase_tolerance_deg;
    case Condition::kLoopPhase:
      return &test.loop_phase_tolerance_deg;
    case Condition::kLoopGain:
      return &test.loop_gain_min;
    case Condition::kSecondCrossing:
      return &test.second_crossing_tolerance_deg;
    case Condition::kOmegaSpread:
      return &test.omega_spread_max;
    case Condition::kXiMax:
      return &test.xi_max;
    case Condition::kXiIncreasing:
      return nullptr;
    case Condition::kTransfer:
      return &test.transfer_distance_max;
    case Condition::kSecondModeShare:
      return &test.second_mode_share_max;
    case Condition::kSecondCrossingGain:
      return &test.second_crossing_gain_min;
  }
  return nullptr;
}

bool IsLeast(Condition condition) {
  return condition == Condition::kLoopGain || condition == Condition::kSecondCrossingGain;
}

void SwitchOff(MembershipTest& test, Condition condition) {
  if (double* const limit = LimitOf(test, condition)) {
    *limit = IsLeast(condition) ? 0.0 : kInfinity;
  } else {
    test.xi_increasing = false;
  }
}

bool Binds(const FamilyProblem& problem, Condition condition) {
  MembershipTest test = problem.test;
  if (const double* const limit = LimitOf(test, condition)) {
    if (IsLeast(condition) ? !(*limit > 0.0) : !std::isfinite(*limit)) return false;
  } else if (!test.xi_increasing) {
    return false;
  }
  const auto any = [&](const auto& looks_at) {
    return std::any_of(problem.experiments.begin(), problem.experiments.end(), looks_at);
  };
  switch (condition) {
    case Condition::kLoopGain:
      return any([](const Experiment& e) { return e.reliable && e.flame_slope; });
    case Condition::kSecondCrossing:
      return problem.model.modes == 2 && any([](const Experiment& e) { return !e.lines.empty(); });
    case Condition::kOmegaSpread:
    case Condition::kXiIncreasing:
      return problem.experiments.size() > 1;
    case Condition::kTransfer:
      return problem.HasTransfer();
    case Condition::kSecondModeShare:
      return problem.model.modes == 2;
    case Condition::kSecondCrossingGain:
      return problem.model.modes == 2 &&
             any([&](const Experiment& e) { return TestsLineGain(e, problem.test); });
    case Condition::kGain:
    case Condition::kPhase:
    case Condition::kLoopPhase:
    case Condition::kXiMax:
      break;
  }
  return true;
}

MembershipTest KeepConditions(const MembershipTest& test, const ConditionSet& kept) {
  MembershipTest result = test;
  for (const Condition condition : kConditions) {
    if (!kept.Contains(condition)) SwitchOff(result, condition);
  }
  return result;
}

double LimitPassed(const FamilyProblem& problem, std::span<const LoopModel> models,
                   Condition condition) {
  if (condition == Condition::kOmegaSpread) {
    const auto [lo, hi] = std::minmax_element(
        models.begin(), models.end(),
        [](const LoopModel& a, const LoopModel& b) { return a.omega_hz < b.omega_hz; });
    return hi->omega_hz / lo->omega_hz - 1.0;
  }
  double passed = IsLeast(condition) ? kInfinity : 0.0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const double one = LimitPassedByOne(problem.experiments[i], models[i], condition);
    passed = IsLeast(condition) ? std::min(passed, one) : std::max(passed, one);
  }
  return passed;
}

}  // namespace howl
