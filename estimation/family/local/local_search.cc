#include "estimation/family/local/local_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/local/local_barrier.h"
#include "estimation/family/local/local_conditions.h"
#include "estimation/family/local/local_coordinates.h"
#include "estimation/family/local/local_state.h"
#include "estimation/family/local/transfer_centre.h"
#include "model/numerics/units.h"

namespace howl {

namespace {

struct Centre {
  double omega_hz, xi;
};

// Models at the measured phase and gain.
std::optional<Member> FromCentres(const LocalCoordinates& c, const std::vector<Centre>& centres,
                                  double ln_second) {
  if (c.shared_second) {
    const Range& box = c.scales[0].box[kLocalSecond];
    ln_second = std::clamp(ln_second, box.lo, box.hi);
  }
  Member member;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double xi = centres[i].xi;
    LocalState state;
    state.local.assign(i + 1, {});
    state.omega_hz.assign(i + 1, centres[i].omega_hz);
    state.local[i] = {std::log(xi), 0.0, 0.0, 0.0, ln_second};
    const double top = OmegaFromDetuning(c.problem.experiments[i].frequency_hz,
                                         xi * std::tan(-c.scales[i].phase_0));
    if (c.two_modes && !c.shared_second) {
      state.local[i][kLocalSecond] =
          std::log(std::clamp(centres[i].omega_hz, top / c.ratio * 1.001, top * 0.999));
    }
    LoopModel model;
    if (!ModelOf(c, i, state, model)) return std::nullopt;
    member.push_back(model);
  }
  return member;
}

}  // namespace

struct LocalSearch::Impl {
  LocalCoordinates coordinates;
};

LocalSearch::LocalSearch(const FamilyProblem& problem)
    : impl_(std::make_unique<Impl>(Impl{MakeLocalCoordinates(problem)})) {}
LocalSearch::~LocalSearch() = default;

bool LocalSearch::IsSupported() const { return impl_->coordinates.supported; }

std::optional<LocalSolution> LocalSearch::ReduceViolation(const Member& start,
                                                          double enough) const {
  const LocalCoordinates& c = impl_->coordinates;
  LocalState state;
  if (!c.supported || !StateOf(c, start, state)) return std::nullopt;
  BarrierTask task;
  for (const Condition condition : kConditions) task.soft.conditions.Insert(condition);
  task.soft.domain = true;
  task.has_s = true;
  task.enough = enough;
  const double violation = LargestViolation(c, state, task.soft);
  if (!std::isfinite(violation)) return std::nullopt;
  state.s = violation + 0.1;
  LocalSolution solution;
  if (violation > enough) solution.converged = FollowCentralPath(c, task, state);
  if (!MemberOf(c, state, solution.member)) return std::nullopt;
  solution.violation = LargestViolation(c, state, task.soft);
  solution.converged |= solution.violation <= enough;
  return solution;
}

std::optional<LocalSolution> LocalSearch::Minimise(const Member& start, const ConditionSet& soft,
                                                   const MemberQuantity* quantity,
                                                   double at) const {
  const LocalCoordinates& c = impl_->coordinates;
  LocalState state;
  if (!c.supported || !StateOf(c, start, state)) return std::nullopt;
  BarrierTask task;
  task.soft.conditions = soft;
  task.has_s = true;
  if (quantity != nullptr) {
    task.quantity = quantity;
    task.pinned = true;
    task.at = at;
    task.scale = std::max(std::abs(at), 1e-300);
  }
  const double violation = LargestViolation(c, state, task.soft);
  if (!std::isfinite(violation)) return std::nullopt;
  state.s = violation + 0.1;
  LocalSolution solution;
  solution.converged = FollowCentralPath(c, task, state);
  if (!MemberOf(c, state, solution.member)) return std::nullopt;
  solution.violation = LargestViolation(c, state, task.soft);
  if (quantity != nullptr &&
      !(std::abs(quantity->value(solution.member) - at) <= 1e-7 * std::max(std::abs(at), 1e-300))) {
    return std::nullopt;
  }
  return solution;
}

std::optional<Member> LocalSearch::Farthest(const Member& start, const MemberQuantity& quantity,
                                            double sign, double scale) const {
  const std::optional<LocalSolution> inside = ReduceViolation(start);
  if (!inside || !(inside->violation < 1.0)) return std::nullopt;
  const LocalCoordinates& c = impl_->coordinates;
  LocalState state;
  if (!StateOf(c, inside->member, state)) return std::nullopt;
  BarrierTask task;
  task.quantity = &quantity;
  task.sign = sign;
  task.scale = scale > 0.0 ? scale : std::abs(quantity.value(inside->member));
  if (!(task.scale > 0.0) || !FollowCentralPath(c, task, state)) return std::nullopt;
  Member member;
  if (!MemberOf(c, state, member) || !Holds(c.problem, member)) return std::nullopt;
  return member;
}

std::optional<Member> LocalSearch::Nominal(double xi, double relative) const {
  const LocalCoordinates& c = impl_->coordinates;
  const FamilyProblem& problem = c.problem;
  if (!c.supported) return std::nullopt;
  const Range range = problem.RangeOf(ParameterKind::kXi);
  xi = std::clamp(xi, std::max(range.lo, kLocalLeastXi) * (1 + 1e-6),
                  std::min({range.hi, problem.test.xi_max, kLocalLargestXi}) * (1 - 1e-6));
  double ln_second = std::log(relative);
  if (c.shared_second && !c.relative) {
    for (const Experiment& experiment : problem.experiments) {  // about N = 2 xi w |G|
      ln_second += std::log(2.0 * xi * kRadPerSPerHz * experiment.frequency_hz * experiment.gain) /
                   static_cast<double>(problem.experiments.size());
    }
  }
  std::vector<Centre> centres;
  for (const Experiment& experiment : problem.experiments) {
    centres.push_back({0.99 * experiment.frequency_hz, xi});
  }
  return FromCentres(c, centres, ln_second);
}

std::optional<Member> LocalSearch::FromTransfer() const {
  const LocalCoordinates& c = impl_->coordinates;
  const FamilyProblem& problem = c.problem;
  if (!c.supported) return std::nullopt;
  const Range xi = problem.RangeOf(ParameterKind::kXi);
  std::vector<Centre> centres;
  double second = 0.0;
  for (const TransferCentre& centre :
       TransferCentres(problem.experiments, c.shared_second, c.relative)) {
    centres.push_back(
        {centre.omega_hz, std::clamp(centre.xi, std::max(xi.lo, kLocalLeastXi) * (1 + 1e-6),
                                     std::min(xi.hi, kLocalLargestXi) * (1 - 1e-6))});
    second = centre.second;
  }
  if (centres.empty()) return std::nullopt;
  return FromCentres(c, centres, std::log(second));
}

}  // namespace howl
