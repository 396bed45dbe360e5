#include "estimation/family/answers/family_profile.h"

#include <algorithm>
#include <cmath>

#include "model/loop/loop.h"

namespace howl {

namespace {

constexpr std::size_t kStarts = 6;
constexpr double kInside = 1e-6;  // of the range: the walk ends this far inside the last member

std::vector<double> Flat(const Member& member) {
  std::vector<double> flat;
  for (const LoopModel& m : member) {
    flat.insert(flat.end(), {m.omega_hz, m.xi, m.N, m.M, m.tau_s});
  }
  return flat;
}

Member FromFlat(const std::vector<double>& flat, double ratio) {
  Member member;
  for (std::size_t k = 0; k + kProfileParameters <= flat.size(); k += kProfileParameters) {
    member.push_back({flat[k], flat[k + 1], flat[k + 2], flat[k + 3], flat[k + 4], ratio});
  }
  return member;
}

std::vector<Member> Some(const std::vector<Member>& members) {
  std::vector<Member> some;
  for (std::size_t k = 0; k < std::min(kStarts, members.size()); ++k) {
    some.push_back(members[k * members.size() / std::min(kStarts, members.size())]);
  }
  return some;
}

}  // namespace

MemberQuantity QuantityOf(const Expression& expression, const FamilyProblem& problem,
                          std::size_t index) {
  MemberQuantity quantity;
  quantity.value = [expression, experiments = problem.experiments,
                    index](std::span<const LoopModel> models) {
    return expression.Evaluate(experiments, models, index);
  };
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    if (expression.DependsOn(i, index)) quantity.experiments.push_back(i);
  }
  return quantity;
}

std::optional<MemberQuantity> ParseQuantity(const std::string& text, const FamilyProblem& problem,
                                            ExpressionError& error) {
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    const Experiment& experiment = problem.experiments[i];
    if (text != experiment.name + ".loop_gain") continue;
    if (!experiment.flame_slope) {
      error = {0, experiment.name + " has no flame slope, expected one for its loop gain"};
      return std::nullopt;
    }
    return MemberQuantity{[experiment, i](std::span<const LoopModel> models) {
                            return LoopGain(models[i].Loop(), experiment.frequency_hz,
                                            *experiment.flame_slope);
                          },
                          {i}};
  }
  const auto expression = Expression::Parse(text, problem.experiments, error);
  if (!expression) return std::nullopt;
  if (expression->IsPerExperiment()) {
    error = {0, "differs from experiment to experiment, expected one named, as in " +
                    problem.experiments[0].name + ".xi"};
    return std::nullopt;
  }
  MemberQuantity quantity = QuantityOf(*expression, problem, 0);
  if (quantity.experiments.empty()) {
    error = {0, "does not depend on any parameter"};
    return std::nullopt;
  }
  return quantity;
}

std::optional<Profile> ProfileFamily(const FamilyProblem& problem, const MemberQuantity& quantity,
                                     const std::vector<Member>& members, std::size_t max_points) {
  const LocalSearch search(problem);
  if (!search.IsSupported() || members.empty()) return std::nullopt;
  ConditionSet soft;
  for (const Condition condition : {Condition::kGain, Condition::kPhase, Condition::kLoopPhase,
                                    Condition::kSecondCrossing, Condition::kTransfer}) {
    soft.Insert(condition);
  }
  // The best fit, and how far members reach.
  std::optional<LocalSolution> best;
  Range reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto widen = [&](const Member& member) {
    const double value = quantity.value(member);
    reach = {std::min(reach.lo, value), std::max(reach.hi, value)};
  };
  for (const Member& member : members) widen(member);
  const double scale = reach.hi - reach.lo;
  for (const Member& start : Some(members)) {
    for (const double sign : {-1.0, 1.0}) {
      if (const auto far = search.Farthest(start, quantity, sign, scale)) widen(*far);
    }
    const std::optional<LocalSolution> inside = search.ReduceViolation(start);
    if (!inside || !Holds(problem, inside->member)) continue;
    std::optional<LocalSolution> fit = search.Minimise(inside->member, soft);
    if (fit && (!best || fit->violation < best->violation)) best = std::move(fit);
  }
  if (!best) return std::nullopt;
  const ConstrainedMinimum minimise = [&](double value, const std::vector<double>& start) {
    const std::optional<LocalSolution> fit =
        search.Minimise(FromFlat(start, problem.model.harmonic_ratio), soft, &quantity, value);
    if (!fit) return ConstrainedFit{std::nan(""), {}, false};
    return ConstrainedFit{fit->violation, Flat(fit->member), fit->converged};
  };
  const double inside = kInside * (reach.hi - reach.lo);
  ProfileOptions options;
  options.bounds = {reach.lo + inside, reach.hi - inside};
  options.cost_max = 1.0;
  options.first_step = 0.02 * (reach.hi - reach.lo);
  options.max_points = max_points;
  const double at = quantity.value(best->member);
  return ComputeProfile(minimise, at, {best->violation, Flat(best->member), best->converged},
                        options);
}

}  // namespace howl
