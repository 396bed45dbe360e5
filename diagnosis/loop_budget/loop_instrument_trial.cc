#include "diagnosis/loop_budget/loop_instrument_trial.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "estimation/parallel.h"
#include "estimation/record_fit/point_posterior.h"

namespace howl {
namespace {

constexpr int kMostSteps = 10;
constexpr int kMostRounds = 3;
constexpr double kStands = 0.1;      // of the value's own deviation
constexpr double kFirstStep = 0.05;  // of the search's range
constexpr double kReach = 4.0;       // of a step, within which a value known leads on

double ToSearch(const EffectParameter& p, double x) {
  return p.scale == ParameterScale::kLogarithmic ? std::log(x) : x;
}

double FromSearch(const EffectParameter& p, double u) {
  return p.scale == ParameterScale::kLogarithmic ? std::exp(u) : u;
}

double SearchSpan(const EffectParameter& p) { return ToSearch(p, p.high) - ToSearch(p, p.low); }

// A value in the coordinate of the search, what it is worth, and each point's parameters there.
struct ProfilePoint {
  double u = 0.0;
  double nats = -std::numeric_limits<double>::infinity();
  std::vector<Eigen::VectorXd> parameters;
};

struct Maximum {
  ProfilePoint at;
  double std = 0.0;  // of u; infinite where the profile has no maximum
};

class Profile {
 public:
  Profile(const LoopRecords& records, const LoopFit& from, const LoopItem& item, std::string key,
          const LoopBudgetOptions& options)
      : records_(records),
        from_(from),
        parameter_(item.instrument->parameters()[0]),
        form_(With(Without(from.model, item, from.model), item)),
        key_(std::move(key)),
        options_(options) {}

  const EffectParameter& parameter() const { return parameter_; }
  double Low() const { return ToSearch(parameter_, parameter_.low); }
  double High() const { return ToSearch(parameter_, parameter_.high); }
  LoopForm FormAt(double u) const {
    LoopForm form = form_;
    form.instruments.back().value = FromSearch(parameter_, u);
    return form;
  }
  // From `near`, or from where the line through it and the last value known near it leads.
  ProfilePoint At(double u, const ProfilePoint& near);
  ProfilePoint At(double u, const std::vector<Eigen::VectorXd>& starts);
  Maximum From(ProfilePoint best, double least = -std::numeric_limits<double>::infinity());

 private:
  const LoopRecords& records_;
  const LoopFit& from_;
  const EffectParameter& parameter_;
  LoopForm form_;
  std::string key_;
  std::vector<ProfilePoint> known_;
  std::size_t evaluations_ = 0;  // each is a unit of its own, the same value from another start too
  const LoopBudgetOptions& options_;
};

ProfilePoint Profile::At(double u, const ProfilePoint& near) {
  const auto distance = [&](const ProfilePoint& other) {
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

ProfilePoint Profile::At(double u, const std::vector<Eigen::VectorXd>& starts) {
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
  ProfilePoint out{u, 0.0, {}};
  for (std::size_t e = 0; e < records_.size(); ++e) {
    out.nats += fits[e].log_evidence + records_.LogJacobianOfWhole(form, e);
    out.parameters.push_back(fits[e].parameters);
  }
  known_.push_back(out);
  return out;
}

// Up, by ever longer steps and then by parabolas through three values each, until they stand closer
// than the profile's own width, or until a parabola's top is not worth `least`.
Maximum Profile::From(ProfilePoint best, double least) {
  double step = kFirstStep * SearchSpan(parameter_);
  double std = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostSteps; ++i) {
    const double u = best.u;
    ProfilePoint below = At(std::max(u - step, Low()), best);
    ProfilePoint above = At(std::min(u + step, High()), best);
    const double curvature =
        2.0 *
        ((above.nats - best.nats) / (above.u - u) - (best.nats - below.nats) / (u - below.u)) /
        (above.u - below.u);
    if (below.nats > best.nats || above.nats > best.nats || !(curvature < 0.0)) {
      best = below.nats > above.nats ? std::move(below) : std::move(above);
      if (best.u <= Low() || best.u >= High()) break;
      step *= 2.0;
      continue;
    }
    std = 1.0 / std::sqrt(-curvature);
    const double slope = (above.nats - below.nats) / (above.u - below.u);
    if (step <= std || best.nats - 0.5 * slope * slope / curvature < least) break;
    ProfilePoint vertex = At(u - slope / curvature, best);
    if (vertex.nats > best.nats) best = std::move(vertex);
    step = std::max(step / 4.0, std);
  }
  return {std::move(best), std};
}

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
  Profile profile(records, from, item, key + "trial/" + KeyOf(item) + "/", options);
  ProfilePoint best;
  for (const double start : profile.parameter().starts) {
    ProfilePoint point = profile.At(ToSearch(profile.parameter(), start), ParametersOf(from));
    if (point.nats > best.nats) best = std::move(point);
  }
  double without = standing;
  for (std::size_t e = 0; e < records.size(); ++e) {
    without += records.LogJacobianOfWhole(from.model, e);
  }
  const Maximum maximum = profile.From(std::move(best), without);
  LoopTrial out{item, profile.FormAt(maximum.at.u), 0.0, {maximum.at.parameters}};
  const double span = SearchSpan(profile.parameter());
  const double width = std::sqrt(2.0 * std::numbers::pi) * maximum.std;
  out.gain = maximum.at.nats - without + std::log(std::min(width, span) / span);
  return out;
}

LoopFit Refined(const LoopRecords& records, LoopFit fit, const LoopItem& item,
                const std::string& key, const LoopBudgetOptions& options) {
  for (int round = 0; round < kMostRounds; ++round) {
    const std::string of_round = key + "refined/" + KeyOf(item) + "/" + std::to_string(round) + "/";
    const LoopItem same = AsFitted(fit, item);
    Profile profile(records, fit, same, of_round, options);
    const double before = ToSearch(profile.parameter(), ValueOf(fit, item));
    const Maximum maximum = profile.From(profile.At(before, ParametersOf(fit)));
    if (std::abs(maximum.at.u - before) < kStands * maximum.std) break;
    LoopFit next = FitLoopFrom(records, profile.FormAt(maximum.at.u), {maximum.at.parameters},
                               MaximumTaken::kNext, of_round, options);
    if (!(next.Density() > fit.Density())) break;
    fit = std::move(next);
  }
  return fit;
}

EstimatedParameter EstimateInstrument(const LoopRecords& records, const LoopFit& fit,
                                      const LoopItem& item, const std::string& key,
                                      const LoopBudgetOptions& options) {
  Profile profile(records, fit, AsFitted(fit, item), key + "estimate/" + KeyOf(item) + "/",
                  options);
  const EffectParameter& parameter = profile.parameter();
  const Maximum maximum =
      profile.From(profile.At(ToSearch(parameter, ValueOf(fit, item)), ParametersOf(fit)));
  const double value = FromSearch(parameter, maximum.at.u);
  const bool logarithmic = parameter.scale == ParameterScale::kLogarithmic;
  return WithError(parameter, value, logarithmic ? value * maximum.std : maximum.std);
}

}  // namespace howl
