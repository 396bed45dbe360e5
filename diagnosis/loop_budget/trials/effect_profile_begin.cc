// Where the search over a shared effect's values begins.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "diagnosis/loop_budget/trials/effect_profile.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/delay_maxima.h"
#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {
namespace {

// Of each operating point the likelier fit, of two at the same values.
EffectPoint BetterAtEach(EffectPoint a, EffectPoint b) {
  for (std::size_t e = 0; e < a.fits.size(); ++e) {
    if (b.fits[e].log_posterior > a.fits[e].log_posterior) a.fits[e] = std::move(b.fits[e]);
  }
  a.SumUp();
  return a;
}

}  // namespace

std::vector<EffectPoint> EffectProfile::Begin(const std::vector<Eigen::VectorXd>& at_null) {
  const Eigen::VectorXd null = NullEnd();
  const EffectParameter& parameter = effect().parameters()[0];
  if (HasFarFromNull()) return BeginFromNull(At(null, at_null));
  std::vector<double> starts;
  const double factor = RangeFactor(effect(), parameter, records_);
  for (const double start : parameter.starts) starts.push_back(ToSearch(parameter, factor * start));
  std::ranges::sort(starts, {}, [&](double u) { return std::abs(u - null[0]); });
  const auto roughly_at = [&](const Eigen::VectorXd& u, const std::vector<Eigen::VectorXd>& from) {
    return At(u, from, kToCompare, RecordExtent::kMiddle);
  };
  const EffectPoint at_rest = roughly_at(null, at_null);
  EffectPoint below = at_rest;
  EffectPoint above = at_rest;
  std::vector<EffectPoint> best;
  std::optional<EffectPoint> unfinished;  // the likeliest
  for (const double u : starts) {
    EffectPoint& last = u < null[0] ? below : above;
    Eigen::VectorXd beside = null;
    beside[0] = u;
    const bool is_first = last.u == null;
    last = roughly_at(beside, ParametersOf(last.fits));
    // From one value's loop the next value's may be missed: a low-pass of p was none where it had
    // 1400 nats, as the loops that came with its other starts were worse than that without it.
    if (!is_first) last = BetterAtEach(std::move(last), roughly_at(beside, at_null));
    if (last.log_posterior > at_rest.log_posterior) best.push_back(last);
    if (std::ranges::all_of(last.fits, &PointFit::converged)) continue;
    if (!unfinished || last.log_posterior > unfinished->log_posterior) unfinished = last;
  }
  // Fits that have used up their iterations are not known to be behind: one of three points behind
  // a low-pass of p had 240 nats yet to gain, without which the low-pass was none.
  if (best.empty() && unfinished) {
    EffectPoint further = roughly_at(unfinished->u, ParametersOf(unfinished->fits));
    if (further.log_posterior > at_rest.log_posterior) best.push_back(std::move(further));
  }
  if (best.empty()) return {At(null, at_null)};
  KeepBest(&best);
  std::vector<EffectPoint> out = OnWholeRecords(best);
  for (EffectPoint& each : out) AgainFromNull(at_null, &each);
  return out;
}

void EffectProfile::KeepBest(std::vector<EffectPoint>* points) {
  std::ranges::stable_sort(*points, std::ranges::greater(), &EffectPoint::log_posterior);
  points->resize(std::min(points->size(), kMostFollowed));
}

std::vector<EffectPoint> EffectProfile::OnWholeRecords(const std::vector<EffectPoint>& of_middles) {
  std::vector<std::vector<Eigen::VectorXd>> starts(of_middles.size());
  for (std::size_t e = 0; e < records_.size() && !starts.empty(); ++e) {
    const RecordSpectra record = records_.Whole(form_, e);
    for (std::size_t k = 0; k < starts.size(); ++k) {
      starts[k].push_back(BesideMiddle(record, form_.structure, of_middles[k].fits[e].parameters));
    }
  }
  std::vector<EffectPoint> out;
  for (std::size_t k = 0; k < starts.size(); ++k) out.push_back(At(of_middles[k].u, starts[k]));
  return out;
}

void EffectProfile::AtOtherDelays(EffectPoint* point) {
  const LoopForm form = FormAt(point->u);
  const std::string key = key_ + "delays/" + std::to_string(evaluations_++) + "/";
  const std::vector<Eigen::VectorXd> all = ParametersOf(point->fits);
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    PointFit& fit = point->fits[e];
    fit = KeptFit(options_.units, key + std::to_string(e), [&] {
      const RecordSpectra whole = records_.Whole(form, e);
      const PointPrior prior = PriorOfTrial(records_, from_, form, e, whole);
      return BestWith(whole, form.structure, prior, fit,
                      OtherDelayStarts(MiddleOf(whole), form.structure, prior, fit.parameters, all),
                      ToCompareWith(PosteriorWithout(e) - point->log_jacobian[e]));
    });
  });
  point->SumUp();
}

void EffectProfile::AgainFromNull(const std::vector<Eigen::VectorXd>& at_null, EffectPoint* point) {
  const LoopForm form = FormAt(point->u);
  const std::string key = key_ + "again/" + std::to_string(evaluations_++) + "/";
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    PointFit& fit = point->fits[e];
    if (fit.log_posterior + point->log_jacobian[e] > PosteriorWithout(e) - kWorthAnother) return;
    PointFit again = KeptFit(options_.units, key + std::to_string(e), [&] {
      const RecordSpectra whole = records_.WholeAlone(form, e);
      return FitPoint(whole, form.structure, PriorOfTrial(records_, from_, form, e, whole),
                      at_null[e]);
    });
    if (again.log_posterior > fit.log_posterior) fit = std::move(again);
  });
  point->SumUp();
}

}  // namespace howl
