#include "estimation/flame_curve.h"

#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/units.h"

namespace howl {
namespace {

constexpr int kCoefficients = 6;
constexpr int kScoreBlocks = 48;
using Coefficients = Eigen::Matrix<double, kCoefficients, 1>;

// x[t + shift] by Lagrange's polynomial through the six samples around it. Zero outside; callers
// keep away from the ends.
class Shifter {
 public:
  explicit Shifter(double shift) : whole_(static_cast<int>(std::floor(shift))) {
    const double fraction = shift - whole_;
    for (int i = 0; i < 6; ++i) {
      double weight = 1.0;
      for (int j = 0; j < 6; ++j) {
        if (j != i) weight *= (fraction + 2.0 - j) / (i - j);
      }
      weights_[static_cast<std::size_t>(i)] = weight;
    }
  }
  int First() const { return std::max(0, 2 - whole_); }
  int Last(int n) const { return std::min(n, n - 3 - whole_); }  // one past
  double At(const std::vector<double>& x, int t) const {
    double sum = 0.0;
    const int start = t + whole_ - 2;
    for (int i = 0; i < 6; ++i) {
      sum += weights_[static_cast<std::size_t>(i)] * x[static_cast<std::size_t>(start + i)];
    }
    return sum;
  }

 private:
  int whole_;
  std::array<double, 6> weights_;
};

Coefficients Powers(double u) {
  Coefficients f;
  f(0) = 1.0;
  for (int i = 1; i < kCoefficients; ++i) f(i) = f(i - 1) * u;
  return f;
}

void FillBins(const std::vector<double>& x, const std::vector<double>& q, double limit, int count,
              std::vector<FlameCurveBin>* bins) {
  struct Sums {
    double x = 0, q = 0, qq = 0;
    int samples = 0, passages = 0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>(count));
  int previous = -1;
  for (std::size_t t = 0; t < x.size(); ++t) {
    const int bin = static_cast<int>(std::floor((x[t] + limit) / (2.0 * limit) * count));
    if (bin >= 0 && bin < count) {
      Sums& s = sums[static_cast<std::size_t>(bin)];
      s.x += x[t];
      s.q += q[t];
      s.qq += q[t] * q[t];
      ++s.samples;
      s.passages += bin != previous ? 1 : 0;
    }
    previous = bin;
  }
  for (const Sums& s : sums) {
    if (s.samples < 2) continue;
    const double mean = s.q / s.samples;
    const double variance = std::max(s.qq / s.samples - mean * mean, 0.0);
    bins->push_back({s.x / s.samples, mean, std::sqrt(variance / s.passages), s.samples});
  }
}

}  // namespace

FlameCurve EstimateFlameCurve(const Record& record, double frequency_hz, double tau_s,
                              double p_amplitude, const FlameCurveOptions& options) {
  CHECK(!record.heat_release.empty());
  CHECK_GT(p_amplitude, 0.0);
  const int n = static_cast<int>(record.pressure.size());
  double p_mean = 0.0, p_power = 0.0;
  for (double p : record.pressure) p_mean += p / n;
  for (double p : record.pressure) p_power += (p - p_mean) * (p - p_mean) / n;

  const double w = kRadPerSPerHz * frequency_hz;
  const Shifter delayed((-tau_s + 0.25 / frequency_hz) * record.sampling_hz);
  const Shifter quarter((-tau_s + 0.5 / frequency_hz) * record.sampling_hz);  // dx/dt / w
  FlameCurve curve;
  const int first = std::max(delayed.First(), quarter.First());
  const int last = std::min(delayed.Last(n), quarter.Last(n));
  if (last - first < 100) return curve;
  const double limit = w * p_amplitude;
  curve.x_amplitude = limit;

  std::vector<double> x, q;
  x.reserve(static_cast<std::size_t>(last - first));
  q.reserve(x.capacity());
  double area = 0.0, q_mean = 0.0, cosine = 0.0, sine = 0.0;
  for (int t = first; t < last; ++t) {
    x.push_back(w * (delayed.At(record.pressure, t) - p_mean));
    q.push_back(record.heat_release[static_cast<std::size_t>(t)]);
    q_mean += q.back();
    const double y = w * (quarter.At(record.pressure, t) - p_mean);
    area += q.back() * y;
    cosine += q.back() * x.back();
    sine += y;
  }
  q_mean /= static_cast<double>(x.size());
  area -= q_mean * sine;
  curve.hysteresis = area / std::hypot(area, cosine);
  FillBins(x, q, 1.05 * limit, options.bins, &curve.bins);

  Eigen::Matrix<double, kCoefficients, kCoefficients> normal;
  normal.setZero();
  Coefficients rhs = Coefficients::Zero();
  for (std::size_t t = 0; t < x.size(); ++t) {
    if (std::abs(x[t]) > options.fit_range * limit) continue;
    const Coefficients f = Powers(x[t] / limit);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(f);
    rhs += (q[t] - q_mean) * f;
  }
  const Eigen::LDLT<Eigen::Matrix<double, kCoefficients, kCoefficients>> solver(
      normal.selfadjointView<Eigen::Lower>());
  const Coefficients c = solver.solve(rhs);
  const Coefficients slope_row = solver.solve(Coefficients::Unit(1));
  const Coefficients offset_row = solver.solve(Coefficients::Unit(0));

  std::vector<double> slope_scores(kScoreBlocks, 0.0), offset_scores(kScoreBlocks, 0.0);
  double low_sum = 0, high_sum = 0;
  int low_count = 0, high_count = 0;
  for (std::size_t t = 0; t < x.size(); ++t) {
    const double u = x[t] / limit;
    if (u > options.fit_range) high_sum += q[t], ++high_count;
    if (u < -options.fit_range) low_sum += q[t], ++low_count;
    if (std::abs(u) > options.fit_range) continue;
    const Coefficients f = Powers(u);
    const double residual = q[t] - q_mean - c.dot(f);
    const std::size_t block = t * kScoreBlocks / x.size();
    slope_scores[block] += kScoreBlocks * slope_row.dot(f) * residual;
    offset_scores[block] += kScoreBlocks * offset_row.dot(f) * residual;
  }
  const MeanError slope_error = ErrorOfMean(slope_scores, 0.0);
  const MeanError offset_error = ErrorOfMean(offset_scores, 0.0);
  const double inflation = StudentInflation(slope_error.degrees_of_freedom);
  const double positive = high_count > 0 ? high_sum / high_count : q_mean;
  const double negative = low_count > 0 ? low_sum / low_count : q_mean;
  curve.saturation_low = std::min(positive, negative);
  curve.saturation_high = std::max(positive, negative);
  curve.offset = {q_mean + c(0), std::sqrt(offset_error.covariance(0, 0)) * inflation};

  curve.regressor_noise = std::max(p_power / (p_amplitude * p_amplitude) - 0.5, 0.0);
  const double r = std::min(curve.regressor_noise, 0.3);  // beyond, first order says nothing
  const double slope = (c(1) / (1.0 + r) - 3.0 * r * c(3)) / limit;
  const double correction = slope - c(1) / limit;
  curve.relative_correction = c(1) != 0.0 ? slope * limit / c(1) - 1.0 : 0.0;
  curve.slope = {slope, std::hypot(std::sqrt(slope_error.covariance(0, 0)) * inflation / limit,
                                   0.5 * correction)};
  return curve;
}

Estimate LoopGainFromSlope(const Estimate& gain, const Estimate& frequency_hz,
                           const Estimate& flame_slope) {
  const double value =
      gain.value * kRadPerSPerHz * frequency_hz.value * std::abs(flame_slope.value);
  const auto relative = [](const Estimate& e) {
    return std::isfinite(e.std) && e.value != 0.0 ? e.std / e.value : 0.0;
  };
  return {value, value * std::hypot(relative(gain), relative(frequency_hz), relative(flame_slope))};
}

}  // namespace howl
