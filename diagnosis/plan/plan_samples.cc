#include "diagnosis/plan/plan_samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/plan/sample_trial.h"
#include "diagnosis/verdict/verdict.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr int kHalvings = 7;       // of a factor of four: to 1 %
constexpr double kFarthest = 1e3;  // from the first trial size, to either side

// The value nearest to the null where `is` holds, by halving a factor; NaN where there is none.
double Boundary(const SampleTrial& trial, const std::function<bool(double)>& is) {
  const double larger = trial.inverted ? 1.0 / trial.factor : trial.factor;  // to a larger effect
  const auto inside = [&](double x) { return std::clamp(x, trial.least, trial.most); };
  double seen = trial.first;
  double unseen = trial.first;
  if (is(trial.first)) {
    while (is(unseen)) {
      seen = unseen;
      const double next = inside(unseen / larger);
      if (next == unseen || std::abs(std::log(next / trial.first)) > std::log(kFarthest)) {
        return seen;
      }
      unseen = next;
    }
  } else {
    while (!is(seen)) {
      unseen = seen;
      const double next = inside(seen * larger);
      if (next == seen) return kNaN;
      seen = next;
    }
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(seen * unseen);
    (is(middle) ? seen : unseen) = middle;
  }
  return seen;
}

}  // namespace

std::optional<PlannedEffect> PlanInSamples(const PlanRecords& at, const Effect& effect) {
  const std::optional<SampleTrial> trial = TrialOf(at, effect);
  if (!trial) return std::nullopt;
  const EffectParameter& p = effect.parameters().front();
  PlannedEffect out;
  out.effect = effect.id();
  out.block = effect.block();
  out.parameter = p.name;
  out.unit = p.unit;
  out.null_value = p.null_value;
  out.from_infinity = !std::isfinite(p.null_value);
  out.gain_needed =
      DetectionGain(false) + PriceOfParameters(static_cast<double>(effect.parameters().size()));
  out.size.smallest = Boundary(*trial, [&](double x) { return trial->at(x).seen; });
  out.size.others = trial->others;
  out.size.form = effect.form();
  out.sizes = {out.size};
  if (!std::isfinite(out.size.smallest)) return out;
  out.reference =
      trial->inverted ? out.size.smallest : std::min(2.0 * out.size.smallest, trial->most);
  const SampleFinding there = trial->at(out.reference);
  out.reference_gain = there.model_free ? std::numeric_limits<double>::infinity()
                                        : there.own + PriceOfParameters(2.0);
  if (trial->rival.empty()) return out;
  const auto needed = [](const SampleFinding& found) {
    return -std::log(kClassProbability) * Temperature(found.own);
  };
  PlannedRival rival;
  rival.effect = trial->rival;
  rival.nats = there.own - there.rival;
  rival.nats_needed = needed(there);
  rival.told_apart_at = Boundary(*trial, [&](double x) {
    const SampleFinding found = trial->at(x);
    return found.seen && found.own - found.rival > needed(found);
  });
  out.rivals.push_back(rival);
  return out;
}

}  // namespace howl
