#include "diagnosis/loop_budget/account/item_bounds.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "diagnosis/loop_budget/account/change_values.h"
#include "diagnosis/loop_budget/trials/effect_interval.h"
#include "estimation/analysis/spectra/half_width.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

bool IsOneValue(const LoopItem& item) {
  return item.kind == LoopItemKind::kSharedEffect && item.effect->parameters().size() == 1;
}

// The loop with each point as its record alone has it, near where all points have it.
LoopFit EachAlone(const LoopRecords& records, LoopFit fit, const LoopBudgetOptions& options) {
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    const RecordSpectra record = records.WholeAlone(fit.model, e);
    PointFit& point = fit.fit.points[e];
    fit.fit.prior[e] = PriorOf(fit.model.structure, record);
    point = KeptFit(options.units, "bounds/alone/" + std::to_string(e), [&] {
      return FitPoint(record, fit.model.structure, fit.fit.prior[e], point.parameters, kToCompare);
    });
  });
  return fit;
}

ItemBound BoundOfShared(const LoopRecords& records, const LoopFit& alone, const LoopItem& item,
                        const LoopBudgetOptions& options) {
  EffectProfile profile(records, alone, item, MaximumKnown::kClosely, "bounds/" + KeyOf(item) + "/",
                        options);
  const EffectParameter& parameter = profile.effect().parameters()[0];
  const EffectInterval interval = IntervalOf(ParametersOf(alone), &profile);
  return {item.id, FormOf(item), parameter.name, parameter.unit, interval.low, interval.high};
}

// A value at one point, and its variance.
struct ValueAtPoint {
  double value = 0.0;
  double variance = 0.0;
};

ValueAtPoint ChangeAt(const RecordSpectra& record, const LoopForm& form, const PointValue& value,
                      const PointFit& fit, const PointPrior& prior) {
  constexpr double kDifference = 1e-4;  // of the prior's deviations
  const auto at = [&](const Eigen::VectorXd& parameters) {
    return value.of(record, ToPoint(form.structure, record.flame.cols(), parameters));
  };
  Eigen::VectorXd slope(fit.parameters.size());
  for (Eigen::Index i = 0; i < slope.size(); ++i) {
    const double step = kDifference * prior.deviation[i];
    const Eigen::VectorXd along = step * Eigen::VectorXd::Unit(slope.size(), i);
    slope[i] = (at(fit.parameters + along) - at(fit.parameters - along)) / (2.0 * step);
  }
  return {at(fit.parameters), slope.dot(fit.Covariance() * slope)};
}

// Of a change that is the same at all points: the mean, each weighed by what it tells.
ItemBound BoundOfChange(const LoopRecords& records, const LoopFit& alone, const LoopItem& item,
                        const LoopBudgetOptions& options) {
  const LoopForm form = With(alone.model, item);
  const std::vector<Eigen::VectorXd> starts =
      StartsWith(records, alone, form, options.threads).rows[0];
  const PointValue value = ValueOfChange(item);
  std::vector<ValueAtPoint> values(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    const RecordSpectra record = records.WholeAlone(form, e);
    const PointPrior prior = PriorOf(form.structure, record);
    const PointFit fit = KeptFit(options.units, "bounds/" + item.id + "/" + std::to_string(e), [&] {
      return FitPoint(record, form.structure, prior, starts[e]);
    });
    values[e] = ChangeAt(record, form, value, fit, prior);
  });
  double weights = 0.0;
  double sum = 0.0;
  for (const ValueAtPoint& each : values) {
    weights += 1.0 / each.variance;
    sum += each.value / each.variance;
  }
  const double half = HalfWidth95(1.0 / std::sqrt(weights));
  return {item.id, "", value.name, "", sum / weights - half, sum / weights + half};
}

}  // namespace

std::vector<ItemBound> BoundsBeside(const LoopRecords& records, const LoopFit& best,
                                    const LoopForm& base, const LoopBudgetOptions& options) {
  const LoopFit alone = EachAlone(records, best, options);
  std::vector<LoopItem> items = LoopItems(best.model, base, options.declared);
  std::erase_if(items, [&](const LoopItem& item) {
    const bool withheld = std::ranges::find(options.withheld, item.id) != options.withheld.end();
    return withheld || !(IsOneValue(item) || item.kind == LoopItemKind::kSlowChange);
  });
  std::vector<ItemBound> out(items.size());
  RunUnits(items.size(), options.threads, [&](std::size_t i) {
    const auto bound = items[i].kind == LoopItemKind::kSlowChange ? BoundOfChange : BoundOfShared;
    out[i] = bound(records, alone, items[i], options);
  });
  return out;
}

}  // namespace howl
