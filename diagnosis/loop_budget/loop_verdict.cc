#include "diagnosis/loop_budget/loop_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/account/delay_trend.h"
#include "diagnosis/loop_budget/account/stated_loop.h"
#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/loop_places.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "diagnosis/loop_budget/why_unknown.h"
#include "diagnosis/verdict/advice.h"
#include "diagnosis/verdict/calibration.h"

namespace howl {
namespace {

constexpr double kKindsOfLineErrors = 2.0;

// Errors at the cycle's lines are no cause, and finer spectra of noise name none.
bool NamesCause(std::string_view item) {
  return !item.ends_with("_line_errors") && item != "noise_shape";
}
bool IsCause(const LoopStep& step) { return NamesCause(step.item.id); }

// Errors at the cycle's lines that no gain of the flame makes.
bool IsOfLines(const LoopStep& step, bool of_gain) {
  return step.item.lines == &PointStructure::acoustic_lines ||
         (step.item.lines == &PointStructure::flame_lines && !of_gain);
}

// Without errors at the cycle's lines, the best loop has at most this density.
double DensityWithoutLines(const LoopFound& found, bool of_gain) {
  double out = found.best.Density();
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    if (IsOfLines(found.steps[i], of_gain)) out = std::min(out, found.without[i].Density());
  }
  return out;
}

std::string Joined(const Budget& budget) {
  std::string out;
  const auto add = [&out](const std::string& name) { out += (out.empty() ? "" : "+") + name; };
  for (const SampleFact& fact : budget.seen_in_samples) add(fact.effect);
  for (const BudgetEntry& entry : budget.entries) {
    if (NamesCause(entry.item)) add(entry.item);
  }
  return out;
}

// All that is named, as the only candidate.
void AddCandidate(double gain, double probability, Diagnosis* diagnosis) {
  const Budget& budget = *diagnosis->budget;
  Candidate candidate;
  candidate.effect = Joined(budget);
  candidate.probability = probability;
  candidate.gain = gain;
  candidate.gap_after = budget.gap_left;
  candidate.shrinkage = budget.gap_before > 0.0 ? 1.0 - budget.gap_left / budget.gap_before : 0.0;
  candidate.shrinkage_low = candidate.shrinkage_high = std::numeric_limits<double>::quiet_NaN();
  candidate.p_value = std::numeric_limits<double>::quiet_NaN();
  if (budget.entries.size() == 1) candidate.parameters = budget.entries[0].parameters;
  diagnosis->candidates.push_back(std::move(candidate));
}

// What items would gain alone, beside the base, the best of them first: no candidates of which
// anything was fitted to all points.
void AddAlone(const LoopFound& found, Diagnosis* diagnosis) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const std::string named =
      diagnosis->candidates.empty() ? "" : diagnosis->candidates.front().effect;
  const std::size_t first = diagnosis->candidates.size();
  for (const auto& [item, gain] : found.alone) {
    if (!(gain > 0.0) || item == named) continue;
    Candidate candidate;
    candidate.effect = item;
    candidate.gain = gain;
    candidate.gap_after = candidate.shrinkage = candidate.p_value = kUnknown;
    candidate.shrinkage_low = candidate.shrinkage_high = kUnknown;
    diagnosis->candidates.push_back(std::move(candidate));
  }
  std::sort(diagnosis->candidates.begin() + static_cast<std::ptrdiff_t>(first),
            diagnosis->candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
}

// What is named with one item in the place of another of its class.
std::vector<std::string> Alike(const Budget& budget) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < budget.entries.size(); ++i) {
    for (const std::string& other : budget.entries[i].equals) {
      Budget exchanged;
      exchanged.seen_in_samples = budget.seen_in_samples;
      exchanged.entries = budget.entries;
      exchanged.entries[i].item = other;
      out.push_back(Joined(exchanged));
    }
  }
  return out;
}

// What free errors of either cut at the cycle's lines must gain before a loop is said to err there.
double LeastOfLines(const LoopFound& found, bool of_gain) {
  return std::log(kOddsOfItem * kKindsOfLineErrors) +
         LeftByForms(DensityWithoutLines(found, of_gain) - found.base.Density());
}

// The samples have been changed; of what else there may be nothing is said, so that what is known
// of it are the odds from before the records.
void TakeWhatSamplesShow(const LoopFound& found, Diagnosis* diagnosis) {
  diagnosis->kind = VerdictKind::kEffect;
  diagnosis->effect = Joined(*diagnosis->budget);
  diagnosis->probability_unknown = 1.0 / (1.0 + kOddsOfItem);
  AddCandidate(found.best.Density() - found.base.Density(), 1.0 - diagnosis->probability_unknown,
               diagnosis);
}

void TakeOdds(const LoopFound& found, LoopDiagnosis* out) {
  Diagnosis& diagnosis = out->diagnosis;
  const bool of_gain = out->flame.AreOfGain();
  const double gained = std::max(out->acoustics.NatsAgainst(), out->flame.NatsAgainst());
  const double least = LeastOfLines(found, of_gain);
  const bool errs = gained > least;
  double trend = 0.0;
  for (const BudgetEntry& entry : diagnosis.budget->entries) {
    if (entry.item == kDelayTrendId) trend = entry.lost_nats;
  }
  const bool seen = !diagnosis.budget->seen_in_samples.empty();
  const auto named = std::ranges::count_if(found.steps, IsCause) + (trend > 0.0 ? 1 : 0);
  out->unknown_because = found.looked ? WhyUnknown(*diagnosis.budget, errs, named)
                                      : "nothing that the loop may lack was looked for";
  const bool unknown = !out->unknown_because.empty();
  const bool any = seen || trend > 0.0 || std::ranges::any_of(found.steps, IsCause);
  diagnosis.kind = unknown ? VerdictKind::kUnknown
                   : any   ? VerdictKind::kEffect
                           : VerdictKind::kNone;
  if (diagnosis.kind == VerdictKind::kEffect) diagnosis.effect = Joined(*diagnosis.budget);
  const double best = DensityWithoutLines(found, of_gain) + trend;
  const bool lines_stay = std::ranges::any_of(
      found.steps, [&](const LoopStep& step) { return IsOfLines(step, of_gain); });
  const double with_lines = (lines_stay ? found.best.Density() + trend : best + gained) - least;
  const double base = found.base.Density();
  const double most = std::max({with_lines, best, base});
  std::array<double, 3> odds = {std::exp(with_lines - most), any ? std::exp(best - most) : 0.0,
                                seen ? 0.0 : std::exp(base - most)};
  if (unknown && !errs) odds[0] += std::exchange(odds[1], 0.0) + std::exchange(odds[2], 0.0);
  const double sum = odds[0] + odds[1] + odds[2];
  diagnosis.probability_unknown = odds[0] / sum;
  diagnosis.probability_none = odds[2] / sum;
  if (any) AddCandidate(best - base, odds[1] / sum, &diagnosis);
}

std::string JoinedBy(const std::string& between, const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

// What a config says of such a loop and such records.
std::string TextOf(const StatedLoop& stated) {
  std::vector<std::string> record;
  if (!stated.pressure_response.empty()) {
    record.push_back("pressure_response: " + stated.pressure_response);
  }
  if (!stated.heat_release_response.empty()) {
    record.push_back("heat_release_response: " + stated.heat_release_response);
  }
  if (stated.delay_s != 0.0) record.push_back("delay_s: " + ShortNumber(stated.delay_s));
  if (!stated.pressure_in_heat_release.empty()) {
    record.push_back("pressure_in_heat_release, another one in each");
  }
  const std::string model = stated.is_another_model ? stated.model : "the config's model";
  return model + (record.empty() ? "" : " and records with " + JoinedBy(", ", record));
}

std::string AdviceOf(const Diagnosis& diagnosis) {
  if (!RestCanBeFound(diagnosis.budget->seen_in_samples)) {
    return kRecordAgain;
  }
  const StatedLoop& stated = diagnosis.budget->stated;
  std::string fit = "howl fit with " + TextOf(stated);
  if (!stated.not_stated.empty()) {
    fit += ", which knows nothing of " + JoinedBy(", ", stated.not_stated);
  }
  switch (diagnosis.kind) {
    case VerdictKind::kNone:
      return diagnosis.budget->given.empty() ? "the config's loop stands" : fit;
    case VerdictKind::kEffect:
      return fit;
    case VerdictKind::kUnknown:
      break;
  }
  return fit +
         "; it is the best loop found, but need not be the rig's: distrust what it says of the "
         "cycle";
}

}  // namespace

void TakeVerdict(const LoopFound& found, LoopDiagnosis* out) {
  Diagnosis& diagnosis = out->diagnosis;
  const Budget& budget = *diagnosis.budget;
  diagnosis.gap_before = budget.gap_before;
  diagnosis.gap_after = budget.gap_left;
  diagnosis.gap_floor = budget.floor;
  if (RestCanBeFound(budget.seen_in_samples)) {
    TakeOdds(found, out);
  } else {
    TakeWhatSamplesShow(found, &diagnosis);
  }
  AddAlone(found, &diagnosis);
  if (RestCanBeFound(budget.seen_in_samples)) Calibrate(DoubtOfBudget(diagnosis.kind), &diagnosis);
  if (diagnosis.kind == VerdictKind::kEffect) diagnosis.indistinguishable = Alike(budget);
  diagnosis.where = PlacesOf(*out, LeastOfLines(found, out->flame.AreOfGain()));
  diagnosis.advice = AdviceOf(diagnosis);
}

}  // namespace howl
