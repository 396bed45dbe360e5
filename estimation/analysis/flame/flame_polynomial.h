// q - mean(q) as a polynomial of u = x / limit over |u| <= range: the smooth curve through the
// scatter of flame_curve.h, by least squares, with the long-run error of its slope and offset at
// zero.
//
//   q - mean = sum_i c_i u^i + e,    slope = c_1 / limit,    offset = mean + c_0
//
// An estimate linear in q, c_k = sum_t a_k(t) q(t), has the error sum_t a_k(t) e(t); its variance
// comes from sums over 48 stretches of the record, whose slow part ErrorOfMean takes up
// (statistics.h). The degree rises from 5 to 13 as long as that moves the slope by more than twice
// the error of the move; what the next degree would still change enters the std: a hyperbolic
// tangent is smoother than any polynomial, and each degree misses the slope to the same side.
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_POLYNOMIAL_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_POLYNOMIAL_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

// Samples of one regressor and of the heat release at the same times.
struct FlameSamples {
  std::vector<double> x;
  std::vector<double> q;
  double q_mean = 0.0;
};

class FlamePolynomial {
 public:
  static constexpr int kLowestDegree = 5;
  static constexpr int kHighestDegree = 13;

  FlamePolynomial(const FlameSamples& samples, double limit, double range,
                  int degree = kLowestDegree);

  int degree() const { return static_cast<int>(coefficients_.size()) - 1; }
  double Coefficient(int power) const { return coefficients_(power); }  // in units of q
  double Residual(const FlameSamples& samples, std::size_t t) const;    // e(t)
  double MeanSquareResidual(const FlameSamples& samples) const;         // where it holds
  bool Holds(double x) const { return x >= -range_ * limit_ && x <= range_ * limit_; }
  // Contributions of the record's stretches to c_`power`, whose mean has the error of c_`power`.
  std::vector<double> Scores(const FlameSamples& samples, int power) const;

 private:
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kHighestDegree + 1, 1>;
  Coefficients Powers(double u) const;

  double limit_ = 1.0;
  double range_ = 1.0;
  Coefficients coefficients_;
  Coefficients slope_row_;  // of the inverse normal matrix: influence functions
  Coefficients offset_row_;
};

// The number of standard errors by which `b` leaves q less scattered than `a`, over the samples
// where both hold: positive where b is the better regressor.
double ScatterPreference(const FlameSamples& a, const FlamePolynomial& fit_a, const FlameSamples& b,
                         const FlamePolynomial& fit_b);

struct FlameSlopeFit {
  Estimate slope;      // c_1, of u: in units of q
  Estimate offset;     // Phi(0), mean included
  double cubic = 0.0;  // c_3 at the lowest degree, which noise moves least
  int degree = 0;
};
FlameSlopeFit FitFlameSlope(const FlameSamples& samples, double limit, double range);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_POLYNOMIAL_H_
