#include "diagnosis/loop_budget/loop_search.h"

#include <glog/logging.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "diagnosis/loop_budget/loop_instrument_trial.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr std::size_t kMostItems = 24;

// The modes that were added stand behind the base's in the order of their steps.
std::size_t ModeOf(const std::vector<LoopStep>& steps, std::size_t which, const LoopForm& base) {
  auto mode = static_cast<std::size_t>(base.structure.modes);
  for (std::size_t i = 0; i < which; ++i) {
    if (steps[which].item.kind == LoopItemKind::kMode && steps[i].item.kind == LoopItemKind::kMode)
      ++mode;
  }
  return mode;
}

class Search {
 public:
  Search(LoopRecords records, const LoopForm& base, const LoopBudgetOptions& options)
      : records_(std::move(records)), base_(base), options_(options) {}

  LoopFound Run();

 private:
  LoopFit FitBase();
  LoopFit Driven(const LoopFit& fit, const std::string& key);
  void Forward(LoopFound* out);
  void Backward(const std::string& prefix, LoopStanding* out);
  void Exchange(LoopStanding* out);
  // Each of these by itself.
  void TakeAway(const std::vector<std::size_t>& which, MaximumTaken taken, const std::string& key,
                LoopStanding* out) const;
  static std::vector<std::size_t> Others(const LoopStanding& found,
                                         const std::vector<std::size_t>& than);
  static std::vector<std::size_t> Idle(const LoopStanding& found);
  LoopFit Without(const LoopFit& from, const std::vector<LoopStep>& steps, std::size_t which,
                  MaximumTaken taken, const std::string& key) const;
  LoopFit WithLines(const LoopFit& from, int PointStructure::*lines, const char* key) const;

  LoopRecords records_;
  const LoopForm& base_;
  const LoopBudgetOptions& options_;
};

// With the flames driven as `fit` has it from now on.
LoopFit Search::Driven(const LoopFit& fit, const std::string& key) {
  records_.DriveWithout(PressureNoiseOf(records_.Points(fit.model), fit.fit, options_.threads),
                        options_.threads);
  return FitLoopFrom(records_, fit.model, {ParametersOf(fit)}, MaximumTaken::kNext, key + "driven/",
                     options_);
}

LoopFit Search::FitBase() {
  const RecordsFitOptions fit_options = FitOptionsOf(options_, "base/");
  const std::vector<OperatingPoint> points = records_.Points(base_);
  return Driven({base_, FitRecords(points, base_.structure, fit_options), {}}, "base/");
}

LoopFit Search::Without(const LoopFit& from, const std::vector<LoopStep>& steps, std::size_t which,
                        MaximumTaken taken, const std::string& key) const {
  const LoopForm model = howl::Without(from.model, steps[which].item, base_);
  const LoopStarts starts = StartsWithout(records_, from, model, ModeOf(steps, which, base_));
  return FitLoopFrom(records_, model, starts.rows, taken,
                     key + "without/" + std::to_string(which) + "/", options_);
}

// Beside a loop that stands: whether such errors lead to another the search has tried.
LoopFit Search::WithLines(const LoopFit& from, int PointStructure::*lines, const char* key) const {
  if (from.model.structure.*lines > 0) return from;
  LoopForm model = from.model;
  model.structure.*lines = kCycleLines;
  return FitLoopFrom(records_, model, StartsWith(records_, from, model, options_.threads).rows,
                     MaximumTaken::kNext, key, options_);
}

void Search::Forward(LoopFound* out) {
  ForwardSearch forward(records_, base_, options_);
  while (out->steps.size() < kMostItems) {
    std::optional<LoopStep> next = forward.Next(out->best, out->steps);
    if (!next) break;
    next->after = Driven(next->after, "step/" + std::to_string(out->steps.size()) + "/");
    out->best = next->after;
    out->steps.push_back(std::move(*next));
  }
  for (const LoopStep& step : out->steps) {
    if (step.item.kind != LoopItemKind::kInstrument) continue;
    out->best = Refined(records_, std::move(out->best), step.item, "best/", options_);
  }
}

// What pays least goes first, as long as something does not pay what it had to when it came. A fit
// to the maximum next to the loop that stands loses more than one that looks for others: what is
// idle by the former is so, and what was idle a round ago is tried before the rest. Where nothing
// is, the latter decides.
void Search::Backward(const std::string& prefix, LoopStanding* out) {
  std::vector<std::size_t> first;
  for (std::size_t round = 0; !out->steps.empty(); ++round) {
    const std::string key = prefix + "back/" + std::to_string(round) + "/";
    out->without.assign(out->steps.size(), {});
    TakeAway(first, MaximumTaken::kNext, key + "next/", out);
    std::vector<std::size_t> idle = Idle(*out);
    if (idle.empty()) {
      TakeAway(Others(*out, first), MaximumTaken::kNext, key + "next/", out);
      idle = Idle(*out);
    }
    if (!idle.empty()) {
      const LoopFit& next = out->without[idle[0]];
      out->best = Driven(FitLoopFrom(records_, next.model, {ParametersOf(next)},
                                     MaximumTaken::kBest, key + "best/", options_),
                         key);
    } else {
      TakeAway(Others(*out, {}), MaximumTaken::kBest, key, out);
      idle = Idle(*out);
      if (idle.empty()) return;
      out->best = Driven(out->without[idle[0]], key);
    }
    const std::size_t least = idle[0];
    out->steps.erase(out->steps.begin() + static_cast<std::ptrdiff_t>(least));
    first.clear();
    for (const std::size_t i : idle) {
      if (i != least) first.push_back(i > least ? i - 1 : i);
    }
  }
  out->without.clear();
}

std::vector<std::size_t> Search::Others(const LoopStanding& found,
                                        const std::vector<std::size_t>& than) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    if (std::ranges::find(than, i) == than.end()) out.push_back(i);
  }
  return out;
}

void Search::TakeAway(const std::vector<std::size_t>& which, MaximumTaken taken,
                      const std::string& key, LoopStanding* out) const {
  RunUnits(which.size(), options_.threads, [&](std::size_t n) {
    const std::size_t i = which[n];
    LoopFit& without = out->without[i];
    without = without.log_density.empty()
                  ? Without(out->best, out->steps, i, taken, key)
                  : FitLoopFrom(records_, without.model, {ParametersOf(without)}, taken,
                                key + "without/" + std::to_string(i) + "/", options_);
  });
  for (const std::size_t i : which) {
    VLOG(1) << key << out->steps[i].item.id << " "
            << out->best.Density() - out->without[i].Density() << " nats lost";
  }
}

// The steps that are known not to pay what they had to, that which pays least first.
std::vector<std::size_t> Search::Idle(const LoopStanding& found) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const LoopFit& without = found.without[i];
    const double least = found.steps[i].least;
    if (without.log_density.empty() || without.Density() < found.best.Density() - least) continue;
    out.push_back(i);
  }
  std::ranges::stable_sort(out, std::ranges::greater(),
                           [&](std::size_t i) { return found.without[i].Density(); });
  return out;
}

void Search::Exchange(LoopStanding* out) {
  for (std::size_t round = 0; round < kMostItems; ++round) {
    const std::string key = "exchange/" + std::to_string(round) + "/";
    std::optional<LoopStanding> next = BestExchange(records_, base_, key, options_, out);
    if (!next) return;
    *out = std::move(*next);
    out->best = Driven(out->best, key);
    Backward(key, out);
  }
}

LoopFound Search::Run() {
  LoopFound out;
  out.base = FitBase();
  out.best = out.base;
  Forward(&out);
  Backward("", &out);
  Exchange(&out);
  out.with_acoustic_lines = WithLines(out.best, &PointStructure::acoustic_lines, "acoustic_lines/");
  out.with_flame_lines = WithLines(out.best, &PointStructure::flame_lines, "flame_lines/");
  out.records = std::move(records_);
  return out;
}

}  // namespace

LoopFound SearchLoopBudget(LoopRecords records, const LoopForm& base,
                           const LoopBudgetOptions& options) {
  return Search(std::move(records), base, options).Run();
}

}  // namespace howl
