#include "estimation/family/answers/predict/predict_points.h"

#include <algorithm>
#include <cmath>

#include "estimation/family/answers/predict/advise.h"
#include "estimation/family/answers/predict/oscillation_pole.h"
#include "estimation/family/answers/predict/predict.h"
#include "estimation/parallel.h"
#include "model/loop/flame.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

struct PathAnswer {
  bool has_loop = false;
  bool unstable = false;
  double frequency_hz = std::nan("");
  double growth_rate = std::nan("");
  double loop_gain = std::nan("");
  double amplitude = std::nan("");
};

// The amplitude A of p' at which D(A) / D(0) = 1 / loop_gain: in units of Q / |k| it is the same
// for every slope, so that one table serves all members.
class AmplitudeTable {
 public:
  explicit AmplitudeTable(const Flame<double>& flame) {
    constexpr int kSamples = 128;
    constexpr double kSmallest = 1e-3, kLargest = 1e3;  // of Q / |k|
    const double knee = flame.saturation / std::abs(flame.slope);
    const double rest = DescribingFunction(flame, 0.0);
    for (int k = 0; k < kNodes; ++k) {
      const double a = kSmallest * std::pow(kLargest / kSmallest, k / (kNodes - 1.0));
      amplitude_.push_back(a);
      gain_.push_back(rest / DescribingFunction(flame, a * knee, kSamples));
    }
  }

  // Times Q / |k|; no value where the flame does not saturate so far.
  std::optional<double> At(double loop_gain) const {
    const auto above = std::ranges::find_if(gain_, [&](double gain) { return gain >= loop_gain; });
    if (above == gain_.end()) return std::nullopt;
    const auto k = static_cast<std::size_t>(above - gain_.begin());
    if (k == 0) return 0.0;  // too small to matter
    const double share = (loop_gain - gain_[k - 1]) / (gain_[k] - gain_[k - 1]);
    return amplitude_[k - 1] + share * (amplitude_[k] - amplitude_[k - 1]);
  }

 private:
  static constexpr int kNodes = 600;
  std::vector<double> amplitude_, gain_;  // gain_: the loop gain whose cycle has that amplitude
};

PathAnswer Ask(const FamilyProblem& problem, const OperatingPoints& points, const MemberPath& path,
               const PredictedFlame& predicted, const AmplitudeTable& table, double phi) {
  PathAnswer answer;
  const std::optional<OperatingLoop> loop = path.At(points, phi);
  if (!loop) return answer;
  answer.has_loop = true;
  answer.frequency_hz = loop->frequency_hz;
  if (loop->flame_slope == 0.0) return answer;
  answer.loop_gain = loop->LoopGain();
  const std::optional<Pole> pole =
      OscillationPole(loop->model.Loop(), loop->flame_slope, loop->frequency_hz);
  if (pole) answer.growth_rate = pole->growth_rate;
  answer.unstable = answer.loop_gain > 1.0;
  if (problem.model.modes == 2) {
    const Range line_hz = LineBand(loop->frequency_hz, problem.model.harmonic_ratio);
    answer.unstable |= LineGain(loop->model, line_hz, loop->flame_slope).value_or(0.0) > 1.0;
  }
  if (answer.loop_gain <= 1.0) {
    answer.amplitude = 0.0;
    return answer;
  }
  const Flame<double> flame = predicted.At(problem.experiments, phi, loop->flame_slope);
  if (const auto relative = table.At(answer.loop_gain)) {
    const double rate = *relative * flame.saturation / std::abs(flame.slope);
    const double p = rate / (kRadPerSPerHz * loop->frequency_hz);
    answer.amplitude = predicted.IsAssumed() ? p / (loop->gain * flame.saturation) : p;
  }
  return answer;
}

PointPrediction Gather(const std::vector<PathAnswer>& answers) {
  PointPrediction point;
  const auto summary = [&](double PathAnswer::*value) {
    std::vector<double> values;
    for (const PathAnswer& answer : answers) values.push_back(answer.*value);
    return Summarise(std::move(values));
  };
  point.frequency_hz = summary(&PathAnswer::frequency_hz);
  point.growth_rate = summary(&PathAnswer::growth_rate);
  point.loop_gain = summary(&PathAnswer::loop_gain);
  point.amplitude = summary(&PathAnswer::amplitude);
  double known = 0.0;
  double unstable = 0.0;
  for (const PathAnswer& answer : answers) {
    ++(answer.has_loop ? point.members : point.without);
    if (!std::isfinite(answer.loop_gain)) continue;
    known += 1.0;
    if (answer.unstable) unstable += 1.0;
  }
  if (known > 0.0) point.share_unstable = unstable / known;
  return point;
}

}  // namespace

SampledValue Summarise(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto quantile = [&](double share) {
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {quantile(0.5), quantile(0.025), quantile(0.975)};
}

bool PredictedFlame::IsAssumed() const {
  return !stated && std::ranges::none_of(measured, [](const auto& fit) { return fit.has_value(); });
}

Flame<double> PredictedFlame::At(std::span<const Experiment> experiments, double phi,
                                 double slope) const {
  Flame<double> flame = stated.value_or(Flame<double>{});
  flame.slope = slope;
  if (stated || IsAssumed()) return flame;
  std::optional<std::size_t> below, above;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!measured[i]) continue;
    const double at = experiments[i].phi;
    if (at <= phi && (!below || at > experiments[*below].phi)) below = i;
    if (at >= phi && (!above || at < experiments[*above].phi)) above = i;
  }
  const std::size_t a = below ? *below : *above;
  const std::size_t b = above ? *above : *below;
  const double step = experiments[b].phi - experiments[a].phi;
  const double share = step > 0.0 ? (phi - experiments[a].phi) / step : 0.0;
  FlameShapeFit fit = share <= 0.5 ? *measured[a] : *measured[b];
  fit.saturation = std::exp((1.0 - share) * std::log(measured[a]->saturation) +
                            share * std::log(measured[b]->saturation));
  return fit.WithSlopeAtRest(slope);
}

std::vector<PointPrediction> PredictPoints(const FamilyProblem& problem,
                                           const OperatingPoints& points,
                                           std::span<const MemberPath> paths,
                                           const PredictedFlame& flame, std::span<const double> phi,
                                           int threads) {
  std::vector<PointPrediction> predictions(phi.size());
  const auto predict = [&](std::size_t k, int inner_threads) {
    PointPrediction& point = predictions[k];
    const auto measured = points.Measured(phi[k]);
    const double at = measured ? points.phi(*measured) : phi[k];
    const PointKind kind = points.KindOf(at);
    if (kind != PointKind::kOutside) {
      const AmplitudeTable table(flame.At(problem.experiments, at, -1.0));
      std::vector<PathAnswer> answers(paths.size());
      RunUnits(paths.size(), inner_threads, [&](std::size_t m) {
        answers[m] = Ask(problem, points, paths[m], flame, table, at);
      });
      point = Gather(answers);
    }
    point.phi = at;
    point.kind = kind;
    point.rests_on_unreliable = points.RestsOnUnreliable(at);
  };
  // Few points share the threads path by path, many point by point.
  constexpr std::size_t kFewPoints = 16;
  if (phi.size() < kFewPoints) {
    for (std::size_t k = 0; k < phi.size(); ++k) predict(k, threads);
  } else {
    RunUnits(phi.size(), threads, [&](std::size_t k) { predict(k, 1); });
  }
  return predictions;
}

std::optional<double> GuaranteedReachHz(const FamilyProblem& problem, double tau_min_s) {
  const double tolerance = problem.test.loop_phase_tolerance_deg;
  if (problem.model.modes != 1 || !(tolerance < 180.0) || !(tau_min_s > 0.0)) return std::nullopt;
  return tolerance / (360.0 * tau_min_s);
}

}  // namespace howl
