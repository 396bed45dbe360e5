#include "estimation/analysis/flame/flame_polynomial.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace howl {
namespace {

constexpr int kStretches = 48;
constexpr double kClearStep = 2.0;  // standard errors by which a higher degree moves the slope

double ErrorOf(const std::vector<double>& scores) {
  const MeanError error = ErrorOfMean(scores, 0.0);
  return std::sqrt(error.covariance(0, 0)) * StudentInflation(error.degrees_of_freedom);
}

}  // namespace

FlamePolynomial::Coefficients FlamePolynomial::Powers(double u) const {
  Coefficients f(coefficients_.size());
  f(0) = 1.0;
  for (Eigen::Index i = 1; i < f.size(); ++i) f(i) = f(i - 1) * u;
  return f;
}

FlamePolynomial::FlamePolynomial(const FlameSamples& samples, double limit, double range,
                                 int degree)
    : limit_(limit), range_(range), coefficients_(Coefficients::Zero(degree + 1)) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(degree + 1);
  for (std::size_t t = 0; t < samples.x.size(); ++t) {
    if (!Holds(samples.x[t])) continue;
    const Coefficients f = Powers(samples.x[t] / limit);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(f);
    rhs += (samples.q[t] - samples.q_mean) * f;
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal.selfadjointView<Eigen::Lower>());
  coefficients_ = solver.solve(rhs);
  slope_row_ = solver.solve(Eigen::VectorXd::Unit(degree + 1, 1));
  offset_row_ = solver.solve(Eigen::VectorXd::Unit(degree + 1, 0));
}

double FlamePolynomial::Residual(const FlameSamples& samples, std::size_t t) const {
  return samples.q[t] - samples.q_mean - coefficients_.dot(Powers(samples.x[t] / limit_));
}

double FlamePolynomial::MeanSquareResidual(const FlameSamples& samples) const {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t t = 0; t < samples.x.size(); ++t) {
    if (!Holds(samples.x[t])) continue;
    const double residual = Residual(samples, t);
    sum += residual * residual;
    ++count;
  }
  return sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

std::vector<double> FlamePolynomial::Scores(const FlameSamples& samples, int power) const {
  const Coefficients& row = power == 0 ? offset_row_ : slope_row_;
  std::vector<double> scores(kStretches, 0.0);
  for (std::size_t t = 0; t < samples.x.size(); ++t) {
    if (!Holds(samples.x[t])) continue;
    scores[t * kStretches / samples.x.size()] +=
        kStretches * row.dot(Powers(samples.x[t] / limit_)) * Residual(samples, t);
  }
  return scores;
}

double ScatterPreference(const FlameSamples& a, const FlamePolynomial& fit_a, const FlameSamples& b,
                         const FlamePolynomial& fit_b) {
  std::vector<double> differences(kStretches, 0.0);
  for (std::size_t t = 0; t < a.x.size(); ++t) {
    if (!fit_a.Holds(a.x[t]) || !fit_b.Holds(b.x[t])) continue;
    const double ra = fit_a.Residual(a, t);
    const double rb = fit_b.Residual(b, t);
    differences[t * kStretches / a.x.size()] += ra * ra - rb * rb;
  }
  double mean = 0.0;
  for (const double difference : differences) mean += difference / kStretches;
  const double variance = ErrorOfMean(differences, 0.0).covariance(0, 0);
  return variance > 0.0 ? mean / std::sqrt(variance) : 0.0;
}

FlameSlopeFit FitFlameSlope(const FlameSamples& samples, double limit, double range) {
  FlamePolynomial fit(samples, limit, range);
  FlameSlopeFit result;
  result.cubic = fit.Coefficient(3);
  std::vector<double> scores = fit.Scores(samples, 1);
  double unfitted = 0.0;
  while (fit.degree() < FlamePolynomial::kHighestDegree) {
    FlamePolynomial next(samples, limit, range, fit.degree() + 2);
    std::vector<double> next_scores = next.Scores(samples, 1);
    std::vector<double> change(next_scores);
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= scores[i];
    const double step = next.Coefficient(1) - fit.Coefficient(1);
    unfitted = std::abs(step);
    if (std::abs(step) < kClearStep * ErrorOf(change)) break;
    fit = next;
    scores = next_scores;
  }
  result.degree = fit.degree();
  result.slope = {fit.Coefficient(1), std::hypot(ErrorOf(scores), unfitted)};
  result.offset = {samples.q_mean + fit.Coefficient(0), ErrorOf(fit.Scores(samples, 0))};
  return result;
}

}  // namespace howl
