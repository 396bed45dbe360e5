#include "diagnosis/loop_budget/trials/loop_instrument_trial.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "diagnosis/loop_budget/trials/instrument_profile.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr int kMostRounds = 3;
constexpr double kStands = 0.1;  // of the value's own deviation

const LoopInstrument& InstrumentOf(const LoopFit& fit, const LoopItem& item) {
  const auto at = std::ranges::find_if(fit.model.instruments, [&](const LoopInstrument& each) {
    return each.effect->id() == item.id;
  });
  CHECK(at != fit.model.instruments.end());
  return *at;
}

// In the form that the fit has.
LoopItem AsFitted(const LoopFit& fit, LoopItem item) {
  item.instrument = InstrumentOf(fit, item).effect;
  return item;
}

double ValueOf(const LoopFit& fit, const LoopItem& item) { return InstrumentOf(fit, item).value; }

}  // namespace

LoopTrial TryInstrument(const LoopRecords& records, const LoopFit& from, double standing,
                        const LoopItem& item, const std::string& key,
                        const LoopBudgetOptions& options) {
  InstrumentProfile profile(records, from, item, key + "trial/" + KeyOf(item) + "/", options);
  double without = standing;
  for (std::size_t e = 0; e < records.size(); ++e) {
    without += records.LogJacobianOfWhole(from.model, e);
  }
  const ProfileMaximum maximum = profile.From(profile.Begin(ParametersOf(from)), without);
  LoopTrial out{item, profile.FormAt(maximum.at.u), 0.0, {ParametersOf(maximum.at.fits)}};
  const double span = SearchSpan(profile.parameter());
  const double width = std::sqrt(2.0 * std::numbers::pi) * maximum.std;
  out.gain = maximum.at.log_evidence - without + std::log(std::min(width, span) / span);
  return out;
}

std::vector<LoopTrial> TryAll(const LoopRecords& records, const LoopFit& from, double standing,
                              const std::vector<LoopItem>& items, const std::string& key,
                              const LoopBudgetOptions& options) {
  std::vector<LoopItem> own;
  std::vector<LoopItem> instruments;
  for (const LoopItem& item : items) {
    (item.kind == LoopItemKind::kInstrument ? instruments : own).push_back(item);
  }
  std::vector<LoopTrial> out = TryItems(records, from, standing, own, key, options);
  out.resize(items.size());
  RunUnits(instruments.size(), options.threads, [&](std::size_t i) {
    out[own.size() + i] = TryInstrument(records, from, standing, instruments[i], key, options);
  });
  return out;
}

LoopFit Refined(const LoopRecords& records, LoopFit fit, const LoopItem& item,
                const std::string& key, const LoopBudgetOptions& options) {
  for (int round = 0; round < kMostRounds; ++round) {
    const std::string of_round = key + "refined/" + KeyOf(item) + "/" + std::to_string(round) + "/";
    const LoopItem same = AsFitted(fit, item);
    InstrumentProfile profile(records, fit, same, of_round, options);
    const double before = ToSearch(profile.parameter(), ValueOf(fit, item));
    const ProfileMaximum maximum = profile.From(profile.At(before, ParametersOf(fit)));
    if (std::abs(maximum.at.u - before) < kStands * maximum.std) break;
    LoopFit next =
        FitLoopFrom(records, profile.FormAt(maximum.at.u), {ParametersOf(maximum.at.fits)},
                    MaximumTaken::kNext, of_round, options);
    if (!(next.Density() > fit.Density())) break;
    fit = std::move(next);
  }
  return fit;
}

LoopFit FitTrial(const LoopRecords& records, const LoopTrial& trial, const StartRows& starts,
                 const std::string& key, const LoopBudgetOptions& options) {
  LoopFit fit = FitLoopFrom(records, trial.model, starts, MaximumTaken::kBest, key, options);
  if (trial.item.kind != LoopItemKind::kInstrument) return fit;
  return Refined(records, std::move(fit), trial.item, key, options);
}

EstimatedParameter EstimateInstrument(const LoopRecords& records, const LoopFit& fit,
                                      const LoopItem& item, const std::string& key,
                                      const LoopBudgetOptions& options) {
  InstrumentProfile profile(records, fit, AsFitted(fit, item),
                            key + "estimate/" + KeyOf(item) + "/", options);
  const EffectParameter& parameter = profile.parameter();
  const ProfileMaximum maximum =
      profile.From(profile.At(ToSearch(parameter, ValueOf(fit, item)), ParametersOf(fit)));
  const double value = FromSearch(parameter, maximum.at.u);
  const bool logarithmic = parameter.scale == ParameterScale::kLogarithmic;
  return WithError(parameter, value, logarithmic ? value * maximum.std : maximum.std);
}

}  // namespace howl
