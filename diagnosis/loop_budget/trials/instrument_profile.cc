#include "diagnosis/loop_budget/trials/instrument_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/parallel.h"
#include "estimation/record_fit/point_posterior.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr int kMostSteps = 20;
constexpr int kMostHalvings = 5;
constexpr double kLongestStep = 0.03;  // of the search's range, so that fits follow
// Of the same: ten times as long differences see the third derivative, a tenth as long ones the
// last digits of sums over thousands of bins.
constexpr double kDifference = 1e-5;

}  // namespace

double ToSearch(const EffectParameter& parameter, double value) {
  return parameter.scale == ParameterScale::kLogarithmic ? std::log(value) : value;
}

double FromSearch(const EffectParameter& parameter, double u) {
  return parameter.scale == ParameterScale::kLogarithmic ? std::exp(u) : u;
}

double SearchSpan(const EffectParameter& parameter) {
  return ToSearch(parameter, parameter.high) - ToSearch(parameter, parameter.low);
}

InstrumentProfile::InstrumentProfile(const LoopRecords& records, const LoopFit& from,
                                     const LoopItem& item, std::string key,
                                     const LoopBudgetOptions& options)
    : records_(records),
      from_(from),
      parameter_(item.instrument->parameters()[0]),
      form_(With(Without(from.model, item, from.model), item)),
      key_(std::move(key)),
      options_(options) {}

LoopForm InstrumentProfile::FormAt(double u) const {
  LoopForm form = form_;
  form.instruments.back().value = FromSearch(parameter_, u);
  return form;
}

InstrumentPoint InstrumentProfile::At(double u, const std::vector<Eigen::VectorXd>& starts,
                                      const PointFitOptions& options, RecordExtent extent) {
  const std::string key = key_ + std::to_string(evaluations_++) + "/";
  const LoopForm form = FormAt(u);
  InstrumentPoint out{u, 0.0, 0.0, std::vector<PointFit>(records_.size())};
  std::vector<double> jacobians(records_.size());
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    const RecordSpectra whole = records_.Whole(form, e);
    const RecordSpectra& record = extent == RecordExtent::kMiddle ? MiddleOf(whole) : whole;
    jacobians[e] = LogJacobian(record, form.instruments);
    out.fits[e] = KeptFit(options_.units, key + std::to_string(e), [&] {
      return FitPoint(record, form.structure, PriorOfTrial(records_, from_, form, e, record),
                      starts[e], options);
    });
  });
  for (std::size_t e = 0; e < records_.size(); ++e) {
    const double jacobian = jacobians[e];
    out.log_posterior += out.fits[e].log_posterior + jacobian;
    out.log_evidence += out.fits[e].log_evidence + jacobian;
  }
  return out;
}

InstrumentPoint InstrumentProfile::Begin(const std::vector<Eigen::VectorXd>& at_null) {
  // An infinite null is next to the range's end.
  const double null = ToSearch(parameter_, std::min(parameter_.null_value, parameter_.high));
  std::vector<double> starts;
  for (const double start : parameter_.starts) starts.push_back(ToSearch(parameter_, start));
  std::ranges::sort(starts, {}, [&](double u) { return std::abs(u - null); });
  const auto roughly_at = [&](double u, const std::vector<Eigen::VectorXd>& from) {
    return At(u, from, kToCompare, RecordExtent::kMiddle);
  };
  InstrumentPoint best = roughly_at(null, at_null);
  InstrumentPoint below = best;
  InstrumentPoint above = best;
  for (const double u : starts) {
    InstrumentPoint& last = u < null ? below : above;
    last = roughly_at(u, ParametersOf(last.fits));
    if (last.log_posterior > best.log_posterior) best = last;
  }
  if (best.u == null) return At(null, at_null);
  std::vector<Eigen::VectorXd> whole = ParametersOf(best.fits);
  for (std::size_t e = 0; e < whole.size(); ++e) {
    whole[e] = BesideMiddle(records_.Whole(form_, e), form_.structure, std::move(whole[e]));
  }
  return At(best.u, whole);
}

InstrumentProfile::Slopes InstrumentProfile::SlopesOfPoint(const InstrumentPoint& point,
                                                           std::size_t e) const {
  struct Beside {
    double value = 0.0;
    Eigen::VectorXd gradient;
  };
  const PointFit& fit = point.fits[e];
  const auto beside = [&](double u) {
    const LoopForm form = FormAt(u);
    const RecordSpectra record = records_.Whole(form, e);
    const PointPrior prior = PriorOfTrial(records_, from_, form, e, record);
    PointPosterior posterior(record, form.structure, prior);
    const double value = posterior.Value(fit.parameters) + records_.LogJacobianOfWhole(form, e);
    return Beside{value, posterior.Gradient(fit.parameters).cwiseQuotient(prior.deviation)};
  };
  const double step = kDifference * SearchSpan(parameter_);
  const Beside below = beside(point.u - step);
  const Beside above = beside(point.u + step);
  const double here = fit.log_posterior + records_.LogJacobianOfWhole(FormAt(point.u), e);
  const Eigen::VectorXd turn = (above.gradient - below.gradient) / (2.0 * step);
  const Eigen::VectorXd by = SolveSymmetric(fit.information, turn);
  return {(above.value - below.value) / (2.0 * step),
          (above.value - 2.0 * here + below.value) / (step * step) + turn.dot(by), by};
}

std::vector<InstrumentProfile::Slopes> InstrumentProfile::SlopesAt(
    const InstrumentPoint& point) const {
  std::vector<Slopes> out(records_.size());
  RunUnits(out.size(), options_.threads, [&](std::size_t e) { out[e] = SlopesOfPoint(point, e); });
  return out;
}

ProfileMaximum InstrumentProfile::From(InstrumentPoint best, double least) {
  const double low = ToSearch(parameter_, parameter_.low);
  const double high = ToSearch(parameter_, parameter_.high);
  double std = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostSteps; ++i) {
    const std::vector<Slopes> slopes = SlopesAt(best);
    double slope = 0.0;
    double curvature = 0.0;
    for (const Slopes& each : slopes) {
      slope += each.slope;
      curvature += each.curvature;
    }
    if (!std::isfinite(slope) || !std::isfinite(curvature)) break;
    const double most = kLongestStep * SearchSpan(parameter_);
    double step = std::copysign(most, slope);
    std = std::numeric_limits<double>::infinity();
    if (curvature < 0.0) {
      std = 1.0 / std::sqrt(-curvature);
      const double gain = -0.5 * slope * slope / curvature;
      if (gain < PointFitOptions{}.converged || best.log_evidence + gain < least) break;
      step = std::clamp(-slope / curvature, -most, most);
    }
    step = std::clamp(best.u + step, low, high) - best.u;
    if (step == 0.0) break;
    const double from = best.u;
    for (int halved = 0; best.u == from && halved < kMostHalvings; ++halved, step *= 0.5) {
      std::vector<Eigen::VectorXd> starts = ParametersOf(best.fits);
      for (std::size_t e = 0; e < starts.size(); ++e) starts[e] += step * slopes[e].by;
      InstrumentPoint next = At(from + step, starts);
      if (next.log_posterior > best.log_posterior) best = std::move(next);
    }
    if (best.u == from) break;
  }
  return {std::move(best), std};
}

}  // namespace howl
