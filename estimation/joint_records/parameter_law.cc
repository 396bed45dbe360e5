#include "estimation/joint_records/parameter_law.h"

#include <glog/logging.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

// A parameter's change over one deviation of the operating parameter, and its typical spread about
// that, as shares of the prior's deviation: of what the prior allows, a rig's points show a part.
constexpr double kTrend = 0.3;
constexpr double kTypicalSpread = 0.1;
// Of errors: so small that what a right model's lines tell is kept.
constexpr double kTypicalError = 0.01;
// An error as large as what is foretold says that nothing is: a larger one would make a model of
// its own.
constexpr double kLargestError = 1.0;
constexpr double kPriorDegrees = 1.0;  // of freedom, of s^2
constexpr int kLawIterations = 300;
constexpr double kLawConverged = 1e-4;  // of the largest change of ln s, and of m and b over s

}  // namespace

Eigen::MatrixX2d ParameterLaw::MoveTo(const ParameterLaw& next) const {
  Eigen::MatrixX2d out(mean.size(), 2);
  out << (next.mean - mean).cwiseQuotient(next.spread),
      (next.trend - trend).cwiseQuotient(next.spread);
  return out;
}

ParameterLaw ParameterLaw::Toward(const ParameterLaw& next, const Eigen::VectorXd& share) const {
  ParameterLaw out = next;
  out.mean = mean + share.cwiseProduct(next.mean - mean);
  out.trend = trend + share.cwiseProduct(next.trend - trend);
  out.spread = spread.array() * (next.spread.array() / spread.array()).pow(share.array());
  return out;
}

PointPrior ParameterLaw::PriorAt(double z) const { return {mean + z * trend, spread, {}, {}}; }

PointPrior ParameterLaw::PredictionAt(double z) const {
  PointPrior out = PriorAt(z);
  const Eigen::Vector2d x(1.0, z);
  out.widest.resize(out.deviation.size());
  for (Eigen::Index i = 0; i < out.deviation.size(); ++i) {
    const double of_law = x.dot(covariance[static_cast<std::size_t>(i)] * x);
    out.deviation[i] = std::sqrt(spread[i] * spread[i] + of_law);
    out.widest[i] = std::sqrt(widest[i] * widest[i] + of_law);
  }
  out.degrees = kPriorDegrees + values.array();
  return out;
}

ParameterLaw FitParameterLaw(const std::vector<ParameterEvidence>& points, const PointPrior& base,
                             const std::vector<ErrorGroup>& errors) {
  CHECK(!points.empty());
  const Eigen::Index size = base.mean.size();
  const auto count = static_cast<double>(points.size());
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const ParameterEvidence& point : points) {
    const Eigen::Vector2d x(1.0, point.z);
    moments += x * x.transpose();
  }
  ParameterLaw law{base.mean,
                   Eigen::VectorXd::Zero(size),
                   base.deviation,
                   base.deviation,
                   std::vector<Eigen::Matrix2d>(static_cast<std::size_t>(size)),
                   points.size(),
                   Eigen::VectorXd::Constant(size, count)};
  std::vector<bool> is_error(static_cast<std::size_t>(size), false);
  for (const ErrorGroup& group : errors) {
    for (Eigen::Index i = group.first; i < group.first + group.count; ++i) {
      is_error[static_cast<std::size_t>(i)] = true;
      law.covariance[static_cast<std::size_t>(i)] = Eigen::Matrix2d::Zero();
      law.values[i] = count * static_cast<double>(group.count);
      law.widest[i] = kLargestError;
    }
  }
  for (int iteration = 0; iteration < kLawIterations; ++iteration) {
    // What is expected of each point, given the law.
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
    Eigen::VectorXd sum_z = Eigen::VectorXd::Zero(size);
    std::vector<Eigen::VectorXd> value;
    std::vector<Eigen::VectorXd> variance;
    for (const ParameterEvidence& point : points) {
      const PointPrior prior = law.PriorAt(point.z);
      const Eigen::VectorXd precision = prior.deviation.array().square().inverse();
      Eigen::MatrixXd posterior = point.precision;
      posterior.diagonal() += precision;
      const Eigen::MatrixXd covariance =
          SolveSymmetric(posterior, Eigen::MatrixXd::Identity(size, size));
      value.push_back(covariance * (point.information + precision.cwiseProduct(prior.mean)));
      variance.push_back(covariance.diagonal());
      sum += value.back();
      sum_z += point.z * value.back();
    }
    double change = 0.0;
    for (const ErrorGroup& group : errors) {
      const double typical = kTypicalError * base.deviation[group.first];
      double squares = kPriorDegrees * typical * typical;
      for (std::size_t e = 0; e < points.size(); ++e) {
        squares += variance[e].segment(group.first, group.count).sum() +
                   value[e].segment(group.first, group.count).squaredNorm();
      }
      const double spread =
          std::min(std::sqrt(squares / (law.values[group.first] + kPriorDegrees)), kLargestError);
      change = std::max(change, std::abs(std::log(spread / law.spread[group.first])));
      law.spread.segment(group.first, group.count).setConstant(spread);
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      if (is_error[static_cast<std::size_t>(i)]) continue;
      const double deviation = base.deviation[i];
      const double square = law.spread[i] * law.spread[i];
      Eigen::Matrix2d precision = moments / square;
      precision(0, 0) += 1.0 / (deviation * deviation);
      precision(1, 1) += 1.0 / std::pow(kTrend * deviation, 2);
      const Eigen::Matrix2d covariance = precision.inverse();
      const Eigen::Vector2d law_of_i =
          covariance * Eigen::Vector2d(sum[i] / square + base.mean[i] / (deviation * deviation),
                                       sum_z[i] / square);
      // A spread that stands at its limit stands before mean and trend do.
      change = std::max(
          change, (law_of_i - Eigen::Vector2d(law.mean[i], law.trend[i])).cwiseAbs().maxCoeff() /
                      law.spread[i]);
      law.mean[i] = law_of_i[0];
      law.trend[i] = law_of_i[1];
      law.covariance[static_cast<std::size_t>(i)] = covariance;
      double squares = kPriorDegrees * std::pow(kTypicalSpread * deviation, 2);
      for (std::size_t e = 0; e < points.size(); ++e) {
        const Eigen::Vector2d x(1.0, points[e].z);
        squares +=
            variance[e][i] + x.dot(covariance * x) + std::pow(value[e][i] - law_of_i.dot(x), 2);
      }
      // Points of one rig differ by no more than rigs do: a parameter of which the records tell
      // nothing would else widen its own prior from round to round.
      const double spread = std::min(std::sqrt(squares / (count + kPriorDegrees)), deviation);
      change = std::max(change, std::abs(std::log(spread / law.spread[i])));
      law.spread[i] = spread;
    }
    if (change < kLawConverged) break;
  }
  return law;
}

}  // namespace howl
