// Where the search over a shared effect's values begins.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "diagnosis/loop_budget/trials/effect_profile.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/delay_maxima.h"
#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {
namespace {

// A second parameter's values, as many as have a delay's maxima apart.
constexpr std::size_t kScanned = 24;
// How many of the best places are gone on from: to first order, or roughly fitted, they may be out
// of order. A resonance of p, of which the better of two starts was told by the last digits, ended
// with 250 nats from the one, with 2700 from the other.
constexpr std::size_t kMostFollowed = 2;
constexpr double kLongestBegin = 0.5;  // of the first parameter's range

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
  if (null.size() > 1 && std::isfinite(parameter.null_value)) {
    return BeginFromNull(At(null, at_null));
  }
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
  std::ranges::stable_sort(best, std::ranges::greater(), &EffectPoint::log_posterior);
  best.resize(std::min(best.size(), kMostFollowed));
  std::vector<std::vector<Eigen::VectorXd>> whole(best.size());
  for (std::size_t e = 0; e < records_.size(); ++e) {
    const RecordSpectra record = records_.Whole(form_, e);
    for (std::size_t k = 0; k < best.size(); ++k) {
      whole[k].push_back(BesideMiddle(record, form_.structure, best[k].fits[e].parameters));
    }
  }
  std::vector<EffectPoint> out;
  for (std::size_t k = 0; k < best.size(); ++k) {
    out.push_back(At(best[k].u, whole[k]));
    AgainFromNull(at_null, &out.back());
  }
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
  const std::string key = key_ + "again/" + std::to_string(evaluations_) + "/";
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

std::vector<EffectPoint> EffectProfile::BeginFromNull(const EffectPoint& null) {
  struct Beside {
    Eigen::VectorXd u;
    double gain = 0.0;
    std::vector<Eigen::VectorXd> starts;
  };
  std::vector<Beside> tried(kScanned);
  for (std::size_t i = 0; i < tried.size(); ++i) {
    EffectPoint at = null;
    const double way = static_cast<double>(i) / static_cast<double>(kScanned - 1);
    at.u[1] = low_[1] + way * span_[1];
    const std::vector<Slopes> slopes = SlopesAt(at, 1);
    double slope = 0.0;
    double curvature = 0.0;
    for (const Slopes& each : slopes) {
      slope += each.slope[0];
      curvature += each.curvature(0, 0);
    }
    if (!(curvature < 0.0)) continue;
    const double to = std::clamp(at.u[0] - slope / curvature, low_[0], high_[0]);
    const double step =
        std::clamp(to - at.u[0], -kLongestBegin * span_[0], kLongestBegin * span_[0]);
    tried[i].gain = step * (slope + 0.5 * step * curvature);
    tried[i].u = at.u;
    tried[i].u[0] += step;
    tried[i].starts = ParametersOf(null.fits);
    for (std::size_t e = 0; e < slopes.size(); ++e) {
      tried[i].starts[e] += step * slopes[e].by.col(0);
    }
  }
  std::vector<Beside> best;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const bool top = (i == 0 || tried[i].gain >= tried[i - 1].gain) &&
                     (i + 1 == tried.size() || tried[i].gain > tried[i + 1].gain);
    if (top && tried[i].gain > 0.0) best.push_back(tried[i]);
  }
  std::ranges::stable_sort(best, std::ranges::greater(), &Beside::gain);
  best.resize(std::min(best.size(), kMostFollowed));
  std::vector<EffectPoint> out;
  for (const Beside& each : best) out.push_back(At(each.u, each.starts));
  if (!best.empty() && best[0].gain > kWorthAnother) {
    std::ranges::move(FarFrom(null), std::back_inserter(out));
  }
  if (out.empty()) out.push_back(null);
  return out;
}

std::vector<EffectPoint> EffectProfile::FarFrom(const EffectPoint& null) {
  const std::vector<Eigen::VectorXd> at_null = ParametersOf(null.fits);
  const double at_rest = At(null.u, at_null, kToCompare, RecordExtent::kMiddle).log_posterior;
  std::vector<EffectPoint> tried;
  for (std::size_t i = 0; i < kScanned; ++i) {
    Eigen::VectorXd u = null.u;
    u[0] = std::min(u[0] + kLongestBegin * span_[0], high_[0]);
    u[1] = low_[1] + span_[1] * static_cast<double>(i) / static_cast<double>(kScanned - 1);
    tried.push_back(At(u, at_null, kToCompare, RecordExtent::kMiddle));
    fprintf(stderr, "far %g %g\n", std::exp(u[1]), tried.back().log_posterior);
  }
  std::vector<EffectPoint> best;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const double here = tried[i].log_posterior;
    const bool top = (i == 0 || here >= tried[i - 1].log_posterior) &&
                     (i + 1 == tried.size() || here > tried[i + 1].log_posterior);
    if (top && here > at_rest) best.push_back(tried[i]);
  }
  std::ranges::stable_sort(best, std::ranges::greater(), &EffectPoint::log_posterior);
  best.resize(std::min(best.size(), kMostFollowed));
  std::vector<EffectPoint> out;
  for (const EffectPoint& each : best) {
    std::vector<Eigen::VectorXd> whole;
    for (std::size_t e = 0; e < records_.size(); ++e) {
      whole.push_back(
          BesideMiddle(records_.WholeAlone(form_, e), form_.structure, each.fits[e].parameters));
    }
    out.push_back(At(each.u, whole));
  }
  return out;
}

}  // namespace howl
