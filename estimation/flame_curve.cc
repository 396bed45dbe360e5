#include "estimation/flame_curve.h"

#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "estimation/spectrum.h"
#include "model/units.h"

namespace howl {
namespace {

constexpr int kCoefficients = 6;
constexpr int kScoreBlocks = 48;
using Coefficients = Eigen::Matrix<double, kCoefficients, 1>;

// The fundamental as a complex oscillation between its blocks: A(t) e^(j 2 pi f t), where A(t)
// joins the blocks' amplitudes with Hann's weights, which sum to one.
class Fundamental {
 public:
  Fundamental(const std::vector<double>& x, double sampling_hz, double frequency_hz, int length)
      : blocks_(Demodulate(x, sampling_hz, frequency_hz, length)), frequency_hz_(frequency_hz) {}
  double FirstTime() const { return blocks_.first_center_s; }
  double LastTime() const {
    return FirstTime() + static_cast<double>(blocks_.amplitude.size() - 1) * blocks_.hop_s;
  }
  std::complex<double> At(double time_s) const {
    const double position = (time_s - blocks_.first_center_s) / blocks_.hop_s;
    const auto b = std::min(static_cast<std::size_t>(position), blocks_.amplitude.size() - 2);
    const double next =
        0.5 - 0.5 * std::cos(std::numbers::pi * (position - static_cast<double>(b)));
    return (blocks_.amplitude[b] * (1.0 - next) + blocks_.amplitude[b + 1] * next) *
           std::polar(1.0, kRadPerSPerHz * frequency_hz_ * time_s);
  }

 private:
  Blocks blocks_;
  double frequency_hz_;
};

// Samples of the blocks that p's fundamental is joined from. Long ones let in less noise (a
// relative variance of 0.4 |n|^2 / |P|^2, falling as 1 / length), short ones follow a wandering
// phase (an error of about 0.1 D length). A whole number of periods, three at least, keeps
// harmonics out.
int JoiningBlock(const Characteristics& cycle, double sampling_hz) {
  const double longest_s = cycle.block_samples / sampling_hz;
  const double noise =
      0.4 * cycle.block_noise_power * longest_s / (cycle.p_amplitude * cycle.p_amplitude);
  const double diffusion = std::max(kRadPerSPerHz * cycle.line_width_hz, 1e-9);
  const double best_s = std::min(std::sqrt(noise / (0.1 * diffusion)), longest_s);
  const double periods = std::max(std::round(best_s * cycle.frequency_hz.value), 3.0);
  return static_cast<int>(std::lround(periods / cycle.frequency_hz.value * sampling_hz));
}

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

}  // namespace

FlameCurve EstimateFlameCurve(const Record& record, const Characteristics& cycle, double tau_s,
                              const FlameCurveOptions& options) {
  CHECK_EQ(record.heat_release.size(), record.pressure.size());
  CHECK_GT(cycle.p_amplitude, 0.0);
  const double frequency_hz = cycle.frequency_hz.value;
  const double w = kRadPerSPerHz * frequency_hz;
  const double shift_s = 0.25 / frequency_hz - tau_s;
  const int length = JoiningBlock(cycle, record.sampling_hz);
  const Fundamental fundamental(RemoveMean(record.pressure), record.sampling_hz, frequency_hz,
                                length);
  FlameCurve curve;
  const int n = static_cast<int>(record.pressure.size());
  const int first = std::max(
      static_cast<int>(std::ceil((fundamental.FirstTime() - shift_s) * record.sampling_hz)), 0);
  const int last = std::min(
      static_cast<int>(std::floor((fundamental.LastTime() - shift_s) * record.sampling_hz)), n);
  if (last - first < 100) return curve;
  const double limit = w * cycle.p_amplitude;
  curve.x_amplitude = limit;

  std::vector<double> x, q;
  x.reserve(static_cast<std::size_t>(last - first));
  q.reserve(x.capacity());
  double area = 0.0, q_mean = 0.0, in_phase = 0.0, quadrature_sum = 0.0;
  double x_sum = 0.0;
  for (int t = first; t < last; ++t) {
    const std::complex<double> z = w * fundamental.At(t / record.sampling_hz + shift_s);
    x.push_back(z.real());
    q.push_back(record.heat_release[static_cast<std::size_t>(t)]);
    q_mean += q.back();
    area -= q.back() * z.imag();
    in_phase += q.back() * z.real();
    quadrature_sum -= z.imag();
    x_sum += z.real();
  }
  q_mean /= static_cast<double>(x.size());
  area -= q_mean * quadrature_sum;
  in_phase -= q_mean * x_sum;
  curve.hysteresis = area / std::hypot(area, in_phase);
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

  // Joining the blocks leaves 0.79 of their noise's variance, half of it in the real part.
  curve.regressor_noise = 0.5 * 0.79 * cycle.block_noise_power * cycle.block_samples / length /
                          (cycle.p_amplitude * cycle.p_amplitude);
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
