#include "estimation/record_fit/point_fit.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "estimation/record_fit/return_difference.h"

namespace howl {
namespace {

constexpr double kFirstDamping = 0.1;
constexpr double kMostDamping = 1e12;
constexpr double kNear = 20.0;  // nats foretold, from which on the curvature is used
constexpr std::size_t kMostToFinish = 4;
constexpr double kDifference = 1e-5;  // of the prior's deviation

double Value(const RecordSpectra& record, const PointStructure& structure, const PointPrior& prior,
             const Eigen::VectorXd& parameters) {
  if (!parameters.allFinite()) return -std::numeric_limits<double>::infinity();
  return LogLikelihood(record, structure, parameters) + prior.LogDensity(parameters);
}

struct Quadratic {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

// In units of the prior's deviations.
Eigen::VectorXd Gradient(const RecordSpectra& record, const PointStructure& structure,
                         const PointPrior& prior, const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  const Eigen::VectorXd gradient =
      WhittleGradient(structure.noise, record.share, ResidualsOf(record, structure, point),
                      DerivativesOf(record, structure, point)) +
      LogDeterminantGradient(record, structure, point);
  return prior.deviation.cwiseProduct(gradient) -
         (parameters - prior.mean).cwiseQuotient(prior.deviation);
}

Quadratic Expand(const RecordSpectra& record, const PointStructure& structure,
                 const PointPrior& prior, const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  const LoopScore score =
      WhittleScore(structure.noise, record.share, ResidualsOf(record, structure, point),
                   DerivativesOf(record, structure, point));
  Quadratic out;
  const auto scale = prior.deviation.asDiagonal();
  out.gradient = scale * (score.gradient + LogDeterminantGradient(record, structure, point)) -
                 (parameters - prior.mean).cwiseQuotient(prior.deviation);
  out.information = scale * score.information * scale;
  out.information.diagonal().array() += 1.0;
  return out;
}

// The curvature itself, by differences of the gradient. Where the model misses what the record
// shows it differs from the information, and steps on the latter come near the maximum slowly.
Eigen::MatrixXd Curvature(const RecordSpectra& record, const PointStructure& structure,
                          const PointPrior& prior, const Eigen::VectorXd& parameters) {
  const Eigen::Index size = parameters.size();
  const auto gradient = [&](Eigen::Index i, double step) {
    Eigen::VectorXd moved = parameters;
    moved[i] += step * prior.deviation[i];
    return Gradient(record, structure, prior, moved);
  };
  Eigen::MatrixXd out(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    out.col(i) = (gradient(i, -kDifference) - gradient(i, kDifference)) / (2.0 * kDifference);
  }
  return 0.5 * (out + out.transpose());
}

// Far from the maximum the record's share may leave the information without a sign: the steps then
// take the size of its curvature, as Greenstadt's modified Newton steps do. What has less than the
// prior tells has that.
void MakePositive(Eigen::MatrixXd* information) {
  const Eigen::VectorXd scale = information->diagonal().cwiseMax(1.0).cwiseSqrt();
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * *information *
                                                              inverse.asDiagonal());
  if (solver.eigenvalues()[0] > 1e-9) return;
  *information = scale.asDiagonal() * solver.eigenvectors() *
                 solver.eigenvalues().cwiseAbs().cwiseMax(1e-6).asDiagonal() *
                 solver.eigenvectors().transpose() * scale.asDiagonal();
}

Quadratic Around(const RecordSpectra& record, const PointStructure& structure,
                 const PointPrior& prior, const Eigen::VectorXd& parameters, bool near) {
  Quadratic out = near ? Quadratic{Gradient(record, structure, prior, parameters),
                                   Curvature(record, structure, prior, parameters)}
                       : Expand(record, structure, prior, parameters);
  MakePositive(&out.information);
  return out;
}

}  // namespace

Eigen::MatrixXd PointFit::Covariance() const {
  return information.ldlt().solve(
      Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

double LogLikelihood(const RecordSpectra& record, const PointStructure& structure,
                     const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  return WhittleLogLikelihood(structure.noise, record.share,
                              ResidualsOf(record, structure, point)) +
         LogDeterminant(record, point);
}

PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, Eigen::VectorXd start, const PointFitOptions& options) {
  PointFit out;
  out.parameters = std::move(start);
  out.log_posterior = Value(record, structure, prior, out.parameters);
  double damping = kFirstDamping;
  double raise = 2.0;
  bool near = false;
  Quadratic here = Around(record, structure, prior, out.parameters, near);
  while (out.iterations < options.iterations && damping < kMostDamping) {
    ++out.iterations;
    Eigen::MatrixXd damped = here.information;
    damped.diagonal().array() *= 1.0 + damping;
    const Eigen::VectorXd step = damped.ldlt().solve(here.gradient);
    const double foretold = here.gradient.dot(step) - 0.5 * step.dot(here.information * step);
    const Eigen::VectorXd there = out.parameters + step.cwiseProduct(prior.deviation);
    const double value = Value(record, structure, prior, there);
    const double ratio = (value - out.log_posterior) / foretold;
    // A fit that only comes near needs no curvature.
    const bool exact = near || options.converged >= kNear;
    if (exact && damping < 1.0 && foretold < options.converged) {
      out.converged = true;
      break;
    }
    if (!(ratio > 0.0)) {
      damping *= raise;
      raise *= 2.0;
      continue;
    }
    out.parameters = there;
    out.log_posterior = value;
    damping *= std::max(1.0 / 5.0, 1.0 - std::pow(2.0 * ratio - 1.0, 3.0));
    raise = 2.0;
    near = near || foretold < kNear;
    here = Around(record, structure, prior, out.parameters, near);
  }
  out.log_likelihood = out.log_posterior - prior.LogDensity(out.parameters);
  const Eigen::VectorXd precision = prior.deviation.cwiseInverse();
  out.information = precision.asDiagonal() * here.information * precision.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> root(here.information);
  out.log_evidence = out.log_posterior - root.matrixLLT().diagonal().array().log().sum() +
                     prior.deviation.array().log().sum() +
                     0.5 * static_cast<double>(precision.size()) * std::log(2.0 * std::numbers::pi);
  return out;
}

PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const std::vector<Eigen::VectorXd>& starts,
                  const PointFitOptions& options) {
  CHECK(!starts.empty());
  PointFitOptions rough = options;
  rough.converged = kNear;
  std::vector<PointFit> fits;
  for (const Eigen::VectorXd& start : starts) {
    fits.push_back(FitPoint(record, structure, prior, start, rough));
  }
  std::ranges::stable_sort(fits, std::ranges::greater(), &PointFit::log_posterior);
  fits.resize(std::min(fits.size(), kMostToFinish));
  PointFit best;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    PointFit fit = FitPoint(record, structure, prior, fits[i].parameters, options);
    if (i == 0 || fit.log_posterior > best.log_posterior) best = std::move(fit);
  }
  return best;
}

}  // namespace howl
