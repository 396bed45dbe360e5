#include "diagnosis/likelihood/joint_band.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

// The reach to either side over which the signals' ratio is smoothed: the width of a mode of
// damping 0.05 at the cycle; above twice the cycle's frequency, in proportion to the frequency.
constexpr double kRatioReach = 0.1;

double RatioReach(double frequency_hz, double cycle_hz) {
  return kRatioReach * std::max(cycle_hz, 0.5 * frequency_hz);
}

constexpr Eigen::Index kPowerReach = 4;  // bins

Eigen::VectorXd SmoothPower(const Eigen::VectorXcd& x) {
  Eigen::VectorXd out(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(i - kPowerReach, 0);
    const Eigen::Index bins = std::min(i + kPowerReach + 1, x.size()) - from;
    out[i] = x.segment(from, bins).squaredNorm() / static_cast<double>(bins);
  }
  return out;
}

}  // namespace

Eigen::VectorXcd SineTapered(const Eigen::Ref<const Eigen::VectorXcd>& extended,
                             Eigen::Index count) {
  return extended.segment(kTapReach, count) - extended.segment(kTapReach + 1, count);
}

JointBand MakeJointBand(const CutRecord& record) {
  JointBand out;
  out.record = record;
  out.record.derivative_filter = BareDerivativeFilter(record);
  DriveAsRecorded(&out.record);
  out.count = record.flame_count;
  const Eigen::Index start = record.first - kTapReach;
  const Eigen::Index extended = record.flame_count + 2 * kTapReach;
  out.pressure = SineTapered(record.pressure_spectrum.segment(start, extended), out.count);
  out.heat_release = SineTapered(record.heat_release_spectrum.segment(start, extended), out.count);
  out.frequency_hz =
      record.frequency_hz.segment(kTapReach, out.count).array() + 0.5 * record.bin_hz;
  const double low = out.frequency_hz[0];
  const double high = out.frequency_hz[out.count - 1];
  out.log_frequency = 2.0 * (out.frequency_hz.array() / low).log() / std::log(high / low) - 1.0;
  out.pressure_over_heat_release.resize(out.count);
  for (Eigen::Index i = 0; i < out.count; ++i) {
    const auto reach = static_cast<Eigen::Index>(
        RatioReach(out.frequency_hz[i], record.lowest_cycle_hz) / record.bin_hz);
    const Eigen::Index from = std::max<Eigen::Index>(i - reach, 0);
    const Eigen::Index bins = std::min(i + reach + 1, out.count) - from;
    out.pressure_over_heat_release[i] =
        std::sqrt(out.pressure.segment(from, bins).squaredNorm() /
                  out.heat_release.segment(from, bins).squaredNorm());
  }
  out.pressure_power = SmoothPower(out.pressure);
  out.heat_release_power = SmoothPower(out.heat_release);
  return out;
}

}  // namespace howl
