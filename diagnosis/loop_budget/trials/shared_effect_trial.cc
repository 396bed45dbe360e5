#include "diagnosis/loop_budget/trials/shared_effect_trial.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/trials/effect_profile.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr int kMostRounds = 3;
constexpr double kStands = 0.1;  // of the value's own deviation
// What an effect must gain near its null, over what the best trial does, to be tried far from it,
// which takes as long as several trials: what is not tried so now will be beside what comes in. A
// second path gained 0.87 of it on a rig that has one, and 0.22 on one with a low-pass of q.
constexpr double kWorthFar = 0.5;

const SharedEffect& EffectOf(const LoopFit& fit, const LoopItem& item) {
  const auto at = std::ranges::find_if(
      fit.model.effects, [&](const SharedEffect& each) { return each.effect->id() == item.id; });
  CHECK(at != fit.model.effects.end());
  return *at;
}

// In the form that the fit has.
LoopItem AsFitted(const LoopFit& fit, LoopItem item) {
  item.effect = EffectOf(fit, item).effect;
  return item;
}

Eigen::VectorXd ValuesOf(const LoopFit& fit, const LoopItem& item) {
  const SharedEffect& shared = EffectOf(fit, item);
  return ToSearch(*shared.effect, shared.values);
}

double WithoutEffect(const LoopRecords& records, const LoopFit& from, double standing) {
  for (std::size_t e = 0; e < records.size(); ++e) {
    standing += records.LogJacobianOfWhole(from.model, e);
  }
  return standing;
}

// The best of the maxima that are next to where it begins.
LoopTrial TrialFrom(std::vector<EffectPoint> begins, double without, const LoopItem& item,
                    EffectProfile* profile) {
  ProfileMaximum maximum;
  for (EffectPoint& begin : begins) {
    // At its null the loop is that which stands, whose delays are known.
    const bool at_null = begin.u[0] == profile->NullEnd()[0];
    if (!at_null && begin.log_evidence > without) profile->AtOtherDelays(&begin);
    // As long as it may come out ahead.
    const double least = std::max(without, maximum.at.log_evidence);
    ProfileMaximum next = profile->From(std::move(begin), least);
    const bool first = maximum.at.fits.empty();
    if (first || next.at.log_posterior > maximum.at.log_posterior) maximum = std::move(next);
  }
  LoopTrial out{item, profile->FormAt(maximum.at.u), 0.0, 0.0, {ParametersOf(maximum.at.fits)}};
  // At its null it gains nothing.
  if (maximum.at.u[0] == profile->NullEnd()[0]) return out;
  out.price = -maximum.LogShare(profile->spans());
  out.gain = maximum.at.log_evidence - without - out.price;
  return out;
}

}  // namespace

LoopTrial TrySharedEffect(const LoopRecords& records, const LoopFit& from, double standing,
                          const LoopItem& item, const std::string& key,
                          const LoopBudgetOptions& options) {
  EffectProfile profile(records, from, item, MaximumKnown::kRoughly,
                        key + "trial/" + KeyOf(item) + "/", options);
  return TrialFrom(profile.Begin(ParametersOf(from)), WithoutEffect(records, from, standing), item,
                   &profile);
}

LoopTrial TryFarFromNull(const LoopRecords& records, const LoopFit& from, double standing,
                         LoopTrial near, const std::string& key, const LoopBudgetOptions& options) {
  EffectProfile profile(records, from, near.item, MaximumKnown::kRoughly,
                        key + "far/" + KeyOf(near.item) + "/", options);
  if (!profile.HasFarFromNull()) return near;
  LoopTrial far = TrialFrom(profile.BeginFarFromNull(ParametersOf(from)),
                            WithoutEffect(records, from, standing), near.item, &profile);
  return far.gain > near.gain ? far : near;
}

std::vector<LoopTrial> TryAll(const LoopRecords& records, const LoopFit& from, double standing,
                              const std::vector<LoopItem>& items, const std::string& key,
                              const LoopBudgetOptions& options) {
  std::vector<LoopItem> own;
  std::vector<LoopItem> effects;
  for (const LoopItem& item : items) {
    (item.kind == LoopItemKind::kSharedEffect ? effects : own).push_back(item);
  }
  std::vector<LoopTrial> out = TryItems(records, from, standing, own, key, options);
  out.resize(items.size());
  RunUnits(effects.size(), options.threads, [&](std::size_t i) {
    out[own.size() + i] = TrySharedEffect(records, from, standing, effects[i], key, options);
  });
  double best = std::log(kOddsOfItem * static_cast<double>(items.size()));
  for (const LoopTrial& trial : out) best = std::max(best, trial.gain);
  for (std::size_t i = own.size(); i < out.size(); ++i) {
    if (out[i].gain < kWorthFar * best) continue;
    out[i] = TryFarFromNull(records, from, standing, std::move(out[i]), key, options);
  }
  return out;
}

LoopFit Refined(const LoopRecords& records, LoopFit fit, const LoopItem& item,
                const std::string& key, const LoopBudgetOptions& options) {
  for (int round = 0; round < kMostRounds; ++round) {
    const std::string of_round = key + "refined/" + KeyOf(item) + "/" + std::to_string(round) + "/";
    const LoopItem same = AsFitted(fit, item);
    EffectProfile profile(records, fit, same, MaximumKnown::kClosely, of_round, options);
    const Eigen::VectorXd before = ValuesOf(fit, item);
    const ProfileMaximum maximum = profile.From(profile.At(before, ParametersOf(fit)));
    const Eigen::ArrayXd moved = (maximum.at.u - before).array().abs();
    if ((moved < kStands * maximum.Deviations().array()).all()) break;
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
  if (trial.item.kind != LoopItemKind::kSharedEffect) return fit;
  return Refined(records, std::move(fit), trial.item, key, options);
}

std::vector<EstimatedParameter> EstimateSharedEffect(const LoopRecords& records, const LoopFit& fit,
                                                     const LoopItem& item, const std::string& key,
                                                     const LoopBudgetOptions& options) {
  EffectProfile profile(records, fit, AsFitted(fit, item), MaximumKnown::kClosely,
                        key + "estimate/" + KeyOf(item) + "/", options);
  const ProfileMaximum maximum = profile.From(profile.At(ValuesOf(fit, item), ParametersOf(fit)));
  const Eigen::VectorXd deviations = maximum.Deviations();
  std::vector<EstimatedParameter> out;
  for (const EffectParameter& parameter : profile.effect().parameters()) {
    const auto i = static_cast<Eigen::Index>(out.size());
    const double value = FromSearch(parameter, maximum.at.u[i]);
    const bool logarithmic = parameter.scale == ParameterScale::kLogarithmic;
    out.push_back(WithError(parameter, value, logarithmic ? value * deviations[i] : deviations[i]));
    // Where the records tell little of a value, its interval ends where its prior does.
    out.back().low = std::max(out.back().low, FromSearch(parameter, profile.low()[i]));
    out.back().high = std::min(out.back().high, FromSearch(parameter, profile.high()[i]));
  }
  return out;
}

}  // namespace howl
