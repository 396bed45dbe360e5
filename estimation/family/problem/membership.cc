#include "estimation/family/problem/membership.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "model/loop/loop.h"
#include "model/loop/second_mode.h"

namespace howl {

ExperimentErrors ComputeErrors(const Experiment& experiment, const LoopModel& model) {
  const LoopParameters<double> loop = model.Loop();
  const Complex<double> response = AcousticResponse(loop.acoustics, experiment.frequency_hz);
  const Complex<double> measured = UnitPhasor(experiment.phase_deg * kRadPerDeg);
  ExperimentErrors errors;
  errors.gain_error = Magnitude(response) / experiment.gain - 1.0;
  errors.phase_error_deg = Angle(response / measured) * kDegPerRad;
  errors.loop_phase_error_deg = LoopPhaseError(loop, experiment.frequency_hz) * kDegPerRad;
  if (experiment.flame_slope) {
    errors.loop_gain = LoopGain(loop, experiment.frequency_hz, *experiment.flame_slope);
    errors.largest_loop_gain = LoopGain(loop, experiment.frequency_hz, experiment.SteepestSlope());
  }
  for (const ObservedLine& line : experiment.lines) {
    const double error_deg = LoopPhaseError(loop, line.frequency_hz) * kDegPerRad;
    if (std::abs(error_deg) > std::abs(errors.second_crossing_error_deg)) {
      errors.second_crossing_error_deg = error_deg;
    }
  }
  errors.second_crossing_gain = SecondCrossingGain(experiment, loop);
  errors.second_mode_share = SecondModeShare(loop.acoustics, experiment.frequency_hz);
  if (experiment.transfer_ellipsoid) {
    errors.transfer_distance = TransferDistance(*experiment.transfer_ellipsoid, model);
  }
  return errors;
}

bool TestsLineGain(const Experiment& experiment, const MembershipTest& test) {
  return test.second_crossing_gain_min > 0.0 && experiment.reliable &&
         experiment.flame_slope.has_value() && !experiment.lines.empty();
}

double SecondCrossingGain(const Experiment& experiment, const LoopParameters<double>& loop) {
  if (!experiment.flame_slope || experiment.lines.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double least = std::numeric_limits<double>::infinity();
  for (const ObservedLine& line : experiment.lines) {
    least = std::min(least, LoopGain(loop, line.frequency_hz, experiment.SteepestSlope()));
  }
  return least;
}

bool KeepsSecondMode(const Experiment& experiment, const LoopModel& model,
                     const MembershipTest& test) {
  const LoopParameters<double> loop = model.Loop();
  if (!(SecondModeShare(loop.acoustics, experiment.frequency_hz) <= test.second_mode_share_max)) {
    return false;
  }
  return !TestsLineGain(experiment, test) ||
         SecondCrossingGain(experiment, loop) >= test.second_crossing_gain_min;
}

namespace {

void FalsifyOne(const Experiment& experiment, const LoopModel& model, const MembershipTest& test,
                ConditionSet& failed) {
  const ExperimentErrors errors = ComputeErrors(experiment, model);
  // Written as "not within", so that a NaN fails.
  if (!(std::abs(errors.gain_error) <= test.gain_tolerance)) failed.Insert(Condition::kGain);
  if (!(std::abs(errors.phase_error_deg) <= test.phase_tolerance_deg)) {
    failed.Insert(Condition::kPhase);
  }
  if (!(std::abs(errors.loop_phase_error_deg) <= test.loop_phase_tolerance_deg)) {
    failed.Insert(Condition::kLoopPhase);
  }
  if (experiment.reliable && experiment.flame_slope &&
      !(errors.largest_loop_gain >= test.loop_gain_min)) {
    failed.Insert(Condition::kLoopGain);
  }
  if (model.M > 0.0 &&
      !(std::abs(errors.second_crossing_error_deg) <= test.second_crossing_tolerance_deg)) {
    failed.Insert(Condition::kSecondCrossing);
  }
  if (!(model.xi <= test.xi_max)) failed.Insert(Condition::kXiMax);
  if (!(errors.transfer_distance <= test.transfer_distance_max)) {
    failed.Insert(Condition::kTransfer);
  }
  if (model.M > 0.0 && !(errors.second_mode_share <= test.second_mode_share_max)) {
    failed.Insert(Condition::kSecondModeShare);
  }
  if (model.M > 0.0 && TestsLineGain(experiment, test) &&
      !(errors.second_crossing_gain >= test.second_crossing_gain_min)) {
    failed.Insert(Condition::kSecondCrossingGain);
  }
}

// Of experiments in the order of phi; `at` gives the k-th one's place.
template <typename Place>
bool RisesAlong(std::span<const Experiment> experiments, std::span<const LoopModel> models,
                const Place& at) {
  // The largest xi at a smaller phi, and at this one.
  double below = -std::numeric_limits<double>::infinity();
  double here = below;
  for (std::size_t k = 0; k < experiments.size(); ++k) {
    if (k > 0 && experiments[at(k)].phi != experiments[at(k - 1)].phi) {
      below = std::max(below, here);
    }
    const double xi = models[at(k)].xi;
    if (xi < below) return false;
    here = std::max(here, xi);
  }
  return true;
}

// xi does not fall as phi grows. Tables mostly come in the order of phi, or in the other one.
bool RisesWithPhi(std::span<const Experiment> experiments, std::span<const LoopModel> models) {
  const std::size_t n = experiments.size();
  const auto phi = [](const Experiment& experiment) { return experiment.phi; };
  if (std::ranges::is_sorted(experiments, {}, phi)) {
    return RisesAlong(experiments, models, [](std::size_t k) { return k; });
  }
  if (std::ranges::is_sorted(experiments, std::ranges::greater{}, phi)) {
    return RisesAlong(experiments, models, [n](std::size_t k) { return n - 1 - k; });
  }
  thread_local std::vector<std::size_t> order;
  order.resize(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return experiments[i].phi; });
  return RisesAlong(experiments, models, [](std::size_t k) { return order[k]; });
}

}  // namespace

ConditionSet Falsify(std::span<const Experiment> experiments, std::span<const LoopModel> models,
                     const MembershipTest& test) {
  CHECK_EQ(experiments.size(), models.size());
  CHECK(!experiments.empty());
  ConditionSet failed;
  double omega_min = std::numeric_limits<double>::infinity();
  double omega_max = 0.0;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    FalsifyOne(experiments[i], models[i], test, failed);
    omega_min = std::min(omega_min, models[i].omega_hz);
    omega_max = std::max(omega_max, models[i].omega_hz);
  }
  if (test.xi_increasing && !RisesWithPhi(experiments, models)) {
    failed.Insert(Condition::kXiIncreasing);
  }
  if (!(omega_max / omega_min - 1.0 <= test.omega_spread_max)) {
    failed.Insert(Condition::kOmegaSpread);
  }
  return failed;
}

}  // namespace howl
