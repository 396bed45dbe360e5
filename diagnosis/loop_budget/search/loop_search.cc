#include "diagnosis/loop_budget/search/loop_search.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/forms/tone.h"
#include "diagnosis/loop_budget/search/given_items.h"
#include "diagnosis/loop_budget/search/loop_removal.h"
#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

class Search {
 public:
  Search(LoopRecords records, const LoopForm& base, const LoopBudgetOptions& options)
      : records_(std::move(records)), base_(base), options_(options) {
    base_.tone_hz = ToneIn(records_);
  }

  LoopFound Run();

 private:
  void FitBase(LoopFound* out);
  LoopFit Driven(const LoopFit& fit, const std::string& key);
  // Whether anything came.
  bool Forward(const std::string& prefix, LoopFound* out);
  void Backward(const std::string& prefix, LoopStanding* out);
  void Exchange(LoopStanding* out);
  LoopFit WithLines(const LoopFit& from, int PointStructure::*lines, const char* key) const;

  // A loop that stands, and what drives its flames.
  struct Stand {
    LoopStanding loop;
    LoopRecords records;
  };
  Stand Now(const LoopStanding& out) const { return {out, records_}; }
  // What came in, went, and left another maximum or other driven flames need not be better than
  // where it began.
  bool KeepBetterOf(const Stand& before, LoopStanding* out);

  LoopRecords records_;
  LoopForm base_;
  double base_density_ = 0.0;
  const LoopBudgetOptions& options_;
};

// With the flames driven as `fit` has it from now on.
LoopFit Search::Driven(const LoopFit& fit, const std::string& key) {
  records_.DriveWithout(fit.model,
                        PressureNoiseOf(records_.Points(fit.model), fit.fit, options_.threads),
                        PointsOf(records_, fit), options_.threads);
  return FitLoopFrom(records_, fit.model, {ParametersOf(fit)}, MaximumTaken::kNext, key + "driven/",
                     options_);
}

void Search::FitBase(LoopFound* out) {
  const RecordsFitOptions fit_options = FitOptionsOf(options_, "base/");
  const std::vector<OperatingPoint> points = records_.Points(base_);
  out->base = Driven({base_, FitRecords(points, base_.structure, fit_options), {}}, "base/");
  if (options_.given.empty()) return;
  out->without_given = out->base;
  GivenLoop given = WithGiven(records_, base_, *out->without_given, options_);
  out->base = Driven(given.fit, "given/");
  out->given = std::move(given.items);
  base_ = out->base.model;
}

// Beside a loop that stands: whether such errors lead to another the search has tried.
LoopFit Search::WithLines(const LoopFit& from, int PointStructure::*lines, const char* key) const {
  if (from.model.structure.*lines > 0) return from;
  LoopForm model = from.model;
  model.structure.*lines = kCycleLines;
  return FitLoopFrom(records_, model, StartsWith(records_, from, model, options_.threads).rows,
                     MaximumTaken::kNext, key, options_);
}

bool Search::Forward(const std::string& prefix, LoopFound* out) {
  ForwardSearch forward(records_, base_, base_density_, options_);
  const std::size_t before = out->steps.size();
  while (out->steps.size() < options_.most_items) {
    std::optional<LoopStep> next = forward.Next(out->best, out->steps, prefix);
    if (!next) break;
    next->after = Driven(next->after, prefix + "step/" + std::to_string(out->steps.size()) + "/");
    out->best = next->after;
    out->steps.push_back(std::move(*next));
  }
  if (prefix.empty()) out->alone = forward.alone();
  if (out->steps.size() == before) return false;
  for (const LoopItem& item : SharedItemsOf(out->best.model)) {
    out->best = Refined(records_, std::move(out->best), item, prefix + "best/", options_);
  }
  return true;
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
    TakeAway(records_, base_, first, MaximumTaken::kNext, key + "next/", options_, out);
    std::vector<std::size_t> idle = Idle(*out, base_density_);
    if (idle.empty()) {
      TakeAway(records_, base_, Others(*out, first), MaximumTaken::kNext, key + "next/", options_,
               out);
      idle = Idle(*out, base_density_);
    }
    if (!idle.empty()) {
      const LoopFit& next = out->without[idle[0]];
      out->best = Driven(FitLoopFrom(records_, next.model, {ParametersOf(next)},
                                     MaximumTaken::kBest, key + "best/", options_),
                         key);
    } else {
      TakeAway(records_, base_, Others(*out, {}), MaximumTaken::kBest, key, options_, out);
      idle = Idle(*out, base_density_);
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

void Search::Exchange(LoopStanding* out) {
  for (std::size_t round = 0; round < kMostItems; ++round) {
    const std::string key = "exchange/" + std::to_string(round) + "/";
    std::optional<LoopStanding> next = BestExchange(records_, base_, key, options_, out);
    if (!next) return;
    const Stand before = Now(*out);
    *out = std::move(*next);
    out->best = Driven(out->best, key);
    Backward(key, out);
    if (KeepBetterOf(before, out)) return;
  }
}

bool Search::KeepBetterOf(const Stand& before, LoopStanding* out) {
  if (!(before.loop.best.Density() > out->best.Density())) return false;
  *out = before.loop;
  records_ = before.records;
  return true;
}

LoopFound Search::Run() {
  LoopFound out;
  out.looked = options_.most_items > 0;
  FitBase(&out);
  base_density_ = out.base.Density();
  VLOG(1) << "base " << base_density_ << " nats";
  out.best = out.base;
  std::string prefix;
  for (int pass = 1;; ++pass) {
    const Stand before = Now(out);
    if (!Forward(prefix, &out)) break;
    const std::size_t came = out.steps.size();
    Backward(prefix, &out);
    // What has gone may have kept others out. Items come in and go by the same odds, and could go
    // to and fro: a pass that gains less than the least item must is the last.
    const double gained = out.best.Density() - before.loop.best.Density();
    KeepBetterOf(before, &out);
    if (out.steps.size() == came || gained < std::log(kOddsOfItem)) break;
    prefix = "again/" + std::to_string(pass) + "/";
  }
  Exchange(&out);
  VLOG(1) << "best " << out.best.Density() << " nats";
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
