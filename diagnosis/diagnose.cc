// One diagnosis with the base that the config's model states, or that is chosen by the records.
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/search/choose_modes.h"
#include "diagnosis/search/search.h"

namespace howl {
namespace {

// A second search of one run keeps its fits under names of its own.
class SecondMemory final : public FitMemory {
 public:
  explicit SecondMemory(FitMemory* first) : first_(first) {}
  std::optional<std::string> Recall(const std::string& key) override {
    return first_->Recall("own_delays." + key);
  }
  void Keep(const std::string& key, const std::string& bytes) override {
    first_->Keep("own_delays." + key, bytes);
  }

 private:
  FitMemory* first_;
};

// ln 19, in nats: the effect is preferred to own delays at odds of 19 to 1.
constexpr double kLogOddsToAccuse = 2.944438979166440;

BudgetOptions BudgetOptionsOf(const DiagnosisOptions& options) {
  BudgetOptions out;
  out.withheld = options.withheld;
  out.further = options.further;
  out.memory = options.memory;
  out.progress = options.budget_progress;
  out.stopped = options.stopped;
  return out;
}

}  // namespace

bool DelaysDiffer(double own_delays_gain) { return own_delays_gain > DetectionGain(true); }

// Own delays that gain as much as the best effect replace it: a rig is not accused of what may be
// no more than the different delays of its operating points. Where the effect gains more, own
// delays are tried in addition to it.
double Search::OwnDelaysGain() const {
  std::vector<CutRecord> records = records_;
  for (CutRecord& record : records) record.model.own_delays = true;
  const EffectFit base = FitBase(records);
  const auto best = std::ranges::max_element(
      attempts_, {}, [](const Attempt& attempt) { return attempt.candidate.gain; });
  if (best == attempts_.end() || best->candidate.gain <= 0.0 || !ShowsInFlame(*best) ||
      !best->repaired.empty() || best->redeclipped ||
      GainOver(base, *best->fit) < kLogOddsToAccuse) {
    return base_.cost() - base.cost();
  }
  return best->fit->cost() - ConvergedFit(records, base, *best->fit).cost();
}

Diagnosis Diagnose(const std::vector<DiagnosisExperiment>& experiments,
                   const DiagnosisOptions& options) {
  DiagnosisOptions chosen = options;
  double second_mode_gain = std::numeric_limits<double>::quiet_NaN();
  if (options.choose_modes) {
    const ModesChoice choice = ChooseModes(experiments, options.model);
    chosen.model.modes = choice.modes;
    second_mode_gain = choice.second_mode_gain;
  }
  if (options.choose_delays) chosen.model.own_delays = false;
  Diagnosis out = Search(experiments, chosen).Run();
  const double own_delays_gain = out.own_delays_gain;
  if (DelaysDiffer(own_delays_gain)) {
    SecondMemory memory(options.memory);
    if (options.memory) chosen.memory = &memory;
    chosen.choose_delays = false;
    chosen.model.own_delays = true;
    out = Search(experiments, chosen).Run();
    out.own_delays_gain = own_delays_gain;
  }
  out.second_mode_gain = second_mode_gain;
  // A reference has the rig's own gap already. What is repaired are samples, and a transfer
  // function fitted to them would speak of the repair.
  const bool wanted = options.find_budget && options.reference.empty() && out.repaired.empty();
  if (wanted && !out.stopped && out.kind == VerdictKind::kUnknown) {
    BaseModel model = out.model;
    if (options.choose_delays) model.own_delays = true;
    out.budget = FindBudget(experiments, model, BudgetOptionsOf(options));
    out.stopped = out.budget->stopped;
  }
  return out;
}

}  // namespace howl
