#include "estimation/record_fit/point_fit.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "estimation/record_fit/loop/possible_loop.h"
#include "estimation/record_fit/point_posterior.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr double kFirstDamping = 0.1;
constexpr double kLeastDamping = 1e-9;  // no step is the shorter for
constexpr double kMostDamping = 1e12;
// Of a parameter, in deviations of what it may be on any rig (point_prior.h): from a start far from
// any maximum a quadratic may point to where no rig is, and the likelihood be flat.
constexpr double kLongestStep = 3.0;
// Of frequencies and the flame's path, in the same deviations: no rig has them farther out.
constexpr double kFarthest = 10.0;
constexpr int kMostCorrections = 12;
constexpr double kItsOwnErrors = 1.0;  // the square of a way, over the covariance
constexpr int kMostShortened = 2;      // of a step, by at most
constexpr double kShortest = 0.1;      // each time
constexpr double kFromEdge = 1.02;     // of delays, and of their spread, that fits begin with
constexpr int kMostHalvings = 20;      // of a start's flame
// Nats of evidence, as a rule, by which the curvature differs from what the steps have shown.
constexpr double kCurvatureTells = 1.0;

// With delays, and so weak a flame, that the loop is a possible one.
Eigen::VectorXd Possible(const RecordSpectra& record, const PointStructure& structure,
                         Eigen::VectorXd parameters) {
  const Eigen::Index flame = record.flame.cols();
  double& log_tau = parameters[structure.Delay()];
  log_tau = std::max(log_tau, std::log(kFromEdge * LeastDelay(record)));
  if (structure.delay_spread == DelaySpread::kGamma) {
    double& log_rho = parameters[structure.Delay() + 1];
    log_rho = std::min(log_rho, -std::log(kFromEdge));
  }
  for (int i = 0; i < kMostHalvings; ++i) {
    if (IsPossible(record, ToPoint(structure, flame, parameters))) break;
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

Eigen::MatrixXd PointFit::InformationOfRecord(const PointPrior& prior) const {
  Eigen::MatrixXd out = information;
  out.diagonal().array() -= prior.Precision(parameters).array() / prior.deviation.array().square();
  return out;
}

double LogLikelihood(const RecordSpectra& record, const PointStructure& structure,
                     const Eigen::VectorXd& parameters) {
  return PointLikelihood(record, structure).Value(parameters);
}

PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, Eigen::VectorXd start, const PointFitOptions& options) {
  PointFit out;
  PointPosterior posterior(record, structure, prior);
  out.parameters = Possible(record, structure, std::move(start));
  out.log_posterior = posterior.Value(out.parameters);
  const PointPrior of_rigs = PriorOf(structure, record);
  const Eigen::VectorXd narrower = prior.deviation.cwiseQuotient(of_rigs.deviation);
  const auto farthest = [&](const Eigen::VectorXd& parameters) {
    const Eigen::ArrayXd z = (parameters - of_rigs.mean).array().abs() / of_rigs.deviation.array();
    return std::max(z.head(structure.Frequencies()).maxCoeff(),
                    z.segment(structure.Delay(), structure.Delays()).maxCoeff());
  };
  double damping = kFirstDamping;
  double raise = 2.0;
  int corrections = 0;
  Source source = Source::kInformation;
  PosteriorSlopes here;
  if (options.of_record != nullptr) {
    here = {posterior.Gradient(out.parameters),
            posterior.WithPrior(*options.of_record, out.parameters)};
    source = Source::kCurvature;
  } else {
    here = posterior.Expand(out.parameters);
  }
  const Eigen::VectorXd begun = out.parameters;
  // Whether the curvature is known, but for what a fit's own errors change of it.
  const auto curvature_known = [&] {
    if (source != Source::kCorrected || options.of_record == nullptr) {
      return source == Source::kCurvature;
    }
    const Eigen::VectorXd way = (out.parameters - begun).cwiseQuotient(prior.deviation);
    return way.dot(here.information * way) < kItsOwnErrors;
  };
  // Nats that need not be known.
  const auto enough = [&] {
    const double gained = out.log_posterior - options.over;
    return gained > 0.0 ? std::max(options.converged, options.share * gained) : options.converged;
  };
  const auto curvature_needed = [&] {
    return options.curvature && enough() < kCurvatureTells && !curvature_known();
  };
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
    const auto gain_of = [&](const Eigen::VectorXd& by) {
      return here.gradient.dot(by) - 0.5 * by.dot(information * by);
    };
    double foretold = gain_of(step);
    if (damping < 1.0 && foretold < enough()) {
      if (!curvature_needed()) {
        out.converged = true;
        break;
      }
      here.information = posterior.Curvature(out.parameters, here);
      source = Source::kCurvature;
      continue;
    }
    const bool far = source == Source::kInformation && foretold >= kNearMaximum;
    step *= posterior.ShareWithin(out.parameters, step);
    const auto value_after = [&](const Eigen::VectorXd& by) {
      const Eigen::VectorXd moved = out.parameters + by.cwiseProduct(prior.deviation);
      const bool on_a_rig = farthest(moved) <= std::max(kFarthest, farthest(out.parameters));
      return on_a_rig ? posterior.Value(moved) : -std::numeric_limits<double>::infinity();
    };
    double value = value_after(step);
    // A step that leads down is shortened to where a parabola through what it lost has its top.
    for (int i = 0; i < kMostShortened && !(value > out.log_posterior); ++i) {
      const double slope = here.gradient.dot(step);
      step *= std::clamp(0.5 * slope / (slope - (value - out.log_posterior)), kShortest, 0.5);
      value = value_after(step);
    }
    const Eigen::VectorXd there = out.parameters + step.cwiseProduct(prior.deviation);
    const double gain = value - out.log_posterior;
    foretold = gain_of(step);
    // Where spectra leave the range of numbers the likelihood may still have a value, and no slope.
    PosteriorSlopes next;
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
        next.information =
            taken ? posterior.Curvature(there, next) : posterior.Curvature(out.parameters, here);
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
    damping = std::max(damping, kLeastDamping);
    raise = 2.0;
  }
  // Corrections show the curvature along the way alone.
  if (source == Source::kCorrected && curvature_needed()) {
    here.information = posterior.Curvature(out.parameters, here);
  }
  here.information = Positive(here.information);
  out.log_likelihood = out.log_posterior - posterior.LogPrior(out.parameters);
  const Eigen::VectorXd precision = prior.deviation.cwiseInverse();
  out.information = precision.asDiagonal() * here.information * precision.asDiagonal();
  out.information.triangularView<Eigen::StrictlyUpper>() = out.information.transpose().eval();
  const Eigen::LLT<Eigen::MatrixXd> root(here.information);
  out.log_evidence = out.log_posterior - root.matrixLLT().diagonal().array().log().sum() +
                     prior.deviation.array().log().sum() +
                     0.5 * static_cast<double>(precision.size()) * std::log(2.0 * std::numbers::pi);
  return out;
}

}  // namespace howl
