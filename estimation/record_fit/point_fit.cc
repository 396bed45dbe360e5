#include "estimation/record_fit/point_fit.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "estimation/record_fit/loop/point_likelihood.h"
#include "estimation/record_fit/loop/return_difference.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr double kFirstDamping = 0.1;
constexpr double kMostDamping = 1e12;
// Of a parameter, in deviations of what it may be on any rig (point_prior.h): from a start far from
// any maximum a quadratic may point to where no rig is, and the likelihood be flat.
constexpr double kLongestStep = 3.0;
constexpr double kNear = 20.0;  // nats foretold, from which on steps correct the information
constexpr int kMostCorrections = 12;
constexpr double kLeastCosine =
    1e-8;  // of a correction's denominator (Nocedal & Wright 2006, 6.26)
constexpr std::size_t kMostToCompare = 4;
constexpr int kIterationsToCompare = 30;
constexpr double kSameDelay = 0.03;  // of a path's parameters
constexpr std::size_t kMostDelays = 3;
constexpr double kDifference = 1e-5;  // of the prior's deviation
constexpr double kAboveLeast = 1.02;  // of delays that fits begin with
constexpr int kMostHalvings = 20;     // of a start's flame

struct Quadratic {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

// The log posterior in units of the prior's deviations.
class Posterior {
 public:
  Posterior(const RecordSpectra& record, const PointStructure& structure, const PointPrior& prior)
      : likelihood_(record, structure), prior_(prior) {}

  double Value(const Eigen::VectorXd& parameters) {
    const double value = likelihood_.Value(parameters);
    return std::isfinite(value) ? value + prior_.LogDensity(parameters) : value;
  }

  Eigen::VectorXd Gradient(const Eigen::VectorXd& parameters) {
    return prior_.deviation.cwiseProduct(likelihood_.Gradient(parameters)) +
           prior_.Slope(parameters);
  }

  Quadratic Expand(const Eigen::VectorXd& parameters) {
    return {Gradient(parameters), Information(parameters)};
  }

  Eigen::MatrixXd Information(const Eigen::VectorXd& parameters) {
    const auto scale = prior_.deviation.asDiagonal();
    Eigen::MatrixXd out = scale * likelihood_.Information(parameters) * scale;
    out.diagonal() += prior_.Precision(parameters);
    return out;
  }

  // The curvature itself, by differences of the gradient. Where the model misses what the record
  // shows it differs from the information, and steps on the latter come near the maximum slowly.
  Eigen::MatrixXd Curvature(const Eigen::VectorXd& parameters) {
    const Eigen::Index size = parameters.size();
    const auto gradient = [&](Eigen::Index i, double step) {
      Eigen::VectorXd moved = parameters;
      moved[i] += step * prior_.deviation[i];
      return Gradient(moved);
    };
    Eigen::MatrixXd out(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      out.col(i) = (gradient(i, -kDifference) - gradient(i, kDifference)) / (2.0 * kDifference);
    }
    return 0.5 * (out + out.transpose());
  }

 private:
  PointLikelihood likelihood_;
  const PointPrior& prior_;
};

// Far from the maximum the record's share may leave the information without a sign: the steps then
// take the size of its curvature, as Greenstadt's modified Newton steps do. What has less than the
// prior tells has that.
Eigen::MatrixXd Positive(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1.0).cwiseSqrt();
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const SymmetricEigen eigen =
      EigenOfSymmetric(inverse.asDiagonal() * information * inverse.asDiagonal());
  if (eigen.values[0] > 1e-9) return information;
  return scale.asDiagonal() * eigen.vectors * eigen.values.cwiseAbs().cwiseMax(1e-6).asDiagonal() *
         eigen.vectors.transpose() * scale.asDiagonal();
}

// The symmetric update of rank one (SR1): what a step has shown of the curvature along it, at the
// cost of one gradient. It need not have a sign, which the curvature has not either.
void CorrectAlong(const Eigen::VectorXd& step, const Eigen::VectorXd& fall_of_gradient,
                  Eigen::MatrixXd* information) {
  const Eigen::VectorXd missed = fall_of_gradient - *information * step;
  const double along = missed.dot(step);
  if (std::abs(along) < kLeastCosine * missed.norm() * step.norm()) return;
  *information += missed * missed.transpose() / along;
}

// The best acoustics with each other delay and flame that a fit has come to: the two cuts depend on
// one another little, so that the best of each may have begun apart.
std::vector<Eigen::VectorXd> OtherDelays(const PointStructure& structure,
                                         const Eigen::VectorXd& best,
                                         const std::vector<PointFit>& fits) {
  const auto path_of = [&](const Eigen::VectorXd& parameters) {
    return parameters.segment(structure.Delay(), structure.Delays()).eval();
  };
  std::vector<Eigen::VectorXd> known = {path_of(best)};
  std::vector<Eigen::VectorXd> out;
  for (const PointFit& fit : fits) {
    const Eigen::VectorXd path = path_of(fit.parameters);
    const auto same = [&](const Eigen::VectorXd& other) {
      return (other - path).cwiseAbs().maxCoeff() < kSameDelay;
    };
    if (std::ranges::any_of(known, same)) continue;
    if (out.size() == kMostDelays) break;
    known.push_back(path);
    Eigen::VectorXd crossed = best;
    const Eigen::Index flame = best.size() - structure.Delay() - structure.NoiseParameters();
    crossed.segment(structure.Delay(), flame) = fit.parameters.segment(structure.Delay(), flame);
    out.push_back(std::move(crossed));
  }
  return out;
}

// With a delay that the band tells, and so weak a flame that the loop is a possible one.
Eigen::VectorXd Possible(const RecordSpectra& record, const PointStructure& structure,
                         Eigen::VectorXd parameters) {
  const Eigen::Index flame = record.flame.cols();
  double& log_tau = parameters[structure.Delay()];
  log_tau = std::max(log_tau, std::log(kAboveLeast * LeastDelay(record)));
  for (int i = 0; i < kMostHalvings; ++i) {
    if (std::isfinite(LogDeterminant(record, ToPoint(structure, flame, parameters)))) break;
    parameters.segment(structure.Flame(), flame) *= 0.5;
  }
  return parameters;
}

// Of a start from which no step leads on: a fit that any other is better than.
PointFit NothingTold(const PointPrior& prior, Eigen::VectorXd parameters) {
  PointFit out;
  out.parameters = std::move(parameters);
  out.log_likelihood = out.log_posterior = out.log_evidence =
      -std::numeric_limits<double>::infinity();
  out.information = prior.deviation.array().square().inverse().matrix().asDiagonal();
  return out;
}

// What the quadratic about the present parameters consists of.
enum class Source : std::uint8_t { kInformation, kCorrected, kCurvature };

}  // namespace

Eigen::MatrixXd PointFit::Covariance() const {
  return SolveSymmetric(information,
                        Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

double LogLikelihood(const RecordSpectra& record, const PointStructure& structure,
                     const Eigen::VectorXd& parameters) {
  return PointLikelihood(record, structure).Value(parameters);
}

PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, Eigen::VectorXd start, const PointFitOptions& options) {
  PointFit out;
  Posterior posterior(record, structure, prior);
  out.parameters = Possible(record, structure, std::move(start));
  out.log_posterior = posterior.Value(out.parameters);
  const Eigen::VectorXd narrower =
      prior.deviation.cwiseQuotient(PriorOf(structure, record).deviation);
  double damping = kFirstDamping;
  double raise = 2.0;
  int corrections = 0;
  Source source = Source::kInformation;
  Quadratic here = posterior.Expand(out.parameters);
  if (!std::isfinite(out.log_posterior) || !here.gradient.allFinite() ||
      !here.information.allFinite()) {
    return NothingTold(prior, std::move(out.parameters));
  }
  while (out.iterations < options.iterations && damping < kMostDamping) {
    ++out.iterations;
    const Eigen::MatrixXd information = Positive(here.information);
    Eigen::MatrixXd damped = information;
    damped.diagonal().array() *= 1.0 + damping;
    Eigen::VectorXd step = SolveSymmetric(damped, here.gradient);
    step *= std::min(1.0, kLongestStep / step.cwiseProduct(narrower).cwiseAbs().maxCoeff());
    const double foretold = here.gradient.dot(step) - 0.5 * step.dot(information * step);
    if (damping < 1.0 && foretold < options.converged) {
      if (source == Source::kCurvature || options.converged >= kNear) {
        out.converged = true;
        break;
      }
      here.information = posterior.Curvature(out.parameters);
      source = Source::kCurvature;
      continue;
    }
    const Eigen::VectorXd there = out.parameters + step.cwiseProduct(prior.deviation);
    const double value = posterior.Value(there);
    const double gain = value - out.log_posterior;
    // Where spectra leave the range of numbers the likelihood may still have a value, and no slope.
    Quadratic next;
    const bool far = source == Source::kInformation && foretold >= kNear;
    if (std::isfinite(value) && (gain > 0.0 || !far)) next.gradient = posterior.Gradient(there);
    const bool possible = next.gradient.size() > 0 && next.gradient.allFinite();
    const bool taken = gain > 0.0 && possible;
    if (far) {
      if (taken) next.information = posterior.Information(there);
    } else if (possible) {
      next.information = here.information;
      CorrectAlong(step, here.gradient - next.gradient, &next.information);
      here.information = next.information;
      source = Source::kCorrected;
      if (++corrections > kMostCorrections) {
        next.information = posterior.Curvature(taken ? there : out.parameters);
        here.information = next.information;
        source = Source::kCurvature;
        corrections = 0;
      }
    }
    if (!taken) {
      damping *= raise;
      raise *= 2.0;
      continue;
    }
    out.parameters = there;
    out.log_posterior = value;
    here = std::move(next);
    damping *= std::max(1.0 / 5.0, 1.0 - std::pow(2.0 * gain / foretold - 1.0, 3.0));
    raise = 2.0;
  }
  here.information = Positive(here.information);
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
  const auto fit_all = [&](const std::vector<Eigen::VectorXd>& from, const PointFitOptions& stage) {
    std::vector<PointFit> fits;
    for (const Eigen::VectorXd& start : from) {
      fits.push_back(FitPoint(record, structure, prior, start, stage));
    }
    std::ranges::stable_sort(fits, std::ranges::greater(), &PointFit::log_posterior);
    return fits;
  };
  // Near a maximum, then past the valleys that lead there, and at last on it.
  PointFitOptions near = options;
  near.converged = kNear;
  const std::vector<PointFit> all = fit_all(starts, near);
  std::vector<Eigen::VectorXd> best;
  for (std::size_t i = 0; i < std::min(all.size(), kMostToCompare); ++i) {
    best.push_back(all[i].parameters);
  }
  PointFitOptions stage = options;
  stage.iterations = std::min(options.iterations, kIterationsToCompare);
  std::vector<PointFit> fits = fit_all(best, stage);
  std::vector<Eigen::VectorXd> crossed = OtherDelays(structure, fits[0].parameters, all);
  if (!crossed.empty()) {
    crossed.push_back(fits[0].parameters);
    fits = fit_all(crossed, stage);
  }
  if (fits[0].converged) return fits[0];
  return FitPoint(record, structure, prior, fits[0].parameters, options);
}

}  // namespace howl
