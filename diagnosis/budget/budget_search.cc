#include "diagnosis/budget/budget_search.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/budget/items/item_removal.h"
#include "diagnosis/budget/step_memory.h"

namespace howl {
namespace {

constexpr std::size_t kMostItems = 16;
constexpr double kFirstScatter = 0.02;  // of log delay
constexpr double kOddsOfEquals = 50.0;
constexpr double kLeastToMove = 1.0;  // nats
// Odds of 19 to 1 that none of the items that are tried would gain as much by chance.
double NatsToPay(std::size_t tried) { return std::log(19.0 * static_cast<double>(tried)); }
// The flame's regressor is recorded p, whose noise bends what the flame seems to be: on rigs
// without an effect delay_dispersion gains 9 to 11 nats (practice rigs 2 and 7), and up to 16 where
// the noise is a hundredth of p (verdict.cc).
constexpr double kNatsToPayInFlame = 16.0;

class BudgetSearch {
 public:
  BudgetSearch(BudgetRecords* records, const BudgetOptions& options)
      : records_(*records),
        options_(options),
        catalogue_(BudgetItems(records->records[0].model, options.withheld, options.further)),
        items_(catalogue_) {
    StructureFit start = StartOf(&records->whole, FitBase(records->records), BaseNoise());
    for (std::vector<JointBand>& half : records->halves) SetErrorScale(start, &half);
    if (records->records[0].model.own_delays) {
      start.structure.own_delays = true;
      start.shared.delay_scatter = std::max(start.shared.delay_scatter, kFirstScatter);
    }
    found_.fit = Converged(records->whole, std::move(start));
  }

  std::optional<BudgetFound> Run() {
    found_.base = ScoreHeldOut(records_, found_.fit);
    score_ = found_.base;
    LogState("base");
    while (has_.size() < kMostItems && Forward()) {
    }
    while (!Stopped() && DropLeast()) {
    }
    if (Stopped()) return std::nullopt;
    CountLosses();
    found_.all = score_;
    return std::move(found_);
  }

 private:
  bool Stopped() const { return options_.stopped && options_.stopped(); }

  void LogState(const std::string& what) const {
    VLOG(1) << what << ": evidence " << found_.fit.log_evidence << ", gap " << score_.Gap(0) << " "
            << score_.Gap(1) << ", nats left out " << score_.Nats() << ", eps "
            << found_.fit.shared.eps_a << " " << found_.fit.shared.eps_b << ", scatter "
            << found_.fit.shared.delay_scatter;
  }

  bool MayAdd(const BudgetItem& item) const {
    return item.kind == ItemKind::kMode ||
           std::ranges::find(has_, item.id, &BudgetItem::id) == has_.end();
  }

  // Adds the item that pays most. False if none pays.
  bool Forward() {
    const std::string key = "budget." + std::to_string(step_++);
    const Screen screen = MakeScreen(records_, found_.fit);
    if (options_.memory) {
      const std::optional<std::string> text = options_.memory->Recall(key);
      if (text) {
        const std::optional<FinishedStep> step = StepFromText(*text, items_.size());
        if (step && Redo(screen, *step)) return step->added.has_value();
      }
    }
    FinishedStep step;
    // What all operating points share comes first: freedoms that each point has by itself could
    // make up for several effects together, and name none.
    std::vector<ItemTrial> trials;
    std::size_t done = 0;
    for (const bool own : {false, true}) {
      std::vector<ItemTrial> of_kind;
      for (const BudgetItem& item : items_) {
        if (IsOwnFreedom(item) != own) continue;
        if (Stopped()) return false;
        if (options_.progress) options_.progress(done++, items_.size());
        if (!MayAdd(item)) continue;
        std::optional<ItemTrial> trial = TryItem(records_, screen, found_.fit, item);
        if (!trial) continue;
        VLOG(2) << "  with " << trial->item.id << ": " << Gain(trial->fit) << " nats";
        of_kind.push_back(std::move(*trial));
      }
      AddBest(&of_kind, &step);
      std::ranges::move(of_kind, std::back_inserter(trials));
      if (step.added) break;
    }
    if (options_.progress) options_.progress(items_.size(), items_.size());
    for (const ItemTrial& trial : trials) {
      if (trial.item.kind != ItemKind::kEffect) continue;
      const std::size_t item = Number(trial.item);
      const std::vector<EffectPointer>& forms = catalogue_[item].forms;
      const auto form = std::ranges::find(forms, trial.item.forms[0]) - forms.begin();
      step.fitted.push_back({item, static_cast<std::size_t>(form), trial.item.fitted});
    }
    Take(step);
    if (options_.memory) options_.memory->Keep(key, ToText(step));
    return step.added.has_value();
  }

  static bool IsOwnFreedom(const BudgetItem& item) {
    return item.kind == ItemKind::kMode || item.kind == ItemKind::kComplexResidues;
  }

  void AddBest(std::vector<ItemTrial>* trials, FinishedStep* step) {
    std::ranges::stable_sort(*trials, std::ranges::greater(),
                             [](const ItemTrial& t) { return t.fit.log_evidence; });
    for (std::size_t i = 0; i < trials->size() && !step->added; ++i) {
      const ItemTrial& trial = (*trials)[i];
      if (Gain(trial.fit) < Price(trial.item)) continue;
      const std::vector<std::string> equals = Equals(*trials, i);
      if (!Accept(trial, equals)) continue;
      step->equals = equals;
      step->added = Number(trial.item);
    }
  }

  // A step that was finished before an interruption. False where it is none of this search.
  bool Redo(const Screen& screen, const FinishedStep& step) {
    for (const FinishedStep::Fitted& fitted : step.fitted) {
      const std::vector<EffectPointer>& forms = catalogue_[fitted.item].forms;
      if (fitted.form >= forms.size() ||
          fitted.values.size() != forms[fitted.form]->parameters().size()) {
        return false;
      }
    }
    if (step.added) {
      const std::optional<ItemTrial> trial =
          TryItem(records_, screen, found_.fit, items_[*step.added]);
      if (!trial || !Accept(*trial, step.equals)) return false;
    }
    Take(step);
    return true;
  }

  void Take(const FinishedStep& step) {
    for (const FinishedStep::Fitted& fitted : step.fitted) {
      items_[fitted.item].forms = {catalogue_[fitted.item].forms[fitted.form]};
      items_[fitted.item].fitted = fitted.values;
    }
  }

  std::size_t Number(const BudgetItem& item) const {
    return static_cast<std::size_t>(std::ranges::find(items_, item.id, &BudgetItem::id) -
                                    items_.begin());
  }

  static std::vector<std::string> Equals(const std::vector<ItemTrial>& trials, std::size_t which) {
    std::vector<std::string> out;
    const double least = trials[which].fit.log_evidence - std::log(kOddsOfEquals);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (i != which && trials[i].fit.log_evidence >= least) out.push_back(trials[i].item.id);
    }
    return out;
  }

  double Gain(const StructureFit& fit) const { return fit.log_evidence - found_.fit.log_evidence; }

  double Price(const BudgetItem& item) const {
    const double odds = NatsToPay(items_.size());
    const bool flame = item.kind == ItemKind::kEffect && item.forms[0]->ChangesFlameCut();
    return flame ? std::max(odds, kNatsToPayInFlame) : odds;
  }

  // What was left out must be foretold better too.
  bool Accept(const ItemTrial& trial, const std::vector<std::string>& equals) {
    StructureFit fit = SearchedAnew(Converged(records_.whole, trial.fit), trial.item);
    HeldOutScore score = ScoreHeldOut(records_, fit);
    const double foretold = score.Nats() - score_.Nats();
    if (foretold <= 0.0) {
      VLOG(1) << "  " << trial.item.id << " foretells no better: " << foretold << " nats";
      return false;
    }
    BudgetStep step;
    step.item = trial.item;
    step.equals = equals;
    found_.fit = std::move(fit);
    score_ = std::move(score);
    step.after = score_;
    has_.push_back(step.item);
    LogState("+ " + step.item.id);
    found_.steps.push_back(std::move(step));
    return true;
  }

  // What an item had to make up for when it was added may have moved it to a false place: with a
  // further item there, the search for each earlier effect's parameters is repeated.
  StructureFit SearchedAnew(StructureFit fit, const BudgetItem& added) const {
    std::vector<BudgetItem> all = has_;
    all.push_back(added);
    for (std::size_t i = 0; i < has_.size(); ++i) {
      if (has_[i].kind != ItemKind::kEffect) continue;
      const StructureFit without = Without(fit, all, i);
      BudgetItem anew = has_[i];
      anew.fitted.clear();
      const std::optional<ItemTrial> trial =
          TryItem(records_, MakeScreen(records_, without), without, anew);
      if (!trial || trial->fit.log_posterior <= fit.log_posterior + kLeastToMove) continue;
      VLOG(1) << "  " << anew.id
              << " found elsewhere: " << trial->fit.log_posterior - fit.log_posterior << " nats";
      fit = Converged(records_.whole, trial->fit);
    }
    return fit;
  }

  // Drops the item that is worth least to the others, if it no longer pays.
  bool DropLeast() {
    without_.clear();
    std::optional<std::size_t> least;
    double margin = 0.0;
    for (std::size_t i = 0; i < has_.size(); ++i) {
      if (Stopped()) return false;
      without_.push_back(Converged(records_.whole, Without(found_.fit, has_, i)));
      const double above = -Gain(without_[i]) - Price(has_[i]);
      if (above >= margin) continue;
      margin = above;
      least = i;
    }
    if (!least) return false;
    VLOG(1) << "- " << has_[*least].id << ", which no longer pays";
    found_.fit = std::move(without_[*least]);
    score_ = ScoreHeldOut(records_, found_.fit);
    has_.erase(has_.begin() + static_cast<std::ptrdiff_t>(*least));
    found_.steps.erase(found_.steps.begin() + static_cast<std::ptrdiff_t>(*least));
    return true;
  }

  // What is lost without each item, once none is dropped any more.
  void CountLosses() {
    for (const StructureFit& without : without_) {
      found_.losses.push_back({-Gain(without), ScoreHeldOut(records_, without)});
    }
  }

  const BudgetRecords& records_;
  const BudgetOptions& options_;
  const std::vector<BudgetItem> catalogue_;
  std::vector<BudgetItem> items_;  // with what the step before found
  std::vector<BudgetItem> has_;
  BudgetFound found_;
  HeldOutScore score_;
  std::vector<StructureFit> without_;  // each of the items, the rest fitted anew
  int step_ = 0;
};

}  // namespace

std::optional<BudgetFound> SearchBudget(BudgetRecords* records, const BudgetOptions& options) {
  return BudgetSearch(records, options).Run();
}

}  // namespace howl
