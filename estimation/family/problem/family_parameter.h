// The parameters of a member that bounds are asked for: those of an experiment's model, and the
// loop gain that they give with the experiment's flame slope. Natural units.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_FAMILY_PARAMETER_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_FAMILY_PARAMETER_H_

#include <array>
#include <cstddef>
#include <string_view>

#include "estimation/family/problem/problem.h"

namespace howl {

enum class FamilyParameter { kOmega, kXi, kN, kM, kTau, kLoopGain };

inline constexpr std::array kFamilyParameters = {
    FamilyParameter::kOmega, FamilyParameter::kXi,  FamilyParameter::kN,
    FamilyParameter::kM,     FamilyParameter::kTau, FamilyParameter::kLoopGain};

constexpr std::string_view FamilyParameterName(FamilyParameter parameter) {
  constexpr std::array<std::string_view, kFamilyParameters.size()> kNames = {
      "omega_hz", "xi", "N", "M", "tau_s", "loop_gain"};
  return kNames[static_cast<std::size_t>(parameter)];
}

// False for M with one mode, and for loop_gain without a flame slope.
bool HasParameter(const FamilyProblem& problem, std::size_t experiment, FamilyParameter parameter);

// The experiments' models share its value.
bool IsSharedParameter(const FamilyProblem& problem, FamilyParameter parameter);

// Natural units; loop_gain is NaN where the experiment has no flame slope.
double ParameterValue(const Experiment& experiment, const LoopModel& model,
                      FamilyParameter parameter);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_FAMILY_PARAMETER_H_
