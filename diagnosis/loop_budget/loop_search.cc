#include "diagnosis/loop_budget/loop_search.h"

#include <glog/logging.h>

#include <optional>
#include <utility>

#include "diagnosis/loop_budget/loop_instrument_trial.h"

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
  Search(const LoopRecords& records, const LoopForm& base, const LoopBudgetOptions& options)
      : records_(records), base_(base), options_(options) {}

  LoopFound Run() const;

 private:
  LoopFit FitBase() const;
  void Forward(LoopFound* out) const;
  void Backward(LoopFound* out) const;
  LoopFit Without(const LoopFit& from, const std::vector<LoopStep>& steps, std::size_t which,
                  const std::string& key) const;
  LoopFit WithLines(const LoopFit& from, int PointStructure::*lines, const char* key) const;

  const LoopRecords& records_;
  const LoopForm& base_;
  const LoopBudgetOptions& options_;
};

LoopFit Search::FitBase() const {
  const RecordsFitOptions fit_options = FitOptionsOf(options_, "base/");
  const std::vector<OperatingPoint> points = records_.Points(base_);
  return Scored(records_, base_, FitRecords(points, base_.structure, fit_options), fit_options);
}

LoopFit Search::Without(const LoopFit& from, const std::vector<LoopStep>& steps, std::size_t which,
                        const std::string& key) const {
  const LoopForm model = howl::Without(from.model, steps[which].item, base_);
  const LoopStarts starts = StartsWithout(records_, from, model, ModeOf(steps, which, base_));
  return FitLoopFrom(records_, model, starts.rows, MaximumTaken::kBest,
                     key + "without/" + std::to_string(which) + "/", options_);
}

LoopFit Search::WithLines(const LoopFit& from, int PointStructure::*lines, const char* key) const {
  if (from.model.structure.*lines > 0) return from;
  LoopForm model = from.model;
  model.structure.*lines = kCycleLines;
  return FitLoopFrom(records_, model, StartsWith(records_, from, model).rows, MaximumTaken::kBest,
                     key, options_);
}

void Search::Forward(LoopFound* out) const {
  ForwardSearch forward(records_, base_, options_);
  while (out->steps.size() < kMostItems) {
    std::optional<LoopStep> next = forward.Next(out->best, out->steps);
    if (!next) break;
    out->best = next->after;
    out->steps.push_back(std::move(*next));
  }
  for (const LoopStep& step : out->steps) {
    if (step.item.kind != LoopItemKind::kInstrument) continue;
    out->best = Refined(records_, std::move(out->best), step.item, "best/", options_);
  }
}

// What pays least goes first, as long as something does not pay.
void Search::Backward(LoopFound* out) const {
  for (std::size_t round = 0; !out->steps.empty(); ++round) {
    const std::string key = "back/" + std::to_string(round) + "/";
    out->without.clear();
    std::size_t least = 0;
    for (std::size_t i = 0; i < out->steps.size(); ++i) {
      out->without.push_back(Without(out->best, out->steps, i, key));
      VLOG(1) << key << out->steps[i].item.id << " "
              << out->best.Density() - out->without[i].Density() << " nats lost";
      if (out->without[i].Density() > out->without[least].Density()) least = i;
    }
    if (out->without[least].Density() < out->best.Density()) break;
    out->best = out->without[least];
    out->steps.erase(out->steps.begin() + static_cast<std::ptrdiff_t>(least));
    if (out->steps.empty()) out->without.clear();
  }
}

LoopFound Search::Run() const {
  LoopFound out;
  out.base = FitBase();
  out.best = out.base;
  Forward(&out);
  Backward(&out);
  out.with_acoustic_lines = WithLines(out.best, &PointStructure::acoustic_lines, "acoustic_lines/");
  out.with_flame_lines = WithLines(out.best, &PointStructure::flame_lines, "flame_lines/");
  return out;
}

}  // namespace

LoopFound SearchLoopBudget(const LoopRecords& records, const LoopForm& base,
                           const LoopBudgetOptions& options) {
  return Search(records, base, options).Run();
}

}  // namespace howl
