#include "diagnosis/noise/sensor_noise.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <vector>

#include "diagnosis/noise/noise_fit.h"
#include "diagnosis/numerics/local_power.h"

namespace howl {
namespace {

constexpr Eigen::Index kBlock = 48;
constexpr Eigen::Index kTerms = 3;
constexpr Eigen::Index kSmoothing = 30;
constexpr Eigen::Index kWideReach = 120;
constexpr std::size_t kFewestBlocks = 3;
constexpr double kFlat = 1.8;
constexpr Eigen::Index kLineReach = 3;
constexpr double kLineRatio = 6.0;
// Where a signal is hardly more than its noise, the scatter of the median lets noise through. A
// regressor with noise looks like a low-pass, but one that misses a weak part does not.
constexpr double kLeastPressureRatio = 2.0;
constexpr double kLeastHeatReleaseRatio = 3.0;

Eigen::VectorXd Shrinkage(const Eigen::VectorXcd& spectrum, double noise_variance,
                          double least_ratio) {
  const Eigen::Index n = spectrum.size();
  if (noise_variance == 0.0) return Eigen::VectorXd::Ones(n);
  Eigen::VectorXd power = Eigen::VectorXd::Zero(n);
  const Eigen::Index count = n - 2 * kTapReach;
  power.segment(kTapReach, count) = ApplyWindow(spectrum, count).cwiseAbs2();
  Eigen::VectorXd out(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    // Near a line, which has few bins, the median is that of the neighbours.
    const Eigen::Index near = std::max<Eigen::Index>(k - kLineReach, 0);
    const double own = power.segment(near, std::min(k + kLineReach + 1, n) - near).mean();
    const double typical = LocalPower(power, k, kSmoothing);
    const double level = own > kLineRatio * typical ? own : typical;
    out[k] = level > least_ratio * noise_variance ? 1.0 - noise_variance / level : 0.0;
  }
  return out;
}

// White noise is the level to which a spectrum falls and no further: that of the quietest quarter
// of wide blocks, if it is flat. Else nothing is known of it, and zero is returned.
double NoiseFloor(const Eigen::VectorXcd& spectrum) {
  const Eigen::Index count = spectrum.size() - 2 * kTapReach;
  const Eigen::VectorXd power = ApplyWindow(spectrum, count).cwiseAbs2();
  std::vector<double> levels;
  for (Eigen::Index at = kWideReach; at + kWideReach < count; at += 2 * kWideReach + 1) {
    levels.push_back(LocalPower(power, at, kWideReach));
  }
  const std::size_t quarter = levels.size() / 4;
  if (quarter < kFewestBlocks) return 0.0;
  std::sort(levels.begin(), levels.end());
  if (levels[quarter - 1] > kFlat * levels[0]) return 0.0;
  return std::accumulate(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(quarter),
                         0.0) /
         static_cast<double>(quarter);
}

}  // namespace

SensorNoise EstimateSensorNoise(const CutRecord& record) {
  const Eigen::Index n = record.acoustic_count;
  Eigen::VectorXcd residual = record.windowed_pressure;
  Eigen::VectorXd gain_squared = Eigen::VectorXd::Ones(n);
  for (Eigen::Index start = 0; start < n; start += kBlock) {
    const Eigen::Index size = std::min(kBlock, n - start);
    const Eigen::Index terms = size > 3 * kTerms ? kTerms : 1;
    Eigen::MatrixXcd columns(size, terms);
    for (Eigen::Index k = 0; k < size; ++k) {
      const double x = 2.0 * static_cast<double>(k) / static_cast<double>(kBlock) - 1.0;
      const Response q = record.windowed_heat_release[start + k];
      for (Eigen::Index j = 0; j < terms; ++j) {
        columns(k, j) = j == 0 ? q : columns(k, j - 1) * x;
      }
    }
    const auto p = record.windowed_pressure.segment(start, size);
    const Eigen::VectorXcd c = columns.colPivHouseholderQr().solve(p);
    // The degrees of freedom that the fit absorbs, counted in independent bins.
    const double left = 1.0 - std::min(0.8, static_cast<double>(terms) * kBinCorrelation /
                                                static_cast<double>(size));
    residual.segment(start, size) = (p - columns * c) / std::sqrt(left);
    for (Eigen::Index k = 0; k < size; ++k) {
      const double x = 2.0 * static_cast<double>(k) / static_cast<double>(kBlock) - 1.0;
      Response r = c[0];
      if (terms == kTerms) r += x * c[1] + x * x * c[2];
      gain_squared[start + k] = std::norm(r);
    }
  }
  SensorNoise out;
  out.variance = AcousticNoise(residual, gain_squared, record.masked);
  // V is linear in the gain: two bins that differ in it give both variances.
  Eigen::Index low = 0;
  Eigen::Index high = 0;
  gain_squared.minCoeff(&low);
  gain_squared.maxCoeff(&high);
  const double slope = (out.variance[high] - out.variance[low]) /
                       std::max(gain_squared[high] - gain_squared[low], 1e-300);
  out.pressure_variance = std::max(out.variance[low] - slope * gain_squared[low], 0.0);
  out.heat_release_variance = std::clamp(slope, 0.0, NoiseFloor(record.heat_release_spectrum));
  return out;
}

Eigen::VectorXd PressureShrinkage(const CutRecord& record, double noise_variance) {
  return Shrinkage(record.pressure_spectrum, noise_variance, kLeastPressureRatio);
}

Eigen::VectorXd HeatReleaseShrinkage(const CutRecord& record, double noise_variance) {
  return Shrinkage(record.heat_release_spectrum, noise_variance, kLeastHeatReleaseRatio);
}

}  // namespace howl
