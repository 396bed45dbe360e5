#include "estimation/record_fit/starts/point_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/starts/hum_start.h"
#include "estimation/record_fit/starts/path_starts.h"
#include "estimation/record_fit/starts/pole_starts.h"
#include "estimation/record_fit/starts/raise_noise.h"
#include "estimation/record_fit/starts/start_least_squares.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr std::size_t kBestDelays = 3;
constexpr std::size_t kSecondPaths = 3;  // of each of them
constexpr double kRho = 0.2;             // spread of delays
constexpr double kEulersGamma = 0.5772156649015329;
constexpr double kQuiet = 0.1;  // share of bins
constexpr double kWellDamped = 0.1;
// Nats, so that a start's other sources explain the record where they can.
constexpr double kBelowSensors = 4.0;

// The level of white noise of which a record's quietest bins consist.
double QuietLevel(Eigen::VectorXd power) {
  std::ranges::sort(power);
  return std::log(power[static_cast<Eigen::Index>(kQuiet * static_cast<double>(power.size()))] /
                  kQuiet);
}

class Starts {
 public:
  Starts(const RecordSpectra& record, const PointStructure& structure)
      : record_(record), structure_(structure), paths_(record) {}

  // The best delays; where there is a second path, each with the best of those.
  std::vector<FlamePath> Paths() const;
  Eigen::VectorXd At(std::vector<LoopMode> modes, const FlamePath& path) const;

 private:
  Eigen::VectorXd LogSpectrum(const Eigen::VectorXd& power, Eigen::Index terms) const;

  const RecordSpectra& record_;
  const PointStructure& structure_;
  PathStarts paths_;
};

std::vector<FlamePath> Starts::Paths() const {
  std::vector<FlamePath> out;
  for (const double tau : paths_.Delays(kBestDelays)) {
    const FlamePath path{structure_.delay_spread, tau, structure_.HasSpread() ? kRho : 0.0};
    if (!structure_.second_path) {
      out.push_back(path);
      continue;
    }
    for (const SecondPath& second : paths_.SecondPaths(path, kSecondPaths)) {
      out.push_back(path);
      out.back().second = second;
    }
  }
  return out;
}

// The logarithm of a smooth spectrum, from that of bins whose power is exponentially distributed.
Eigen::VectorXd Starts::LogSpectrum(const Eigen::VectorXd& power, Eigen::Index terms) const {
  const Eigen::MatrixXd basis = ChebyshevColumns(record_.position, terms);
  const Eigen::VectorXd values = power.array().max(1e-300).log() + kEulersGamma;
  return SolveSymmetric(basis.transpose() * basis, basis.transpose() * values);
}

Eigen::VectorXd Starts::At(std::vector<LoopMode> modes, const FlamePath& path) const {
  LoopPoint point;
  point.modes = std::move(modes);
  point.path = path;
  point.flame = paths_.Flame(path);
  PointStructure quiet = structure_;
  quiet.noise.clear();
  const LoopResiduals left = ResidualsOf(record_, quiet, point);
  for (const NoiseTerm& term : structure_.noise) {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(term.coefficients);
    switch (term.source) {
      case LoopNoise::kCombustion:
        c = LogSpectrum(left.flame.cwiseAbs2(), term.coefficients);
        break;
      case LoopNoise::kDuct:
        c = LogSpectrum(left.acoustic.cwiseAbs2().cwiseQuotient(left.r.cwiseAbs2()),
                        term.coefficients);
        break;
      case LoopNoise::kPressureSensor:
        c[0] = QuietLevel(left.acoustic.cwiseAbs2());
        break;
      case LoopNoise::kHeatReleaseSensor:
        c[0] = QuietLevel(left.flame.cwiseAbs2());
        break;
      case LoopNoise::kBackground:
      case LoopNoise::kFlameGain:
        c[0] = QuietLevel(left.flame.cwiseAbs2()) - kBelowSensors;
        break;
      case LoopNoise::kPressureHum:
      case LoopNoise::kHeatReleaseHum:
      case LoopNoise::kTone:
        c = HumStart(record_, term, left);
        break;
    }
    point.noise.push_back(c);
  }
  if (HasBackground(structure_.noise)) point.background_ratio = BackgroundOf(record_).ratio;
  RaiseNoise(record_, structure_, &point);
  return ToParameters(structure_, point);
}

}  // namespace

BackgroundStart BackgroundOf(const RecordSpectra& record) {
  const Eigen::VectorXcd p = Tapered(record.pressure);
  const Eigen::VectorXcd q = Tapered(record.heat_release);
  const Eigen::VectorXd smooth_p = SmoothPower(p, kStartReach).cwiseSqrt();
  const Eigen::VectorXd smooth_q = SmoothPower(q, kStartReach).cwiseSqrt();
  const Eigen::ArrayXd coherent = (p.array() * q.conjugate().array()).real();
  const double sign = (coherent / (smooth_p.array() * smooth_q.array())).sum() < 0.0 ? -1.0 : 1.0;
  const double of_p = QuietLevel(p.cwiseAbs2());
  const double of_q = QuietLevel(q.cwiseAbs2());
  return {sign * std::exp(0.5 * (of_p - of_q)), of_q};
}

std::vector<Eigen::VectorXd> StartsOf(const RecordSpectra& record, const PointStructure& structure,
                                      const PointPrior& prior, std::size_t count,
                                      std::uint64_t seed) {
  const Starts starts(record, structure);
  const PoleStarts poles(record, structure);
  const std::vector<FlamePath> paths = starts.Paths();
  std::vector<std::vector<StartPole>> from = {poles.Greedy()};
  if (!structure.ratio) {
    from.push_back(poles.Relocated(poles.Spread()));
    from.push_back(poles.Relocated(from[0]));
  }
  // The cycle's own damping is hidden in closed loop: sharp poles of the grid may be those of the
  // closed loop, and better damped ones lead to the open loop's.
  from.push_back(from[0]);
  for (StartPole& pole : from.back()) pole.xi = kWellDamped;
  RandomStream random(seed);
  while (from.size() * paths.size() < count) from.push_back(poles.Drawn(&random));
  std::vector<Eigen::VectorXd> out;
  for (const std::vector<StartPole>& each : from) {
    for (const FlamePath& path : paths) {
      out.push_back(prior.Within(starts.At(poles.WithResidues(each), path)));
    }
  }
  return out;
}

}  // namespace howl
