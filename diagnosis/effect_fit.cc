#include "diagnosis/effect_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/cut_noise.h"
#include "diagnosis/fitter.h"

namespace howl {
namespace {

constexpr int kFirstRoundIterations = 7;
constexpr int kLaterRoundIterations = 8;
constexpr int kRounds = 3;
constexpr std::size_t kStartsKept = 2;
constexpr std::size_t kScannedStarts = 3;
constexpr Eigen::Index kSlopeStride = 7;

class NoEffect final : public NamedEffect {
 public:
  NoEffect() : NamedEffect("none", LoopBlock::kAcoustics, {}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
};

std::vector<FlameColumns> BaseColumns(const std::vector<CutRecord>& records) {
  std::vector<FlameColumns> columns;
  const NoEffect none;
  for (const CutRecord& record : records) {
    columns.push_back(MakeFlameColumns(record, none, {}, 0.0));
  }
  return columns;
}

// The lower median: where a higher mode takes over, its cycles are not the delay's.
double TypicalCycle(const std::vector<CutRecord>& records) {
  std::vector<double> cycles_hz;
  for (const CutRecord& record : records) cycles_hz.push_back(record.at.cycle_frequency_hz);
  const auto middle = cycles_hz.begin() + static_cast<std::ptrdiff_t>((cycles_hz.size() - 1) / 2);
  std::nth_element(cycles_hz.begin(), middle, cycles_hz.end());
  return *middle;
}

// The correlation of Phi(v) with v, over samples far enough apart to be a cycle's fractions.
double SlopeSign(const FlameColumns& columns, const Eigen::VectorXd& coefficients) {
  const Eigen::Index count = columns.v.size() / kSlopeStride;
  const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>(
      columns.v.data(), count, Eigen::InnerStride<>(kSlopeStride));
  const Eigen::VectorXd phi = FlameBasis(columns.range).Value(v, coefficients);
  const Eigen::VectorXd dv = v.array() - v.mean();
  const Eigen::VectorXd dphi = phi.array() - phi.mean();
  return dv.dot(dphi) / std::max(dv.norm() * dphi.norm(), 1e-300);
}

// The delay by which Phi(v) explains q best, on a grid that no resonance of the objective escapes.
double StartDelay(const std::vector<CutRecord>& records, const std::vector<FlameColumns>& columns) {
  const NoEffect none;
  if (records[0].reference.flame.size() > 0) return records[0].reference.tau_s;
  const double f0 = TypicalCycle(records);
  const double high_hz = records[0].frequency(records[0].flame_count - 1);
  const double step = 0.12 / high_hz;
  double best = std::numeric_limits<double>::infinity();
  double best_tau = 0.0;
  const auto count = static_cast<int>(std::ceil(1.5 / f0 / step));
  for (int i = 0; i < count; ++i) {
    const double tau = 0.1 / f0 + i * step;
    double cost = 0.0;
    double falling = 0.0;
    for (std::size_t e = 0; e < records.size(); e += std::max<std::size_t>(records.size() / 2, 1)) {
      const Eigen::VectorXd weight =
          FlameWeights(records[e], Eigen::VectorXd::Ones(records[e].flame_count));
      const FlameSolution solution = SolveFlame(records[e], none, {}, tau, columns[e], weight);
      cost += std::log(solution.residual.cwiseAbs2().dot(weight));
      falling -= SlopeSign(columns[e], solution.coefficients);
    }
    // Half a period away a rising flame fits nearly as well; heat release falls as v rises.
    if (falling <= 0.0) continue;
    if (cost < best) {
      best = cost;
      best_tau = tau;
    }
  }
  return best_tau;
}

// A lag that the effect adds moves tau the other way.
double CorrectedDelay(const std::vector<CutRecord>& records, const Effect& effect, EffectValues x,
                      double tau_s) {
  double factor = 0.0;
  for (const CutRecord& record : records) {
    factor += effect.DelayFactor(record.at, x) / static_cast<double>(records.size());
  }
  const EffectContext& at = records[0].at;
  const double f0 = at.cycle_frequency_hz;
  const Response added = effect.HeatReleaseInstrument(f0, x) * effect.FlameOut(f0, x) *
                         effect.FlameIn(f0, at, x) / effect.PressureInstrument(f0, x);
  return std::max((tau_s + std::arg(added) / (kRadPerSPerHz * f0)) / factor, 0.0);
}

// All combinations of the parameters' starts, the first ones as `first` has them.
std::vector<std::vector<double>> StartValues(const Effect& effect,
                                             const std::vector<double>& first) {
  std::vector<std::vector<double>> starts = {first};
  for (std::size_t j = first.size(); j < effect.parameters().size(); ++j) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& start : starts) {
      for (const double value : effect.parameters()[j].starts) {
        longer.push_back(start);
        longer.back().push_back(value);
      }
    }
    starts = std::move(longer);
  }
  return starts;
}

// Where a weak effect would take off most: of the scanned values the best few that are no
// neighbours, with the next parameter at its best.
std::vector<std::vector<double>> ScannedStarts(const EffectPointer& effect, const EffectFit& base,
                                               Fitter* fitter) {
  const std::vector<EffectParameter>& parameters = effect->parameters();
  const auto scanned = std::find_if(parameters.begin(), parameters.end(),
                                    [](const EffectParameter& p) { return !p.scan.empty(); });
  if (scanned == parameters.end()) return {};
  const auto at = static_cast<std::size_t>(scanned - parameters.begin());
  struct Found {
    std::vector<double> values;
    double gain;
  };
  std::vector<Found> all;
  fitter->SetNoise(base);
  for (const double value : scanned->scan) {
    EffectFit fit = base;
    fit.effect = effect;
    fit.values.clear();
    for (const EffectParameter& p : parameters) fit.values.push_back(p.starts.front());
    fit.values[at] = value;
    fit.values[at + 1] = parameters[at + 1].null_value;
    const Fitter::Score score = fitter->ScoreOf(&fit, at + 1);
    fit.values[at + 1] = std::clamp(score.value, parameters[at + 1].low, parameters[at + 1].high);
    all.push_back({fit.values, score.gain});
  }
  std::vector<Found> peaks;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool over_last = i == 0 || all[i].gain >= all[i - 1].gain;
    const bool over_next = i + 1 == all.size() || all[i].gain > all[i + 1].gain;
    if (over_last && over_next) peaks.push_back(all[i]);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Found& a, const Found& b) { return a.gain > b.gain; });
  std::vector<std::vector<double>> starts;
  for (std::size_t i = 0; i < std::min(peaks.size(), kScannedStarts); ++i) {
    starts.push_back(peaks[i].values);
  }
  return starts;
}

}  // namespace

EffectPointer BaseEffect() {
  static const EffectPointer base = std::make_shared<NoEffect>();
  return base;
}

EffectFit FitBase(const std::vector<CutRecord>& records) {
  EffectFit fit;
  fit.effect = BaseEffect();
  const std::vector<FlameColumns> columns = BaseColumns(records);
  fit.tau_s = StartDelay(records, columns);
  fit.experiments.resize(records.size());
  for (std::size_t e = 0; e < records.size(); ++e) {
    ExperimentFit& at = fit.experiments[e];
    at.acoustics = AcousticStarts(records[e], *fit.effect, {}, 1)[0];
    at.acoustic_noise = Eigen::VectorXd::Ones(records[e].acoustic_count);
    at.flame_noise = Eigen::VectorXd::Ones(records[e].flame_count);
  }
  Fitter fitter(records, *fit.effect, &columns);
  fitter.SetNoise(fit);
  for (int round = 0; round <= kRounds; ++round) {
    fitter.Descend(&fit, kLaterRoundIterations);
    fitter.RefitNoise(&fit);
    if (round == 1) fitter.RestartLocals(&fit);
  }
  fitter.Finish(&fit, nullptr);
  return fit;
}

namespace {

EffectFit FitFrom(const std::vector<CutRecord>& records, const EffectPointer& effect,
                  const EffectFit& base, std::vector<std::vector<double>> starts, bool scan) {
  const std::vector<FlameColumns> columns =
      effect->ChangesFlameCut() ? BaseColumns(records) : std::vector<FlameColumns>(records.size());
  Fitter fitter(records, *effect, &columns);
  // Found beside the base: nothing else needs to move first.
  const std::size_t on_the_grid = starts.size();
  if (scan) {
    for (std::vector<double>& start : ScannedStarts(effect, base, &fitter)) {
      starts.push_back(std::move(start));
    }
  }
  std::vector<EffectFit> candidates;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::vector<double>& values = starts[i];
    EffectFit fit = base;
    fit.effect = effect;
    fit.values = values;
    if (effect->ChangesFlameCut()) {
      fit.tau_s = CorrectedDelay(records, *effect, values, base.tau_s);
    }
    if (effect->ChangesAcousticCut() && i < on_the_grid) {
      for (std::size_t e = 0; e < records.size(); ++e) {
        fit.experiments[e].acoustics = AcousticStarts(records[e], *effect, values, 1)[0];
      }
    }
    fitter.SetNoise(fit);
    fitter.Descend(&fit, kFirstRoundIterations);
    fitter.RefitNoise(&fit);
    candidates.push_back(std::move(fit));
    std::sort(candidates.begin(), candidates.end(),
              [](const EffectFit& a, const EffectFit& b) { return a.cost() < b.cost(); });
    if (candidates.size() > kStartsKept) candidates.pop_back();
  }
  for (EffectFit& fit : candidates) {
    fitter.SetNoise(fit);
    if (fitter.RestartLocals(&fit)) fitter.RefitNoise(&fit);
    for (int round = 1; round < kRounds; ++round) {
      fitter.Descend(&fit, kLaterRoundIterations);
      fitter.RefitNoise(&fit);
    }
  }
  EffectFit best =
      *std::min_element(candidates.begin(), candidates.end(),
                        [](const EffectFit& a, const EffectFit& b) { return a.cost() < b.cost(); });
  fitter.SetNoise(best);
  fitter.Finish(&best, &base);
  return best;
}

}  // namespace

EffectFit FitEffect(const std::vector<CutRecord>& records, const EffectPointer& effect,
                    const EffectFit& base) {
  return FitFrom(records, effect, base, StartValues(*effect, {}), true);
}

EffectFit FitFurther(const std::vector<CutRecord>& records, const EffectPointer& combined,
                     const EffectFit& base, const EffectFit& first) {
  return FitFrom(records, combined, base, StartValues(*combined, first.values), false);
}

namespace {

// Where the others leave the shared parameters loose, what they predict is loose too: under the
// covariance V + J C J', C being that of the parameters from the others,
//
//   r' (V + J C J')^-1 r = min over d of |r - J d|^2 / V + d' C^-1 d.
//
// The minimum is the fit to all; the way to it costs shift' rest shift. The part of the shift that
// costs the held-out experiment as much.
double Contradiction(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& own,
                     const Eigen::VectorXd& shift) {
  const double to_the_rest = shift.dot(rest * shift);
  const double to_the_own = shift.dot(own * shift);
  return to_the_own > to_the_rest ? std::sqrt(std::max(to_the_rest, 0.0) / to_the_own) : 1.0;
}

}  // namespace

ExperimentFit HeldOut(const std::vector<CutRecord>& records, const EffectFit& fit,
                      std::size_t experiment) {
  EffectFit moved = fit;
  const Eigen::Index d = fit.experiments[0].gradient.size();
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(d, d);
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (e != experiment) rest += fit.experiments[e].curvature;
  }
  const Eigen::VectorXd scale = rest.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * rest * scale.asDiagonal();
  scaled.diagonal().array() += 1e-6;
  Eigen::VectorXd shift = scale.cwiseProduct(
      scaled.ldlt().solve(scale.cwiseProduct(fit.experiments[experiment].gradient)));
  shift *= Contradiction(rest, fit.experiments[experiment].curvature, shift);
  moved.tau_s += shift[0];
  for (std::size_t j = 0; j < fit.values.size(); ++j) {
    const EffectParameter& p = fit.effect->parameters()[j];
    const double by = shift[static_cast<Eigen::Index>(j) + 1];
    double& x = moved.values[j];
    x = p.scale == ParameterScale::kLogarithmic ? x * std::exp(std::clamp(by, -1.0, 1.0)) : x + by;
    x = std::clamp(x, p.low, p.high);
  }
  Fitter fitter(records, *fit.effect, nullptr);
  fitter.SetNoise(moved);
  // Its own parameters, in all cuts that the effect or the moved delay reach.
  fitter.DescendLocals(&moved, experiment);
  return moved.experiments[experiment];
}

}  // namespace howl
