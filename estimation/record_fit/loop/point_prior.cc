#include "estimation/record_fit/loop/point_prior.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace howl {
namespace {

// The band is four wide in ln f, and its middle is near the cycle.
constexpr double kMeanLogOmega = 0.0;
constexpr double kLogOmega = 1.1;
// Ducts' modes have dampings of 0.01 to 0.2.
constexpr double kMeanLogXi = -3.0;
constexpr double kLogXi = 1.5;
// A mode of damping 0.05 and residue 1 makes a peak of ten times the ratio of p to q.
constexpr double kResidue = 1.0;
// At the record's ends a mode holds as much as p shows, and up to a few times as much.
constexpr double kHeld = 3.0;
// From a tenth of the delay to as much as the delay.
constexpr double kMeanLogRho = -1.2;
constexpr double kLogRho = 0.8;
// Two paths that answer alike, and up to twice as strongly against one another.
constexpr double kSecondShare = 1.0;
// Where a search begins: its size is estimated (parameter_law.h).
constexpr double kLineError = 0.3;
// Where R is 1 at the cycle, as in these units it about is, k is what damping gains over what it
// is, or what a frequency moves by over the damping; r is in radians of the cycle. Lags whose sum
// comes near another memory have coefficients a few times as large, of both signs.
constexpr double kAcousticChange = 2.0;
constexpr double kFlameChange = 0.5;
constexpr double kLevel = 3.0;  // of ln S_j, about the signal's mean
constexpr double kShape = 1.5;  // of its higher coefficients
// Of what a multiple of the mains' has over others: a factor of seven of the amplitude, either way.
constexpr double kMultiple = 4.0;
// Amplifiers are set so that p and q fill their ranges alike.
constexpr double kBackgroundRatio = 1.0;
constexpr double kMostDeviations = 6.0;

double MeanLogPower(const Eigen::VectorXcd& x) {
  return Tapered(x).cwiseAbs2().array().log().mean();
}

// std::lgamma writes the sign where every thread does.
double LogGamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace

double PointPrior::LogDensity(const Eigen::VectorXd& parameters) const {
  const Eigen::VectorXd z = (parameters - mean).cwiseQuotient(deviation);
  double sum = -deviation.array().log().sum();
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const double n = degrees.size() > 0 ? degrees[i] : std::numeric_limits<double>::infinity();
    if (std::isfinite(n)) {
      const double least = LeastPrecision(i);
      const double end = least > 0.0 ? (n + 1.0) / least - n : z[i] * z[i];  // of z^2
      const double square = std::min(z[i] * z[i], end);
      sum += LogGamma(0.5 * (n + 1.0)) - LogGamma(0.5 * n) - 0.5 * std::log(n * std::numbers::pi) -
             0.5 * (n + 1.0) * std::log1p(square / n) - 0.5 * least * (z[i] * z[i] - square);
    } else {
      sum -= 0.5 * (z[i] * z[i] + std::log(2.0 * std::numbers::pi));
    }
  }
  return sum;
}

Eigen::VectorXd PointPrior::Precision(const Eigen::VectorXd& parameters) const {
  Eigen::VectorXd out = Eigen::VectorXd::Ones(mean.size());
  if (degrees.size() == 0) return out;
  const Eigen::VectorXd z = (parameters - mean).cwiseQuotient(deviation);
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (!std::isfinite(degrees[i])) continue;
    out[i] = std::max((degrees[i] + 1.0) / (degrees[i] + z[i] * z[i]), LeastPrecision(i));
  }
  return out;
}

Eigen::VectorXd PointPrior::Slope(const Eigen::VectorXd& parameters) const {
  return -Precision(parameters).cwiseProduct((parameters - mean).cwiseQuotient(deviation));
}

Eigen::VectorXd PointPrior::Within(const Eigen::VectorXd& parameters) const {
  Eigen::VectorXd reach = kMostDeviations * deviation;
  for (Eigen::Index i = 0; i < degrees.size(); ++i) {
    // Where Student's density has fallen as far.
    const double n = degrees[i];
    if (!std::isfinite(n)) continue;
    reach[i] =
        deviation[i] * std::sqrt(n * std::expm1(kMostDeviations * kMostDeviations / (n + 1.0)));
    if (widest.size() > 0) reach[i] = std::min(reach[i], kMostDeviations * widest[i]);
  }
  return parameters.cwiseMax(mean - reach).cwiseMin(mean + reach);
}

PointPrior PointPrior::NormalAt(const Eigen::VectorXd& parameters) const {
  return {mean, deviation.cwiseQuotient(Precision(parameters).cwiseSqrt()), {}, {}};
}

PointPrior PriorOf(const PointStructure& structure, const RecordSpectra& record) {
  const Eigen::Index flame = record.flame.cols();
  const Eigen::Index size = structure.Parameters(flame);
  PointPrior out{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size), {}, {}};
  Eigen::Index next = 0;
  const auto add = [&](Eigen::Index count, double mean, double deviation) {
    out.mean.segment(next, count).setConstant(mean);
    out.deviation.segment(next, count).setConstant(deviation);
    next += count;
  };
  add(structure.Frequencies(), kMeanLogOmega, kLogOmega);
  add(structure.Dampings(), kMeanLogXi, kLogXi);
  add(structure.Residues(), 0.0, kResidue);
  add(structure.Transients(), 0.0, kHeld * record.OneSample());
  add(structure.AcousticLines(), 0.0, kLineError);
  add(structure.AcousticChanges(), 0.0, kAcousticChange);
  add(1, std::log(kMeanTau), kLogTau);
  if (structure.HasSpread()) add(1, kMeanLogRho, kLogRho);
  if (structure.second_path) {
    add(1, 0.0, kSecondShare);
    add(1, std::log(kMeanTau), kLogTau);
  }
  out.deviation.segment(next, flame) = record.scale.flame_deviation;
  next += flame;
  add(structure.FlameLines(), 0.0, kLineError);
  add(structure.FlameChanges(), 0.0, kFlameChange);
  for (const NoiseTerm& term : structure.noise) {
    add(1, MeanLogPower(IsOfPressure(term.source) ? record.pressure : record.heat_release), kLevel);
    add(term.coefficients - 1, 0.0, IsHum(term.source) ? kMultiple : kShape);
  }
  if (HasBackground(structure.noise)) add(1, 0.0, kBackgroundRatio);
  return out;
}

}  // namespace howl
