#include "app/family/family_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "app/text/conflict_text.h"
#include "app/text/text_table.h"
#include "estimation/analysis/spectra/half_width.h"

namespace howl {
namespace {

std::string RangeText(const Range& range, double factor, int digits) {
  return Significant(factor * range.lo, digits) + " .. " + Significant(factor * range.hi, digits);
}

void PrintBounds(const FamilyProblem& problem, const Enclosure& enclosure) {
  std::vector<std::string> header = {"experiment", "omega Hz", "xi", "N"};
  std::vector<FamilyParameter> shown = {FamilyParameter::kOmega, FamilyParameter::kXi,
                                        FamilyParameter::kN};
  if (problem.model.modes == 2) {
    header.emplace_back("M");
    shown.push_back(FamilyParameter::kM);
  }
  header.emplace_back("tau ms");
  shown.push_back(FamilyParameter::kTau);
  header.emplace_back("loop gain");
  shown.push_back(FamilyParameter::kLoopGain);
  TextTable table(std::move(header));
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    std::vector<std::string> cells = {problem.experiments[i].name};
    for (const FamilyParameter parameter : shown) {
      if (!enclosure.IsBounded(i, parameter)) {
        cells.emplace_back("-");
        continue;
      }
      const double factor = parameter == FamilyParameter::kTau ? 1e3 : 1.0;
      cells.push_back(RangeText(enclosure.Bound(i, parameter).outer, factor, 4));
    }
    table.AddRow(std::move(cells));
  }
  std::printf("no member lies outside (guaranteed):\n%s", table.Text().c_str());
}

// The parameter whose guaranteed bound exceeds the members found by most, relative to their range.
void PrintTightness(const FamilyProblem& problem, const Enclosure& enclosure) {
  double widest = -1.0;
  double tightest = std::numeric_limits<double>::infinity();
  std::string widest_name;
  std::string tightest_name;
  std::size_t open = 0;
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!enclosure.IsBounded(i, parameter)) continue;
      const EnclosedBound bound = enclosure.Bound(i, parameter);
      const std::string name =
          problem.experiments[i].name + "." + std::string(FamilyParameterName(parameter));
      if (!bound.closed) ++open;
      if (bound.Excess() > widest) {
        widest = bound.Excess();
        widest_name = name;
      }
      if (bound.Excess() < tightest) {
        tightest = bound.Excess();
        tightest_name = name;
      }
    }
  }
  std::printf("members reach the bounds to within %s %% (%s) .. %s %% (%s) of their range\n",
              Significant(100.0 * tightest, 2).c_str(), tightest_name.c_str(),
              Significant(100.0 * widest, 2).c_str(), widest_name.c_str());
  if (open > 0) std::printf("%zu bounds are not as tight as asked: the budget ran out\n", open);
}

void PrintDiagnostics(const FamilyRun& run) {
  const SampleDiagnostics& what = run.diagnostics;
  std::printf("%zu members listed that the data cannot reject\n", run.members.size());
  if (what.effective_sample_size > 0.0) {
    std::printf(
        "%zu more drawn uniformly: effective sample size %s, split R-hat %s, largest hole %s\n",
        run.sample.size(), Significant(what.effective_sample_size, 3).c_str(),
        Significant(what.split_r_hat, 4).c_str(), Significant(what.largest_hole, 2).c_str());
  }
  if (what.split_r_hat > 1.05) {
    std::printf("  their chains have not mixed: they are in the family, but not uniform\n");
  }
}

void PrintTransfer(const FamilyRun& run) {
  const TransferVolume& volume = run.transfer->volume;
  const double limit = run.problem.test.transfer_distance_max;
  if (volume.least_distance && *volume.least_distance > limit) {
    std::printf(
        "no model that passes the other conditions comes nearer to the records' q-to-p transfers\n"
        "than %s standard deviations; transfer_distance_max allows %s: the modes, or what is\n"
        "shared, do not carry what the records show (transfer_distance_max: null leaves them "
        "out)\n",
        Significant(*volume.least_distance, 3).c_str(), Significant(limit, 3).c_str());
    return;
  }
  if (run.members.empty()) return;
  std::string text = "the broadband q-to-p transfer of " + std::to_string(volume.experiments) +
                     " experiments is part of the test";
  if (volume.ln_ratio) {
    text += ": it leaves exp(" + Fixed(*volume.ln_ratio, 1) + " ± " +
            Fixed(HalfWidth95(volume.ln_std), 1) + ") of the volume (" + kPlusMinusLegend + ")";
  } else if (!volume.finite_without) {
    text += "; without it the volume is not finite (give xi a least value and M a largest)";
  }
  std::printf("%s\n", Wrapped(text, 2).c_str());
  if (run.transfer->without.empty()) return;
  TextTable table({"experiment", "omega Hz", "xi", "N"});
  for (std::size_t i = 0; i < run.problem.experiments.size(); ++i) {
    std::vector<std::string> cells = {run.problem.experiments[i].name};
    for (const FamilyParameter parameter :
         {FamilyParameter::kOmega, FamilyParameter::kXi, FamilyParameter::kN}) {
      Range seen{std::numeric_limits<double>::infinity(), 0.0};
      for (const Member& member : run.transfer->without) {
        const double value = ParameterValue(run.problem.experiments[i], member[i], parameter);
        seen = {std::min(seen.lo, value), std::max(seen.hi, value)};
      }
      cells.push_back(RangeText(seen, 1.0, 4));
    }
    table.AddRow(std::move(cells));
  }
  std::printf("without it members were seen at:\n%s", table.Text().c_str());
}

void PrintProfile(const ProfileReport& report) {
  const Profile& profile = report.profile;
  const ProfilePoint* best = &profile.points.front();
  for (const ProfilePoint& point : profile.points) {
    if (point.cost < best->cost) best = &point;
  }
  const auto end = [](ProfileEnd reason) {
    switch (reason) {
      case ProfileEnd::kEdge:
        return "edge of the tolerances";
      case ProfileEnd::kBound:
        return "edge of the other conditions";
      case ProfileEnd::kFailed:
        return "the search failed beyond";
      case ProfileEnd::kPoints:
        break;
    }
    return "out of points";
  };
  std::printf("profile of %s: %s (%s) .. %s (%s), best at %s\n", report.quantity.c_str(),
              Significant(profile.lo).c_str(), end(profile.lo_end), Significant(profile.hi).c_str(),
              end(profile.hi_end), Significant(best->value).c_str());
  std::printf("  %zu points, cost (largest share of a tolerance) %s .. %s; %s\n",
              profile.points.size(), Fixed(best->cost, 3).c_str(),
              Fixed(std::max(profile.points.front().cost, profile.points.back().cost), 3).c_str(),
              profile.IsSound() ? "each found again from its other neighbour"
                                : (std::to_string(profile.flagged) +
                                   " flagged: found differently from the other side")
                                      .c_str());
}

void PrintFurther(const FurtherTest& further) {
  const SurvivalCounts& counts = further.counts;
  std::printf("%s: %zu members survive, %zu are rejected, %zu are not tested (no phi in between)\n",
              further.config.c_str(), counts.survive, counts.rejected, counts.untested);
  for (const Condition condition : kConditions) {
    const std::size_t count = counts.rejected_by[static_cast<std::size_t>(condition)];
    if (count > 0) {
      std::printf("  %zu rejected by %s\n", count, std::string(ConditionName(condition)).c_str());
    }
  }
}

void PrintAdvice(const std::vector<Advice>& advice) {
  constexpr std::size_t kShown = 10;
  TextTable table({"measurement", "std", "family left", "predicted"});
  for (std::size_t k = 0; k < std::min(kShown, advice.size()); ++k) {
    const Advice& one = advice[k];
    table.AddRow({one.name, Significant(one.std, 2),
                  Significant(100.0 * one.expected_remaining, 2) + " %",
                  one.predicted.lo <= one.predicted.hi ? RangeText(one.predicted, 1.0, 4) : "-"});
  }
  std::printf("measurements that would remove most of the family:\n%s", table.Text().c_str());
}

// One row an experiment, one column a quantity.
void PrintSampledPredictions(const FamilyRun& run) {
  std::vector<std::string> names;
  for (const ExperimentPrediction& each : run.predictions) {
    if (each.prediction.kind != IntervalKind::kSampled) continue;
    if (std::ranges::find(names, each.prediction.name) == names.end()) {
      names.push_back(each.prediction.name);
    }
  }
  if (names.empty()) return;
  std::vector<std::string> header = {"experiment"};
  header.insert(header.end(), names.begin(), names.end());
  TextTable table(std::move(header));
  for (const Experiment& experiment : run.problem.experiments) {
    std::vector<std::string> cells(names.size() + 1, "-");
    cells[0] = experiment.name;
    for (const ExperimentPrediction& each : run.predictions) {
      const auto column = std::ranges::find(names, each.prediction.name);
      const Range& interval = each.prediction.interval;
      if (each.experiment != experiment.name || column == names.end()) continue;
      if (!(interval.lo <= interval.hi)) continue;
      cells[static_cast<std::size_t>(column - names.begin()) + 1] = RangeText(interval, 1.0, 4);
    }
    table.AddRow(std::move(cells));
  }
  std::printf("what sampled members predict (growth rate of the loop at rest, 1/s):\n%s",
              table.Text().c_str());
}

void PrintPredictions(const FamilyRun& run) {
  for (const ExperimentPrediction& each : run.predictions) {
    if (each.prediction.kind != IntervalKind::kGuaranteed) continue;
    if (!(each.prediction.interval.lo <= each.prediction.interval.hi)) continue;
    const std::string owner = each.experiment.empty() ? "" : " of " + each.experiment;
    std::printf("%s%s: %s (guaranteed)\n", each.prediction.name.c_str(), owner.c_str(),
                RangeText(each.prediction.interval, 1.0, 5).c_str());
  }
  PrintSampledPredictions(run);
}

}  // namespace

void PrintFamily(const FamilyRun& run) {
  if (run.members.empty()) {
    PrintConflict(run.problem, run.conflict, run.recorded);
    if (run.transfer) PrintTransfer(run);
    return;
  }
  PrintDiagnostics(run);
  PrintBounds(run.problem, *run.enclosure);
  PrintTightness(run.problem, *run.enclosure);
  PrintPredictions(run);
  if (run.transfer) PrintTransfer(run);
  if (run.profile) PrintProfile(*run.profile);
  if (run.falsified) PrintFurther(*run.falsified);
  if (run.advice) PrintAdvice(*run.advice);
}

}  // namespace howl
