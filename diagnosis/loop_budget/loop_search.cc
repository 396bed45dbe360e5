#include "diagnosis/loop_budget/loop_search.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "diagnosis/loop_budget/loop_instrument_trial.h"

namespace howl {
namespace {

constexpr double kOdds = 20.0;  // that an item comes in by chance, to one
constexpr double kOddsOfClass = 50.0;
constexpr std::size_t kMostFitted = 2;  // of a step's trials: those that gain most
constexpr std::size_t kMostItems = 24;

// What comes only where nothing of an earlier one pays.
enum class Stage : std::uint8_t { kHum, kNoise, kCauses, kLineErrors };

Stage StageOf(const LoopItem& item) {
  if (IsHum(item.noise.source)) return Stage::kHum;
  if (item.kind == LoopItemKind::kNoise) return Stage::kNoise;
  return item.kind == LoopItemKind::kLineErrors ? Stage::kLineErrors : Stage::kCauses;
}

struct Fitted {
  std::size_t trial;
  LoopFit fit;
};

// The items that would have gained as much as that of this trial.
std::vector<std::string> EqualsOf(const std::vector<LoopTrial>& trials, std::size_t of) {
  std::vector<std::string> out;
  for (const LoopTrial& trial : trials) {
    const bool same = trial.item.id == trials[of].item.id;
    const double behind = std::abs(trials[of].gain - trial.gain);
    if (!same && behind < std::log(kOddsOfClass)) out.push_back(trial.item.id);
  }
  return out;
}

class Search {
 public:
  Search(const LoopRecords& records, const LoopForm& base, const LoopBudgetOptions& options)
      : records_(records), base_(base), options_(options) {}

  LoopFound Run() const;

 private:
  LoopFit FitBase() const;
  // No value where nothing pays any more.
  std::optional<LoopStep> Next(const LoopFit& from, std::size_t step, bool only_hum_yet) const;
  std::vector<LoopTrial> Try(const LoopFit& from, const std::vector<LoopItem>& items,
                             const std::string& key) const;
  // The best of these trials that pays; those of `fitted` have been found not to.
  std::optional<LoopStep> BestOf(std::vector<LoopTrial> trials, const LoopFit& from,
                                 const std::vector<LoopItem>& fitted, const std::string& key) const;
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

std::optional<LoopStep> Search::Next(const LoopFit& from, std::size_t step,
                                     bool only_hum_yet) const {
  std::vector<LoopItem> items = LoopItems(from.model, base_);
  std::erase_if(items, [&](const LoopItem& item) {
    return std::ranges::find(options_.withheld, item.id) != options_.withheld.end();
  });
  const std::string key = "step/" + std::to_string(step) + "/";
  std::vector<LoopTrial> trials;
  std::vector<LoopItem> tried;
  for (const Stage stage : {Stage::kHum, Stage::kNoise, Stage::kCauses, Stage::kLineErrors}) {
    if (stage == Stage::kHum && !only_hum_yet) continue;
    std::vector<LoopItem> now;
    std::ranges::copy_if(items, std::back_inserter(now),
                         [&](const LoopItem& item) { return StageOf(item) == stage; });
    for (LoopTrial& trial : Try(from, now, key)) trials.push_back(std::move(trial));
    if (std::optional<LoopStep> found = BestOf(trials, from, tried, key)) return found;
    tried.insert(tried.end(), now.begin(), now.end());
  }
  return std::nullopt;
}

std::vector<LoopTrial> Search::Try(const LoopFit& from, const std::vector<LoopItem>& items,
                                   const std::string& key) const {
  std::vector<LoopItem> own;
  std::vector<LoopItem> instruments;
  for (const LoopItem& item : items) {
    (item.kind == LoopItemKind::kInstrument ? instruments : own).push_back(item);
  }
  std::vector<LoopTrial> out = TryItems(records_, from, own, key, options_);
  for (const LoopItem& item : instruments) {
    out.push_back(TryInstrument(records_, from, item, key, options_));
  }
  return out;
}

std::optional<LoopStep> Search::BestOf(std::vector<LoopTrial> trials, const LoopFit& from,
                                       const std::vector<LoopItem>& fitted,
                                       const std::string& key) const {
  std::ranges::stable_sort(trials, std::ranges::greater(), &LoopTrial::gain);
  for (const LoopTrial& trial : trials) {
    VLOG(1) << key << trial.item.id << " " << trial.gain << " nats";
  }
  const double least = std::log(kOdds * static_cast<double>(trials.size()));
  std::vector<Fitted> best;
  for (std::size_t i = 0; i < std::min(trials.size(), kMostFitted); ++i) {
    if (!(trials[i].gain > 0.0)) break;
    if (std::ranges::find(fitted, trials[i].item.id, &LoopItem::id) != fitted.end()) continue;
    LoopFit fit = FitLoopFrom(records_, trials[i].model, trials[i].starts, MaximumTaken::kNext,
                              key + "next/" + KeyOf(trials[i].item) + "/", options_);
    VLOG(1) << key << trials[i].item.id << " foretells " << fit.Density() - from.Density()
            << " nats better";
    best.push_back({i, std::move(fit)});
  }
  std::ranges::stable_sort(best, std::ranges::greater(),
                           [](const Fitted& each) { return each.fit.Density(); });
  for (const Fitted& each : best) {
    if (!(each.fit.Density() > from.Density())) break;
    const LoopTrial& trial = trials[each.trial];
    LoopFit fit = FitLoopFrom(records_, trial.model, {ParametersOf(each.fit)}, MaximumTaken::kBest,
                              key + "best/" + KeyOf(trial.item) + "/", options_);
    if (trial.item.kind == LoopItemKind::kInstrument) {
      fit = Refined(records_, std::move(fit), trial.item, key, options_);
    }
    if (fit.Density() > from.Density() + least) {
      return LoopStep{trial.item, EqualsOf(trials, each.trial), std::move(fit)};
    }
  }
  return std::nullopt;
}

// The modes that were added stand behind the base's in the order of their steps.
std::size_t ModeOf(const std::vector<LoopStep>& steps, std::size_t which, const LoopForm& base) {
  auto mode = static_cast<std::size_t>(base.structure.modes);
  for (std::size_t i = 0; i < which; ++i) {
    if (steps[which].item.kind == LoopItemKind::kMode && steps[i].item.kind == LoopItemKind::kMode)
      ++mode;
  }
  return mode;
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

LoopFound Search::Run() const {
  LoopFound out;
  out.base = FitBase();
  out.best = out.base;
  for (std::size_t step = 0; step < kMostItems; ++step) {
    const bool only_hum_yet = std::ranges::all_of(
        out.steps, [](const LoopStep& each) { return StageOf(each.item) == Stage::kHum; });
    std::optional<LoopStep> next = Next(out.best, step, only_hum_yet);
    if (!next) break;
    out.best = next->after;
    out.steps.push_back(std::move(*next));
  }
  for (const LoopStep& step : out.steps) {
    if (step.item.kind != LoopItemKind::kInstrument) continue;
    out.best = Refined(records_, std::move(out.best), step.item, "best/", options_);
  }
  // Backward: what pays least goes first, as long as something does not pay.
  for (std::size_t round = 0; !out.steps.empty(); ++round) {
    const std::string key = "back/" + std::to_string(round) + "/";
    out.without.clear();
    std::size_t least = 0;
    for (std::size_t i = 0; i < out.steps.size(); ++i) {
      out.without.push_back(Without(out.best, out.steps, i, key));
      if (out.without[i].Density() > out.without[least].Density()) least = i;
    }
    if (out.without[least].Density() < out.best.Density()) break;
    out.best = out.without[least];
    out.steps.erase(out.steps.begin() + static_cast<std::ptrdiff_t>(least));
    if (out.steps.empty()) out.without.clear();
  }
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
