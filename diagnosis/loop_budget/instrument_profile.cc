#include "diagnosis/loop_budget/instrument_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/parallel.h"
#include "estimation/record_fit/point_posterior.h"

namespace howl {
namespace {

constexpr int kMostSteps = 10;
constexpr double kFirstStep = 0.05;  // of the search's range
constexpr double kReach = 4.0;       // of a step, within which a value known leads on

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

InstrumentPoint InstrumentProfile::At(double u, const InstrumentPoint& near) {
  const auto distance = [&](const InstrumentPoint& other) {
    return other.u == near.u ? std::numeric_limits<double>::infinity() : std::abs(other.u - u);
  };
  const auto other = std::ranges::min_element(known_, {}, distance);
  if (other == known_.end() || !(distance(*other) < kReach * std::abs(u - near.u))) {
    return At(u, near.parameters);
  }
  const LoopForm form = FormAt(u);
  const double along = (u - near.u) / (near.u - other->u);
  std::vector<Eigen::VectorXd> starts = near.parameters;
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    const Eigen::VectorXd led =
        near.parameters[e] + along * (near.parameters[e] - other->parameters[e]);
    const RecordSpectra record = records_.Whole(form, e);
    const PointPrior prior = PriorOfTrial(records_, from_, form, e, record);
    PointPosterior posterior(record, form.structure, prior);
    if (posterior.Value(led) > posterior.Value(near.parameters[e])) starts[e] = led;
  });
  return At(u, starts);
}

InstrumentPoint InstrumentProfile::At(double u, const std::vector<Eigen::VectorXd>& starts) {
  const std::string key = key_ + std::to_string(evaluations_++) + "/";
  const LoopForm form = FormAt(u);
  std::vector<PointFit> fits(records_.size());
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    fits[e] = KeptFit(options_.units, key + std::to_string(e), [&] {
      const RecordSpectra record = records_.Whole(form, e);
      return FitPoint(record, form.structure, PriorOfTrial(records_, from_, form, e, record),
                      starts[e]);
    });
  });
  InstrumentPoint out{u, 0.0, {}};
  for (std::size_t e = 0; e < records_.size(); ++e) {
    out.nats += fits[e].log_evidence + records_.LogJacobianOfWhole(form, e);
    out.parameters.push_back(fits[e].parameters);
  }
  known_.push_back(out);
  return out;
}

ProfileMaximum InstrumentProfile::From(InstrumentPoint best, double least) {
  const double low = ToSearch(parameter_, parameter_.low);
  const double high = ToSearch(parameter_, parameter_.high);
  double step = kFirstStep * SearchSpan(parameter_);
  double std = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostSteps; ++i) {
    const double u = best.u;
    InstrumentPoint below = At(std::max(u - step, low), best);
    InstrumentPoint above = At(std::min(u + step, high), best);
    const double curvature =
        2.0 *
        ((above.nats - best.nats) / (above.u - u) - (best.nats - below.nats) / (u - below.u)) /
        (above.u - below.u);
    if (below.nats > best.nats || above.nats > best.nats || !(curvature < 0.0)) {
      best = below.nats > above.nats ? std::move(below) : std::move(above);
      if (best.u <= low || best.u >= high) break;
      step *= 2.0;
      continue;
    }
    std = 1.0 / std::sqrt(-curvature);
    const double slope = (above.nats - below.nats) / (above.u - below.u);
    if (step <= std || best.nats - 0.5 * slope * slope / curvature < least) break;
    InstrumentPoint vertex = At(u - slope / curvature, best);
    if (vertex.nats > best.nats) best = std::move(vertex);
    step = std::max(step / 4.0, std);
  }
  return {std::move(best), std};
}

}  // namespace howl
