#include "estimation/analysis/transfer/joint_deviation.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace howl {

namespace {

// exp(x^2) erfc(x), x >= 0: from the library while erfc is far from underflow, beyond by Laplace's
// continued fraction, which converges there within twenty terms.
double ScaledErfc(double x) {
  constexpr double kFraction = 6.0;
  if (x < kFraction) return std::exp(x * x) * std::erfc(x);
  double tail = x;
  for (int n = 30; n >= 1; --n) tail = x + 0.5 * n / tail;
  return std::numbers::inv_sqrtpi / tail;
}

double ScaledTail(double d, int count) {
  const bool odd = count % 2 == 1;
  double sum = odd ? ScaledErfc(d / std::numbers::sqrt2) : 1.0;
  // (d^2 / 2)^{k/2} / Gamma(k/2 + 1), from k to k + 2 by the factor (d^2 / 2) / (k/2 + 1).
  double term = odd ? d * std::numbers::sqrt2 * std::numbers::inv_sqrtpi : 0.5 * d * d;
  for (int k = odd ? 1 : 2; k + 2 <= count; k += 2) {
    sum += term;
    term *= d * d / (k + 2.0);
  }
  return sum;
}

// ln P(chi2_k > d^2)
double LogTail(double d, int count) { return -0.5 * d * d + std::log(ScaledTail(d, count)); }

// d (ln P) / dd = -density / P; the density of d is 2^{1-k/2} d^{k-1} exp(-d^2/2) / Gamma(k/2).
double LogTailSlope(double d, int count) {
  const double density =
      std::pow(2.0, 1.0 - 0.5 * count) * std::pow(d, count - 1) / std::tgamma(0.5 * count);
  return -density / ScaledTail(d, count);
}

// d with ln P = log_tail between the two ends. Newton's method: ln P is concave in d for every k >=
// 1, so that from the far end the iterates come down to the root and never pass it; a step that
// leaves the ends, by rounding, is halved between them.
double SolveTail(double log_tail, int count, double low, double high) {
  double d = high;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double residual = LogTail(d, count) - log_tail;
    (residual > 0.0 ? low : high) = d;
    const double step = residual / LogTailSlope(d, count);
    // Newton's steps shrink as their squares: what is left after this one is rounding.
    if (std::abs(step) <= 1e-9 * d) return d - step;
    const double next = d - step;
    d = next > low && next < high ? next : 0.5 * (low + high);
  }
  return d;
}

}  // namespace

double DeviationOfDistance(double distance, int count) {
  CHECK_GE(count, 1);
  if (count == 1 || !(distance > 0.0) || !std::isfinite(distance)) return distance;
  return SolveTail(LogTail(distance, count), 1, 0.0, distance);
}

double DistanceOfDeviation(double deviation, int count) {
  CHECK_GE(count, 1);
  if (count == 1 || !(deviation > 0.0) || !std::isfinite(deviation)) return deviation;
  // Var d^2 = 2 k and its mean k bound how much farther the k-th number can be.
  double high = deviation + std::sqrt(static_cast<double>(count)) + 1.0;
  const double log_tail = LogTail(deviation, 1);
  while (LogTail(high, count) > log_tail) high *= 2.0;
  return SolveTail(log_tail, count, deviation, high);
}

}  // namespace howl
