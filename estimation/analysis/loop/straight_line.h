// A straight line y = a + b x through values of several operating points: weighted least squares
// where every value has a standard deviation, else ordinary. With known deviations scatter beyond
// them widens the line's variance, and only then is t Student's, with n - 2 degrees of freedom.
#ifndef HOWL_ESTIMATION_ANALYSIS_LOOP_STRAIGHT_LINE_H_
#define HOWL_ESTIMATION_ANALYSIS_LOOP_STRAIGHT_LINE_H_

#include <optional>
#include <span>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct LinePoint {
  double x = 0.0;
  Estimate y;  // std NaN: unknown
};

struct StraightLine {
  double x_mean = 0.0;
  double y_mean = 0.0;
  double slope = 0.0;
  double weight = 0.0;  // of all points: their number, or the sum of 1 / std^2
  double sxx = 0.0;     // sum of weighted (x - x_mean)^2
  double scale = 1.0;   // variance of a value of weight one
  double t = 0.0;       // 95 %: y is known to t sqrt(Variance)

  double At(double x) const { return y_mean + slope * (x - x_mean); }
  double Variance(double x) const {
    return scale * (1.0 / weight + (x - x_mean) * (x - x_mean) / sxx);
  }
};

// None of fewer than three points, or where all have the same x.
std::optional<StraightLine> FitStraightLine(std::span<const LinePoint> points);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_LOOP_STRAIGHT_LINE_H_
