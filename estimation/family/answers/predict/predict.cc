#include "estimation/family/answers/predict/predict.h"

#include <algorithm>
#include <cmath>

#include "estimation/parallel.h"
#include "model/cycles/harmonic_balance.h"
#include "model/loop/loop.h"

namespace howl {

namespace {

// The neighbours of phi and how far it is from the first to the second.
struct Between {
  std::size_t below;
  std::size_t above;
  double share;
};

std::optional<Between> Neighbours(std::span<const Experiment> experiments, double phi) {
  std::optional<std::size_t> below, above;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (experiments[i].phi <= phi && (!below || experiments[i].phi > experiments[*below].phi)) {
      below = i;
    }
    if (experiments[i].phi >= phi && (!above || experiments[i].phi < experiments[*above].phi)) {
      above = i;
    }
  }
  if (!below || !above) return std::nullopt;
  const double step = experiments[*above].phi - experiments[*below].phi;
  return Between{*below, *above, step > 0.0 ? (phi - experiments[*below].phi) / step : 0.0};
}

}  // namespace

Prediction PredictSampled(std::string name, std::span<const Member> members,
                          const MemberPredictor& predictor, int threads) {
  Prediction prediction;
  prediction.name = std::move(name);
  std::vector<double> values(members.size());
  RunUnits(members.size(), threads, [&](std::size_t k) {
    values[k] = predictor(members[k]).value_or(std::numeric_limits<double>::quiet_NaN());
  });
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  prediction.members = values.size();
  if (values.empty()) return prediction;
  std::sort(values.begin(), values.end());
  prediction.interval = {values.front(), values.back()};
  prediction.central_90 = {NearestRank(values, 0.05), NearestRank(values, 0.95)};
  return prediction;
}

std::optional<double> CrossingNear(const LoopModel& model, const Range& band_hz) {
  constexpr int kCells = 64;
  const LoopParameters<double> loop = model.Loop();
  const auto error = [&](double f) { return LoopPhaseError(loop, f); };
  const double middle = 0.5 * (band_hz.lo + band_hz.hi);
  std::optional<double> best;
  double left = band_hz.lo;
  double at_left = error(left);
  for (int cell = 1; cell <= kCells; ++cell) {
    const double right = band_hz.lo + (band_hz.hi - band_hz.lo) * cell / kCells;
    const double at_right = error(right);
    // A change of sign through zero, not through the branch cut at half a turn.
    if ((at_left <= 0.0) != (at_right <= 0.0) && std::abs(at_left - at_right) < 3.0) {
      double a = left, b = right;
      for (int halving = 0; halving < 60; ++halving) {
        const double c = 0.5 * (a + b);
        ((error(c) <= 0.0) == (at_left <= 0.0) ? a : b) = c;
      }
      const double root = 0.5 * (a + b);
      if (!best || std::abs(root - middle) < std::abs(*best - middle)) best = root;
    }
    left = right;
    at_left = at_right;
  }
  return best;
}

std::optional<double> LineGain(const LoopModel& model, const Range& band_hz, double flame_slope) {
  const std::optional<double> line = CrossingNear(model, band_hz);
  if (!line) return std::nullopt;
  return LoopGain(model.Loop(), *line, flame_slope);
}

std::optional<double> PressureAmplitude(const LoopModel& model, const Flame<double>& flame,
                                        double frequency_hz) {
  constexpr double kReach = 0.2;
  constexpr double kLargest = 1e4;  // amplitude over the one at which the flame saturates
  const std::optional<double> f =
      CrossingNear(model, {frequency_hz * (1.0 - kReach), frequency_hz * (1.0 + kReach)});
  if (!f) return std::nullopt;
  const double response = Magnitude(LoopResponse(model.Loop(), *f));
  const auto excess = [&](double amplitude) {
    return response * std::abs(DescribingFunction(flame, amplitude)) - 1.0;
  };
  const double knee = flame.saturation / std::abs(flame.slope);
  double lo = 1e-9 * knee;
  double hi = kLargest * knee;
  if (!(excess(lo) > 0.0) || !(excess(hi) < 0.0)) return std::nullopt;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = std::sqrt(lo * hi);
    (excess(middle) > 0.0 ? lo : hi) = middle;
  }
  const std::optional<LimitCycle> cycle = SolveLimitCycle({model.Loop(), flame}, *f, lo);
  if (!cycle || std::abs(cycle->frequency_hz / frequency_hz - 1.0) > kReach) return std::nullopt;
  return cycle->pressure_amplitude();
}

std::optional<LoopModel> InterpolateModel(std::span<const Experiment> experiments,
                                          std::span<const LoopModel> models, double phi) {
  const std::optional<Between> at = Neighbours(experiments, phi);
  if (!at) return std::nullopt;
  const LoopModel& a = models[at->below];
  const LoopModel& b = models[at->above];
  const auto mix = [&](double x, double y) { return x + at->share * (y - x); };
  return LoopModel{mix(a.omega_hz, b.omega_hz), mix(a.xi, b.xi), mix(a.N, b.N), mix(a.M, b.M),
                   mix(a.tau_s, b.tau_s),       a.harmonic_ratio};
}

std::optional<double> InterpolatedFrequency(std::span<const Experiment> experiments,
                                            std::span<const LoopModel> models, double phi,
                                            double reach) {
  const std::optional<Between> at = Neighbours(experiments, phi);
  const std::optional<LoopModel> model = InterpolateModel(experiments, models, phi);
  if (!at || !model) return std::nullopt;
  const double f =
      experiments[at->below].frequency_hz +
      at->share * (experiments[at->above].frequency_hz - experiments[at->below].frequency_hz);
  return CrossingNear(*model, {f * (1.0 - reach), f * (1.0 + reach)});
}

double NearestRank(std::span<const double> ascending, double share) {
  return ascending[static_cast<std::size_t>(
      std::lround(share * static_cast<double>(ascending.size() - 1)))];
}

}  // namespace howl
