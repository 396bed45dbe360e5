// Errors of estimates from serially correlated data.
//
// Long-run variance of a mean by equally weighted cosines (Lazarus, Lewis, Stock 2018; a multitaper
// estimate at zero frequency): with u_t, t = 0 .. n-1,
//
//   L_j = sqrt(2/n) sum_t u_t cos(pi j (t + 1/2) / n),   var(mean u) = sum_{j=1..K} L_j^2 / (K n)
//
// and (mean u) / sqrt(var) follows Student's t with K degrees of freedom: no block length has to
// exceed the correlation time, only n / K has to.
//
// A reported standard deviation is the half width of the 95 % interval divided by 1.96, so that
// value +- 1.96 std is that interval whatever the degrees of freedom.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_STATISTICS_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_STATISTICS_H_

#include <Eigen/Core>
#include <complex>
#include <limits>
#include <span>

namespace howl {

inline constexpr double kNormal95 = 1.959963984540054;

struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double std = std::numeric_limits<double>::quiet_NaN();
};

// Student's 0.975 quantile over the normal's: what turns a standard error into a reported std.
double StudentInflation(double degrees_of_freedom);

// K for n values: 0.4 n^(2/3), at least 3 (Lazarus, Lewis, Stock and Watson 2018, their recommended
// choice). More cosines would take the fast part of the scatter for the slow one, which on measured
// records is larger.
int CosineCount(int n);

// Covariance of the mean of complex values, as a 2x2 of real and imaginary parts, not inflated.
// `lag_one_correlation` is the correlation that the blocks' overlap alone gives neighbours: it
// corrects the low-pass that K cosines out of n apply.
struct MeanError {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double degrees_of_freedom = 0.0;
};
MeanError ErrorOfMean(std::span<const std::complex<double>> values, double lag_one_correlation);
// The same for real values: variance of the mean in covariance(0, 0).
MeanError ErrorOfMean(std::span<const double> values, double lag_one_correlation);

// Slope of a series y_b = a + mu b + random walk + white noise, averaged by half-overlapping Hann
// blocks (which correlate neighbours), with the strengths d and r of walk and noise unknown:
// generalised least squares on the increments, averaged over d / r by its restricted likelihood
// with probability `kNoWalkPrior` for d = 0. The error is scaled by what the K slowest cosines of
// the increments hold over what the fit expects of them, with K degrees of freedom. White noise
// alone is the phase of a pure tone, a walk that of a diffusing limit cycle; the errors of the
// slope differ by orders of magnitude.
//
// A slope that itself wanders, with increments whose spectrum falls as f^-a (a = 1: flicker, 2: a
// walk), has no mean, and one stretch says of the next what Allan's variance says (IEEE Std 1139).
// The error is averaged over a by the likelihood of the increments' cosines, a = 0 having the
// probability 0.8: of a stationary slope it is larger by a few percent to a quarter.
inline constexpr double kNoWalkPrior = 0.8;
struct TrendFit {
  Estimate slope;             // per step
  double walk_variance = 0;   // d, per step
  double noise_variance = 0;  // r
  Estimate curvature;         // change of slope per step
};
TrendFit FitTrend(std::span<const double> series);

// Of an even number of values the upper of the two in the middle. At least one value.
double Median(std::span<const double> values);
// The same without a copy: `values` are reordered.
double MedianInPlace(std::span<double> values);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_STATISTICS_H_
