#include "estimation/record_fit/point_posterior.h"

#include <algorithm>
#include <cmath>

#include "estimation/record_fit/loop/possible_loop.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr double kDifference = 1e-5;  // of what a parameter is known by, all others being given
constexpr double kLeastCosine =
    1e-8;  // of a correction's denominator (Nocedal & Wright 2006, 6.26)
// Of the way to an edge (the fraction to the boundary of interior-point methods, the same, 19.9).
constexpr double kToTheEdge = 0.9;
constexpr int kHalvings = 20;

}  // namespace

double PointPosterior::LogPrior(const Eigen::VectorXd& parameters) const {
  return prior_.LogDensity(parameters) + LogDensityOfPossible(record_, PointAt(parameters));
}

double PointPosterior::Value(const Eigen::VectorXd& parameters) {
  const double value = likelihood_.Value(parameters);
  return std::isfinite(value) ? value + LogPrior(parameters) : value;
}

Eigen::VectorXd PointPosterior::Gradient(const Eigen::VectorXd& parameters, Eigen::Index first) {
  Eigen::VectorXd out = likelihood_.Gradient(parameters, first);
  const Eigen::VectorXd possible = GradientOfPossible(record_, structure_, PointAt(parameters));
  out.head(possible.size()) += possible;
  return prior_.deviation.cwiseProduct(out) + prior_.Slope(parameters);
}

Eigen::MatrixXd PointPosterior::WithPrior(const Eigen::MatrixXd& of_record,
                                          const Eigen::VectorXd& parameters) const {
  const auto scale = prior_.deviation.asDiagonal();
  Eigen::MatrixXd out = scale * of_record * scale;
  out.diagonal() += prior_.Precision(parameters);
  return out;
}

Eigen::MatrixXd PointPosterior::Information(const Eigen::VectorXd& parameters) {
  Eigen::MatrixXd of_record = likelihood_.Information(parameters);
  const Eigen::MatrixXd possible = InformationOfPossible(record_, structure_, PointAt(parameters));
  of_record.topLeftCorner(possible.rows(), possible.cols()) += possible;
  return WithPrior(of_record, parameters);
}

Eigen::MatrixXd PointPosterior::Curvature(const Eigen::VectorXd& parameters,
                                          const PosteriorSlopes& here) {
  const Eigen::Index size = parameters.size();
  Eigen::MatrixXd out(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    // Less than the prior tells no parameter is known by.
    const double step = kDifference / std::sqrt(std::max(here.information(i, i), 1.0));
    Eigen::VectorXd moved = parameters;
    moved[i] += step * prior_.deviation[i];
    out.col(i).tail(size - i) = (here.gradient - Gradient(moved, i)).tail(size - i) / step;
    out.row(i).tail(size - i) = out.col(i).tail(size - i).transpose();
  }
  // Next to parameters where spectra leave the range of numbers there may be no slope.
  if (!out.allFinite()) return Information(parameters);
  return out;
}

double PointPosterior::ShareWithin(const Eigen::VectorXd& parameters,
                                   const Eigen::VectorXd& step) const {
  const Eigen::VectorXd whole = step.cwiseProduct(prior_.deviation);
  const auto possible = [&](double share) {
    return IsPossible(record_, PointAt(parameters + share * whole));
  };
  if (possible(1.0)) return 1.0;
  double inside = 0.0;
  double outside = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (possible(middle) ? inside : outside) = middle;
  }
  return kToTheEdge * inside;
}

Eigen::MatrixXd Positive(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1.0).cwiseSqrt();
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const Eigen::MatrixXd scaled = inverse.asDiagonal() * information * inverse.asDiagonal();
  if (HasEigenvaluesAbove(1e-9, scaled)) return information;
  const SymmetricEigen eigen = EigenOfSymmetric(scaled);
  return scale.asDiagonal() * eigen.vectors * eigen.values.cwiseAbs().cwiseMax(1e-6).asDiagonal() *
         eigen.vectors.transpose() * scale.asDiagonal();
}

void CorrectAlong(const Eigen::VectorXd& step, const Eigen::VectorXd& fall_of_gradient,
                  Eigen::MatrixXd* information) {
  const Eigen::VectorXd missed = fall_of_gradient - *information * step;
  const double along = missed.dot(step);
  if (std::abs(along) < kLeastCosine * missed.norm() * step.norm()) return;
  *information += missed * missed.transpose() / along;
}

}  // namespace howl
