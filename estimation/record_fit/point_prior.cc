#include "estimation/record_fit/point_prior.h"

#include <cmath>
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
// Half a period of the cycle, within a factor of three.
constexpr double kMeanTau = std::numbers::pi;
constexpr double kLogTau = 1.1;
constexpr double kFlame = 3.0;  // of recorded q's mean square
constexpr double kLevel = 3.0;  // of ln S_j, about the signal's mean
constexpr double kShape = 1.5;  // of its higher coefficients

double MeanLogPower(const Eigen::VectorXcd& x) {
  return Tapered(x).cwiseAbs2().array().log().mean();
}

}  // namespace

double PointPrior::LogDensity(const Eigen::VectorXd& parameters) const {
  const Eigen::VectorXd z = (parameters - mean).cwiseQuotient(deviation);
  return -0.5 * z.squaredNorm() - deviation.array().log().sum() -
         0.5 * static_cast<double>(z.size()) * std::log(2.0 * std::numbers::pi);
}

PointPrior PriorOf(const PointStructure& structure, const RecordSpectra& record) {
  const Eigen::Index flame = record.flame.cols();
  const Eigen::Index size = structure.Delay() + 1 + flame + structure.NoiseCoefficients();
  PointPrior out{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size)};
  Eigen::Index next = 0;
  const auto add = [&](Eigen::Index count, double mean, double deviation) {
    out.mean.segment(next, count).setConstant(mean);
    out.deviation.segment(next, count).setConstant(deviation);
    next += count;
  };
  add(structure.Frequencies(), kMeanLogOmega, kLogOmega);
  add(structure.Dampings(), kMeanLogXi, kLogXi);
  add(structure.Residues(), 0.0, kResidue);
  add(1, std::log(kMeanTau), kLogTau);
  const double bins = static_cast<double>(record.bins());
  add(flame, 0.0, kFlame * std::sqrt(Tapered(record.heat_release).squaredNorm() / bins));
  for (const NoiseTerm& term : structure.noise) {
    const bool of_p = term.source == LoopNoise::kPressureSensor;
    add(1, MeanLogPower(of_p ? record.pressure : record.heat_release), kLevel);
    add(term.coefficients - 1, 0.0, kShape);
  }
  return out;
}

}  // namespace howl
