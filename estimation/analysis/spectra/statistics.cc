#include "estimation/analysis/spectra/statistics.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "model/numerics/constants.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

// Mean of 1 + 2 c cos(pi j / n) over the K cosines, against its value at zero frequency.
double OverlapCorrection(int n, int count, double c) {
  double mean = 0.0;
  for (int j = 1; j <= count; ++j) mean += (1.0 + 2.0 * c * std::cos(kPi * j / n)) / count;
  return (1.0 + 2.0 * c) / mean;
}

// Covariance at lags 0, 1, 2 of the increments, between half-overlapping Hann averages, of a walk
// with unit variance a hop: autocorrelation of the kernel C(t) - C(t - 1/2), C being Hann's
// integral.
std::array<double, 3> SmoothedWalkCovariance() {
  constexpr std::size_t kPerHop = 500;
  const auto integral = [](double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u - std::sin(2.0 * kPi * u) / (2.0 * kPi);
  };
  std::array<double, 3 * kPerHop> kernel;
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double u = 0.5 * (static_cast<double>(i) + 0.5) / kPerHop;
    kernel[i] = integral(u) - integral(u - 0.5);
  }
  std::array<double, 3> covariance{};
  for (std::size_t lag = 0; lag < 3; ++lag) {
    for (std::size_t i = 0; i + lag * kPerHop < kernel.size(); ++i) {
      covariance[lag] += kernel[i] * kernel[i + lag * kPerHop] / kPerHop;
    }
  }
  return covariance;
}

// Columns x with x^T T_noise x = 1, x^T T_walk x = walk, all others zero: the covariances of n
// increments by unit white noise and unit walk, both averaged by the blocks, which are made
// diagonal at once.
struct IncrementBasis {
  Eigen::MatrixXd vectors;
  Eigen::VectorXd walk;
  Eigen::MatrixXd cosines;                    // the slower half, one a column
  Eigen::VectorXd cosine_noise, cosine_walk;  // variances of their sums by either
};

std::shared_ptr<const IncrementBasis> BasisFor(int n) {
  static std::mutex mutex;
  static std::map<int, std::shared_ptr<const IncrementBasis>> cache;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const IncrementBasis>& entry = cache[n];
  if (entry == nullptr) {
    const std::array<double, 3> walk = SmoothedWalkCovariance();
    constexpr double kRho = 1.0 / 6.0;  // neighbours' correlation
    const std::array<double, 3> noise = {2.0 - 2.0 * kRho, 2.0 * kRho - 1.0, -kRho};
    Eigen::MatrixXd walk_matrix = Eigen::MatrixXd::Zero(n, n), noise_matrix = walk_matrix;
    for (int i = 0; i < n; ++i) {
      for (int j = std::max(0, i - 2); j <= std::min(n - 1, i + 2); ++j) {
        const auto lag = static_cast<std::size_t>(std::abs(i - j));
        walk_matrix(i, j) = walk[lag];
        noise_matrix(i, j) = noise[lag];
      }
    }
    const SymmetricEigen both = GeneralizedEigen(walk_matrix, noise_matrix);
    const int count = std::max(CosineCount(n), n / 2);
    Eigen::MatrixXd cosines(n, count);
    for (int j = 0; j < count; ++j) {
      for (int t = 0; t < n; ++t) cosines(t, j) = std::cos(kPi * (j + 1) * (t + 0.5) / n);
    }
    const auto variances = [&](const Eigen::MatrixXd& covariance) -> Eigen::VectorXd {
      return (covariance * cosines).cwiseProduct(cosines).colwise().sum().transpose();
    };
    entry = std::make_shared<IncrementBasis>(IncrementBasis{both.vectors, both.values.cwiseMax(0.0),
                                                            cosines, variances(noise_matrix),
                                                            variances(walk_matrix)});
  }
  return entry;
}

// Allan's variance of means over T of a process with the one-sided spectrum S(f) = S_1 (2 T f)^-a,
// over that of the white one with S_1 = S(1 / 2T) everywhere:
//
//   sigma^2(T) = 2 int S(f) sin^4(pi f T) / (pi f T)^2 df      (S_1 / 2T for a = 0)
double AllanFactor(double a) {
  constexpr double kTop = 40.0;  // whole periods: beyond, sin^4 is 3/8 on average
  constexpr int kSteps = 8000;
  double integral = 3.0 / 8.0 / (kPi * kPi) * std::pow(kTop, -1.0 - a) / (1.0 + a);
  for (int i = 0; i < kSteps; ++i) {
    const double u = kTop * (i + 0.5) / kSteps;
    integral +=
        std::pow(std::sin(kPi * u), 4) / std::pow(kPi * u, 2) * std::pow(u, -a) * kTop / kSteps;
  }
  return 2.0 * 2.0 * integral * std::pow(2.0, -a);
}

// The variance of the mean increment where the frequency wanders slower than white noise does. The
// part of the increments' spectrum that the walk dominates is taken to fall as j^-a with the number
// j of the cosine, a anywhere between 0 and 2 (white, flicker and random-walk noise of the
// frequency), with probability kNoWander for a = 0, where `stationary` is the variance. Otherwise a
// mean over the record does not estimate a long-term mean, which such a process does not have. It
// estimates the mean over another stretch of the same length, and Allan's variance is its error.
double WithWander(double stationary, double walk_variance, int n, const Eigen::ArrayXd& squares,
                  const Eigen::ArrayXd& noise, const Eigen::ArrayXd& walk) {
  constexpr double kNoWander = 0.8;
  constexpr int kFewest = 6;  // cosines, for an exponent
  constexpr int kExponents = 20;
  constexpr double kSteepest = 2.0;
  static const std::array<double, kExponents> allan = [] {
    std::array<double, kExponents> factors{};
    for (std::size_t k = 0; k < kExponents; ++k) {
      factors[k] = AllanFactor(kSteepest * static_cast<double>(k + 1) / kExponents);
    }
    return factors;
  }();
  int count = 0;
  while (count < squares.size() && walk(count) > noise(count)) ++count;
  if (count < kFewest) return stationary;
  const Eigen::ArrayXd relative = squares.head(count) / (noise + walk).head(count);
  const Eigen::ArrayXd logs = Eigen::ArrayXd::LinSpaced(count, 1.0, count).log();
  const auto strength = [&](double a) { return (relative * (a * logs).exp()).mean(); };
  const auto log_likelihood = [&](double a, double at) {
    return 0.5 * a * logs.sum() - 0.5 * count * std::log(std::max(at, 1e-300));
  };
  const double none = log_likelihood(0.0, strength(0.0));
  double total = kNoWander;
  double variance = kNoWander * stationary;
  for (std::size_t k = 0; k < kExponents; ++k) {
    const double a = kSteepest * static_cast<double>(k + 1) / kExponents;
    const double at = strength(a);
    const double weight = (1.0 - kNoWander) / kExponents * std::exp(log_likelihood(a, at) - none);
    total += weight;
    variance += weight * at * walk_variance / n * allan[k];
  }
  return variance / total;
}

}  // namespace

double StudentInflation(double degrees_of_freedom) {
  const boost::math::students_t distribution(std::max(degrees_of_freedom, 1.0));
  return boost::math::quantile(distribution, 0.975) / kNormal95;
}

int CosineCount(int n) {
  return std::max(static_cast<int>(std::lround(0.4 * std::cbrt(static_cast<double>(n) * n))), 3);
}

MeanError ErrorOfMean(std::span<const std::complex<double>> values, double lag_one_correlation) {
  const int n = static_cast<int>(values.size());
  MeanError error;
  if (n < 5) return error;
  const int count = CosineCount(n);
  for (int j = 1; j <= count; ++j) {
    std::complex<double> sum = 0.0;
    for (int t = 0; t < n; ++t) {
      sum += values[static_cast<std::size_t>(t)] * std::cos(kPi * j * (t + 0.5) / n);
    }
    const Eigen::Vector2d v(sum.real(), sum.imag());
    error.covariance += v * v.transpose();
  }
  error.covariance *= 2.0 / n / count / n * OverlapCorrection(n, count, lag_one_correlation);
  error.degrees_of_freedom = count;
  return error;
}

MeanError ErrorOfMean(std::span<const double> values, double lag_one_correlation) {
  std::vector<std::complex<double>> complex_values(values.begin(), values.end());
  return ErrorOfMean(complex_values, lag_one_correlation);
}

TrendFit FitTrend(std::span<const double> series) {
  const int n = static_cast<int>(series.size()) - 1;  // increments
  TrendFit fit;
  if (n < 4) return fit;
  const std::shared_ptr<const IncrementBasis> basis = BasisFor(n);
  Eigen::VectorXd increments(n);
  Eigen::MatrixXd design(n, 2);  // constant, linear
  for (int t = 0; t < n; ++t) {
    const auto i = static_cast<std::size_t>(t);
    increments(t) = series[i + 1] - series[i];
    design(t, 0) = 1.0;
    design(t, 1) = t - 0.5 * (n - 1);
  }
  const Eigen::VectorXd y = basis->vectors.transpose() * increments;
  const Eigen::MatrixXd x = basis->vectors.transpose() * design;
  const Eigen::VectorXd noise = Eigen::VectorXd::Ones(n);
  const Eigen::VectorXd& walk = basis->walk;

  // Ratio of walk to noise: zero, or one of a logarithmic grid. Below 1/n^2 a walk is
  // harmless; where it dwarfs the noise, the blocks still damp its fast part a thousandfold.
  constexpr int kGrid = 49;
  const double low = std::log(1.0 / (static_cast<double>(n) * n));
  const double high = std::log(1e6);
  struct Point {
    double log_likelihood, ratio, slope, variance, scale, prior;
  };
  std::vector<Point> points;
  const auto evaluate = [&](double ratio, double prior) {
    const Eigen::VectorXd w = (noise + ratio * walk).array().inverse();
    const double information = (w.array() * x.col(0).array().square()).sum();
    const double slope = (w.array() * x.col(0).array() * y.array()).sum() / information;
    const Eigen::VectorXd residual = y - slope * x.col(0);
    const double scale = (w.array() * residual.array().square()).sum() / (n - 1);
    const double log_likelihood = 0.5 * w.array().log().sum() - 0.5 * std::log(information) -
                                  0.5 * (n - 1) * std::log(std::max(scale, 1e-300));
    return Point{log_likelihood, ratio, slope, scale / information, scale, prior};
  };
  double best = -std::numeric_limits<double>::infinity();
  for (int i = -1; i < kGrid; ++i) {
    points.push_back(i < 0 ? evaluate(0.0, kNoWalkPrior)
                           : evaluate(std::exp(low + (high - low) * i / (kGrid - 1)),
                                      (1.0 - kNoWalkPrior) / kGrid));
    best = std::max(best, points.back().log_likelihood);
  }
  double total = 0, slope = 0, second = 0, walk_sum = 0, white = 0;
  for (const Point& p : points) {
    const double weight = p.prior * std::exp(p.log_likelihood - best);
    total += weight;
    slope += weight * p.slope;
    second += weight * (p.variance + p.slope * p.slope);
    walk_sum += weight * p.ratio * p.scale;
    white += weight * p.scale;
  }
  slope /= total;
  const double variance = std::max(second / total - slope * slope, 0.0);
  fit.walk_variance = walk_sum / total;
  fit.noise_variance = white / total;
  const Eigen::ArrayXd squares = (basis->cosines.transpose() * increments).array().square();
  const Eigen::ArrayXd of_noise = fit.noise_variance * basis->cosine_noise.array();
  const Eigen::ArrayXd of_walk = fit.walk_variance * basis->cosine_walk.array();
  const int slow = CosineCount(n);
  const double slow_excess = (squares / (of_noise + of_walk).max(1e-300)).head(slow).mean();
  fit.slope = {slope, std::sqrt(WithWander(variance * slow_excess, fit.walk_variance, n, squares,
                                           of_noise, of_walk)) *
                          StudentInflation(slow)};

  const double walk_share = fit.walk_variance / fit.noise_variance;
  const Eigen::VectorXd w = (noise + walk_share * walk).array().inverse();
  const Eigen::Matrix2d normal = x.transpose() * w.asDiagonal() * x;
  const Eigen::Vector2d rhs = x.transpose() * (w.asDiagonal() * y);
  const Eigen::Vector2d both = normal.ldlt().solve(rhs);
  const Eigen::VectorXd residual = y - x * both;
  const double scale = residual.dot(w.asDiagonal() * residual) / std::max(n - 2, 1);
  fit.curvature = {both(1), std::sqrt(scale * normal.inverse()(1, 1)) * StudentInflation(n - 2)};
  return fit;
}

double Median(std::span<const double> values) {
  CHECK(!values.empty());
  std::vector<double> copy(values.begin(), values.end());
  return MedianInPlace(copy);
}

double MedianInPlace(std::span<double> values) {
  CHECK(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace howl
