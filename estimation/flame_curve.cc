#include "estimation/flame_curve.h"

#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "estimation/flame_regressor.h"
#include "model/units.h"

namespace howl {
namespace {

constexpr int kCoefficients = 6;
constexpr int kScoreBlocks = 48;
constexpr int kFewestSamples = 100;
constexpr double kClearPreference = 2.0;  // standard errors
using Coefficients = Eigen::Matrix<double, kCoefficients, 1>;

// u^0 .. u^5
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

// One regressor and the heat release beside it.
struct Samples {
  std::vector<double> x;
  std::vector<double> q;
  double q_mean = 0.0;
  double hysteresis = 0.0;
};

Samples Collect(const Record& record, const FlameRegressor& regressor, bool with_harmonics) {
  Samples samples;
  double area = 0.0, in_phase = 0.0, quadrature_sum = 0.0, fundamental_sum = 0.0;
  for (int t = regressor.first(); t < regressor.last(); ++t) {
    const std::complex<double> z = regressor.Fundamental(t);
    const double q = record.heat_release[static_cast<std::size_t>(t)];
    samples.x.push_back(z.real() + (with_harmonics ? regressor.Harmonics(z) : 0.0));
    samples.q.push_back(q);
    samples.q_mean += q;
    area -= q * z.imag();
    in_phase += q * z.real();
    quadrature_sum -= z.imag();
    fundamental_sum += z.real();
  }
  samples.q_mean /= static_cast<double>(samples.x.size());
  area -= samples.q_mean * quadrature_sum;
  in_phase -= samples.q_mean * fundamental_sum;
  samples.hysteresis = area / std::hypot(area, in_phase);
  return samples;
}

// q - mean as a polynomial of x / limit over |x| <= range * limit.
struct PolynomialFit {
  Coefficients coefficients;
  Coefficients slope_row;  // of the inverse normal matrix: the slope's influence function
  Coefficients offset_row;

  double Residual(const Samples& samples, std::size_t t, double limit) const {
    return samples.q[t] - samples.q_mean - coefficients.dot(Powers(samples.x[t] / limit));
  }
};

PolynomialFit FitPolynomial(const Samples& samples, double limit, double range) {
  Eigen::Matrix<double, kCoefficients, kCoefficients> normal;
  normal.setZero();
  Coefficients rhs = Coefficients::Zero();
  for (std::size_t t = 0; t < samples.x.size(); ++t) {
    if (std::abs(samples.x[t]) > range * limit) continue;
    const Coefficients f = Powers(samples.x[t] / limit);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(f);
    rhs += (samples.q[t] - samples.q_mean) * f;
  }
  const Eigen::LDLT<Eigen::Matrix<double, kCoefficients, kCoefficients>> solver(
      normal.selfadjointView<Eigen::Lower>());
  PolynomialFit fit;
  fit.coefficients = solver.solve(rhs);
  fit.slope_row = solver.solve(Coefficients::Unit(1));
  fit.offset_row = solver.solve(Coefficients::Unit(0));
  return fit;
}

// By how many standard errors `b` leaves q less scattered than `a`: positive where b is the better
// regressor. Over the same samples, in blocks that outlast the correlation of the residuals.
double ScatterPreference(const Samples& a, const PolynomialFit& fit_a, const Samples& b,
                         const PolynomialFit& fit_b, double limit, double range) {
  std::vector<double> differences(kScoreBlocks, 0.0);
  for (std::size_t t = 0; t < a.x.size(); ++t) {
    if (std::abs(a.x[t]) > range * limit || std::abs(b.x[t]) > range * limit) continue;
    const double ra = fit_a.Residual(a, t, limit);
    const double rb = fit_b.Residual(b, t, limit);
    differences[t * kScoreBlocks / a.x.size()] += ra * ra - rb * rb;
  }
  double mean = 0.0;
  for (const double difference : differences) mean += difference / kScoreBlocks;
  const double variance = ErrorOfMean(differences, 0.0).covariance(0, 0);
  return variance > 0.0 ? mean / std::sqrt(variance) : 0.0;
}

void FillErrors(const Samples& samples, const PolynomialFit& fit, double limit, double range,
                FlameCurve& curve) {
  std::vector<double> slope_scores(kScoreBlocks, 0.0), offset_scores(kScoreBlocks, 0.0);
  double low_sum = 0, high_sum = 0;
  int low_count = 0, high_count = 0;
  for (std::size_t t = 0; t < samples.x.size(); ++t) {
    const double u = samples.x[t] / limit;
    if (u > range) high_sum += samples.q[t], ++high_count;
    if (u < -range) low_sum += samples.q[t], ++low_count;
    if (std::abs(u) > range) continue;
    const Coefficients f = Powers(u);
    const double residual = fit.Residual(samples, t, limit);
    const std::size_t block = t * kScoreBlocks / samples.x.size();
    slope_scores[block] += kScoreBlocks * fit.slope_row.dot(f) * residual;
    offset_scores[block] += kScoreBlocks * fit.offset_row.dot(f) * residual;
  }
  const MeanError slope_error = ErrorOfMean(slope_scores, 0.0);
  const MeanError offset_error = ErrorOfMean(offset_scores, 0.0);
  const double inflation = StudentInflation(slope_error.degrees_of_freedom);
  const double positive = high_count > 0 ? high_sum / high_count : samples.q_mean;
  const double negative = low_count > 0 ? low_sum / low_count : samples.q_mean;
  curve.saturation_low = std::min(positive, negative);
  curve.saturation_high = std::max(positive, negative);
  curve.offset = {samples.q_mean + fit.coefficients(0),
                  std::sqrt(offset_error.covariance(0, 0)) * inflation};
  curve.slope.std = std::sqrt(slope_error.covariance(0, 0)) * inflation / limit;
}

}  // namespace

FlameCurve EstimateFlameCurve(const Record& record, const Characteristics& cycle, double tau_s,
                              const FlameCurveOptions& options) {
  CHECK_EQ(record.heat_release.size(), record.pressure.size());
  const FlameRegressor regressor(record, cycle, tau_s, options.max_harmonic);
  FlameCurve curve;
  if (regressor.last() - regressor.first() < kFewestSamples) return curve;
  const double limit = kRadPerSPerHz * cycle.frequency_hz.value * cycle.p_amplitude;
  curve.x_amplitude = limit;

  Samples samples = Collect(record, regressor, false);
  double undecided = 0.0;
  PolynomialFit fit = FitPolynomial(samples, limit, options.fit_range);
  if (regressor.locked_harmonics() > 0) {
    Samples full = Collect(record, regressor, true);
    const PolynomialFit full_fit = FitPolynomial(full, limit, options.fit_range);
    const double preference =
        ScatterPreference(samples, fit, full, full_fit, limit, options.fit_range);
    // Where the scatter cannot tell the two apart, neither can the slope be known better than to
    // half of their distance.
    if (std::abs(preference) < kClearPreference) {
      undecided = 0.5 * (full_fit.coefficients(1) - fit.coefficients(1)) / limit;
    }
    if (preference > 0.0) {
      samples = std::move(full);
      fit = full_fit;
      curve.harmonics = regressor.locked_harmonics();
    }
  }
  curve.hysteresis = samples.hysteresis;
  FillBins(samples.x, samples.q, 1.05 * limit, options.bins, &curve.bins);
  FillErrors(samples, fit, limit, options.fit_range, curve);

  // Joining the blocks leaves 0.79 of their noise's variance, half of it in the real part.
  curve.regressor_noise = 0.5 * 0.79 * cycle.block_noise_power * cycle.block_samples /
                          regressor.block_samples() / (cycle.p_amplitude * cycle.p_amplitude);
  const Coefficients& c = fit.coefficients;
  const double r = std::min(curve.regressor_noise, 0.3);  // beyond, first order says nothing
  curve.slope.value = (c(1) / (1.0 + r) - 3.0 * r * c(3)) / limit;
  const double correction = curve.slope.value - c(1) / limit;
  curve.relative_correction = c(1) != 0.0 ? curve.slope.value * limit / c(1) - 1.0 : 0.0;
  curve.slope.std = std::hypot(curve.slope.std, 0.5 * correction, undecided);
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
