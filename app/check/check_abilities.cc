#include "app/check/check_abilities.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "app/check/check_diagnose.h"
#include "app/family/family_run.h"
#include "app/input/config_fit.h"
#include "app/input/usable_records.h"
#include "app/text/text_table.h"
#include "estimation/fit/joint_problem.h"
#include "estimation/joint_records/loop_names.h"
#include "io/user_error.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

std::string Count(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

void Add(const std::string& word, std::string& list) { list += (list.empty() ? "" : ", ") + word; }

// `find` throws UserError where the command cannot.
Ability Ask(const std::string& command, const std::function<void(Ability&)>& find) {
  Ability ability{command, true, "", Json::object()};
  try {
    find(ability);
  } catch (const UserError& error) {
    ability = {command, false, error.mistake(), Json::object()};
  }
  return ability;
}

class Finder {
 public:
  Finder(const Config& config, const Options& options, const ProblemInput& input,
         bool points_are_known)
      : config_(config), options_(options), input_(input), points_are_known_(points_are_known) {}

  std::vector<Ability> Find() const {
    std::vector<Ability> all;
    all.push_back(Ask("analyse", [&](Ability& ability) { Analyse(ability); }));
    all.push_back(Ask("fit", [&](Ability& ability) { Fit(ability); }));
    all.push_back(Ask("family", [&](Ability& ability) { Family(ability); }));
    all.push_back(Ask("predict", [&](Ability& ability) { Predict(ability); }));
    all.push_back(Ask("diagnose", [&](Ability& ability) { Diagnose(ability); }));
    return all;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw UserError(config_.source.string(), 0, "", what);
  }

  void RequireExperiments() const {
    if (input_.experiments.empty()) howl::RequireExperiments(config_, options_, input_);
  }

  void Analyse(Ability& ability) const {
    if (input_.records.empty()) Fail("no experiment has a record");
    std::size_t cycles = 0;
    std::size_t with_q = 0;
    for (const auto& analysis : input_.analysis->analyses) {
      cycles += analysis.characteristics.state != CycleState::kNoLimitCycle ? 1 : 0;
      with_q += analysis.has_heat_release ? 1 : 0;
    }
    ability.text = Count(input_.records.size(), "record") + ", " + std::to_string(with_q) +
                   " with q, " + std::to_string(cycles) + " with a cycle";
    ability.details = {
        {"records", input_.records.size()}, {"with_heat_release", with_q}, {"with_cycle", cycles}};
  }

  void Fit(Ability& ability) const {
    if (config_.record_loop) return FitRecords(ability);
    RequireExperiments();
    const JointProblem problem = MakeJointProblem(config_, input_.experiments);
    ability.text = Count(input_.experiments.size(), "experiment");
    DescribeResiduals(problem, ability);
    DescribeParameters(problem, ability);
    DescribeDelay(problem, ability);
  }

  void FitRecords(Ability& ability) const {
    if (input_.records.size() < config_.experiments.size()) {
      Fail(
          "the config's model states a loop that is fitted to records, and not every experiment "
          "has one");
    }
    RequireUsable(config_, input_.records, *input_.analysis);
    const RecordLoopSpec& loop = *config_.record_loop;
    const std::string modes = loop.choose_modes ? "auto" : std::to_string(loop.modes);
    const std::string input = loop.choose_flame_input ? "auto" : FlameInputName(loop.flame_input);
    ability.text = Count(input_.records.size(), "record") + " of p and q; modes: " + modes +
                   ", flame_input: " + input;
    ability.details = {
        {"records", input_.records.size()}, {"modes", modes}, {"flame_input", input}};
  }

  void RequirePapersLoop() const {
    if (config_.record_loop)
      Fail("the config's model states a loop that howl fit, simulate, predict and diagnose take");
  }

  void DescribeResiduals(const JointProblem& problem, Ability& ability) const {
    std::string used;
    std::string off;
    std::string idle;
    ability.details["residuals"] = Json::object();
    for (const ResidualKind kind : kResidualKinds) {
      std::size_t blocks = 0;
      std::size_t numbers = 0;
      for (const ResidualBlock& block : problem.residuals()) {
        if (block.kind != kind) continue;
        ++blocks;
        numbers += static_cast<std::size_t>(block.cost->num_residuals());
      }
      const std::string name(ResidualName(kind));
      const bool enabled = config_.residuals[kind].enabled && config_.residuals[kind].weight > 0.0;
      ability.details["residuals"][name] = {
          {"enabled", enabled}, {"blocks", blocks}, {"residuals", numbers}};
      if (blocks > 0) {
        Add(name + " " + std::to_string(blocks) +
                (numbers > blocks ? " (" + std::to_string(numbers) + " numbers)" : ""),
            used);
      } else {
        Add(name, enabled ? idle : off);
      }
    }
    ability.text += "; residuals: " + used;
    if (!idle.empty()) ability.text += "; with nothing to act on: " + idle;
    if (!off.empty()) ability.text += "; switched off: " + off;
  }

  void DescribeParameters(const JointProblem& problem, Ability& ability) const {
    std::string shared;
    std::string fixed;
    std::set<ParameterKind> own;  // in the model's order
    std::size_t count = 0;
    Json names = Json::array();
    for (const ParameterBlock& block : problem.parameters()) {
      if (block.is_q_noise) continue;
      if (block.fixed) {
        Add(block.name, fixed);
        continue;
      }
      ++count;
      names.push_back(block.name);
      if (block.experiment == kShared) {
        Add(block.name, shared);
      } else {
        own.insert(block.kind);
      }
    }
    std::string list;
    for (const ParameterKind kind : own) Add(std::string(ParameterName(kind)), list);
    ability.details["free_parameters"] = std::move(names);
    std::string whose;
    if (!list.empty()) Add(list + " of each experiment", whose);
    if (!shared.empty()) Add(shared + " of all together", whose);
    ability.text += "; " + Count(count, "free parameter") + ": " + whose +
                    (fixed.empty() ? "" : "; fixed: " + fixed);
  }

  void DescribeDelay(const JointProblem& problem, Ability& ability) const {
    const bool is_shared = problem.model()[ParameterKind::kTau].scope == ParameterScope::kShared;
    const ResidualSpec& prior = config_.residuals[ResidualKind::kTauPrior];
    const bool is_held = std::ranges::any_of(problem.residuals(), [](const ResidualBlock& block) {
      return block.kind == ResidualKind::kTauPrior;
    });
    ability.details["tau_s"] = is_shared ? "shared" : is_held ? "prior" : "own";
    ability.text += "; tau_s: ";
    ability.text += is_shared ? "one for all experiments"
                    : is_held ? "one an experiment, held together by tau_prior (std " +
                                    Significant(100.0 * prior.std, 3) + " %)"
                              : "one an experiment, each for itself";
  }

  void Family(Ability& ability) const {
    RequirePapersLoop();
    RequireExperiments();
    const FamilyProblem problem = MakeFamilyProblem(config_, input_.experiments);
    CheckPredictions(config_, problem);
    const MembershipTest& test = problem.test;
    std::string conditions;
    Json names = Json::array();
    const auto condition = [&](Condition which, bool is_on) {
      if (!is_on) return;
      Add(std::string(ConditionName(which)), conditions);
      names.push_back(std::string(ConditionName(which)));
    };
    const auto any = [&](const std::function<bool(const Experiment&)>& holds) {
      return std::ranges::any_of(problem.experiments, holds);
    };
    const bool several = problem.experiments.size() > 1;
    const bool has_slope =
        any([](const Experiment& e) { return e.reliable && e.flame_slope.has_value(); });
    const bool two_modes = problem.model.modes == 2;
    const bool has_lines = two_modes && any([](const Experiment& e) { return !e.lines.empty(); });
    condition(Condition::kGain, std::isfinite(test.gain_tolerance));
    condition(Condition::kPhase, std::isfinite(test.phase_tolerance_deg));
    condition(Condition::kLoopPhase, std::isfinite(test.loop_phase_tolerance_deg));
    condition(Condition::kLoopGain, test.loop_gain_min > 0.0 && has_slope);
    condition(Condition::kSecondCrossing,
              std::isfinite(test.second_crossing_tolerance_deg) && has_lines);
    condition(Condition::kOmegaSpread, std::isfinite(test.omega_spread_max) && several);
    condition(Condition::kXiMax, std::isfinite(test.xi_max));
    condition(Condition::kXiIncreasing, test.xi_increasing && several);
    condition(Condition::kTransfer, problem.HasTransfer());
    condition(Condition::kSecondModeShare, std::isfinite(test.second_mode_share_max) && two_modes);
    condition(Condition::kSecondCrossingGain,
              test.second_crossing_gain_min > 0.0 && has_lines && has_slope);
    ability.text = Count(static_cast<std::size_t>(config_.family.members), "member") + " of " +
                   Count(problem.experiments.size(), "experiment") + "; test: " + conditions;
    ability.details = {{"members", config_.family.members}, {"test", std::move(names)}};
  }

  void Predict(Ability& ability) const {
    std::set<double> points;
    if (config_.record_loop) {
      FitRecords(ability);
      for (const NamedRecord& record : input_.records) points.insert(record.phi);
    } else {
      RequireExperiments();
      for (const Experiment& experiment : input_.experiments) points.insert(experiment.phi);
    }
    if (!points_are_known_) Fail(config_.operating_parameter + " is still to be filled in");
    if (points.size() < 2) {
      Fail(
          config_.record_loop
              ? "one operating point, expected two or more to tell another from"
              : "one operating point with a cycle, expected two or more: only it can be predicted");
    }
    ability.text = std::to_string(points.size()) + " operating points, " +
                   config_.operating_parameter + " " + Significant(*points.begin(), 4) + " to " +
                   Significant(*points.rbegin(), 4);
    ability.details = {
        {"points", points.size()}, {"from", *points.begin()}, {"to", *points.rbegin()}};
  }

  void Diagnose(Ability& ability) const {
    if (config_.record_loop) return FitRecords(ability);
    ability.text = WhatDiagnoseCanDo(config_, input_);
    ability.details = {{"records", input_.records.size()}};
  }

  const Config& config_;
  const Options& options_;
  const ProblemInput& input_;
  bool points_are_known_;
};

}  // namespace

std::vector<Ability> FindAbilities(const Config& config, const Options& options,
                                   const ProblemInput& input, bool points_are_known) {
  return Finder(config, options, input, points_are_known).Find();
}

}  // namespace howl
