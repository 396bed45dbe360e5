// The problem of a family: the experiments, the form of the model, the test that a member passes,
// and the domain of its parameters.
//
// The test sees a delay only modulo one period of the limit cycle, so the domain fixes the branch:
//   2 pi f tau = 3 pi / 2 + phase - loop phase error + 2 pi delay_periods,
// with both errors within half a turn. delay_periods = 0 is the shortest positive delay, as in the
// paper's (3).
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_PROBLEM_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_PROBLEM_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/family/problem/membership.h"
#include "estimation/parameters.h"

namespace howl {

struct Range {
  double lo = 0.0;
  double hi = std::numeric_limits<double>::infinity();
  bool Contains(double value) const { return lo <= value && value <= hi; }
};

// Natural units. By default every parameter is positive and otherwise free: the guard rails of a
// fit do not belong to the test, so only bounds that the user gave come here.
struct FamilyDomain {
  std::array<Range, kNumParameterKinds> ranges;
  int delay_periods = 0;

  Range& operator[](ParameterKind kind) { return ranges[static_cast<std::size_t>(kind)]; }
  const Range& operator[](ParameterKind kind) const {
    return ranges[static_cast<std::size_t>(kind)];
  }
};

struct FamilyProblem {
  std::vector<Experiment> experiments;
  ModelSpec model = DefaultModelSpec();
  MembershipTest test;
  FamilyDomain domain;

  // Some experiment has a transfer that the test looks at.
  bool HasTransfer() const {
    return std::isfinite(test.transfer_distance_max) &&
           std::any_of(experiments.begin(), experiments.end(),
                       [](const Experiment& e) { return e.transfer_ellipsoid.has_value(); });
  }
  bool IsShared(ParameterKind kind) const {
    return model.Uses(kind) && model[kind].scope == ParameterScope::kShared;
  }
  // The domain of one parameter of an experiment; a fixed one is held at its initial value.
  Range RangeOf(ParameterKind kind, std::size_t experiment) const;
  // A range that holds the domains of all experiments.
  Range RangeOf(ParameterKind kind) const;
};

// A parameter of the model, in natural units.
double ParameterOf(const LoopModel& model, ParameterKind kind);

// One member: a model for each experiment.
using Member = std::vector<LoopModel>;

// The member passes the test, lies in the domain, and its shared parameters are equal.
bool Holds(const FamilyProblem& problem, std::span<const LoopModel> models);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_PROBLEM_H_
