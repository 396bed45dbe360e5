#include "diagnosis/fit/fit_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/noise/cut_noise.h"

namespace howl {
namespace {

constexpr std::size_t kScannedStarts = 3;
constexpr Eigen::Index kSlopeStride = 7;

// The lower median, because the cycles of operating points where a higher mode takes over do not
// tell the delay.
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

}  // namespace

std::vector<FlameColumns> BaseColumns(const std::vector<CutRecord>& records) {
  std::vector<FlameColumns> columns;
  const Effect& none = *BaseEffect();
  for (const CutRecord& record : records) {
    columns.push_back(MakeFlameColumns(record, none, {}, 0.0));
  }
  return columns;
}

double StartDelay(const std::vector<CutRecord>& records, const std::vector<FlameColumns>& columns) {
  const Effect& none = *BaseEffect();
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
    // Half a period away a rising characteristic fits nearly as well, but heat release falls as v
    // rises.
    if (falling <= 0.0) continue;
    if (cost < best) {
      best = cost;
      best_tau = tau;
    }
  }
  return best_tau;
}

double CorrectedDelay(const std::vector<EffectContext>& points, const Effect& effect,
                      EffectValues x, double tau_s) {
  double factor = 0.0;
  for (const EffectContext& point : points) {
    factor += effect.DelayFactor(point, x) / static_cast<double>(points.size());
  }
  const EffectContext& at = points[0];
  const double f0 = at.cycle_frequency_hz;
  const Response added = effect.HeatReleaseInstrument(f0, x) * effect.FlameOut(f0, at, x) *
                         effect.FlameIn(f0, at, x) / effect.PressureInstrument(f0, x);
  return std::max((tau_s + std::arg(added) / (kRadPerSPerHz * f0)) / factor, 0.0);
}

StartList StartValues(const Effect& effect, const std::vector<double>& first) {
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

StartList ScannedStarts(const EffectPointer& effect, const EffectFit& base, Fitter* fitter) {
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

}  // namespace howl
