#include "diagnosis/samples/hum_below_band.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "diagnosis/numerics/hann_power.h"
#include "diagnosis/samples/mains.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {
namespace {

constexpr double kLeastProbability = 1e-6;
// Rectifiers of three phases make the sixth multiple. Where the mains' frequency may be widens with
// the multiple, so that higher ones would take in lines of another origin.
constexpr int kMostMultiple = 6;
constexpr Eigen::Index kBeside = 30;  // bins on each side
constexpr Eigen::Index kReach = 1;    // of a line, on each side of its peak
// Neighbouring values under Hann's window are correlated by 4 / 9, those beside them by 1 / 36.
constexpr double kIndependent = 1.0 / (1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0));

struct Line {
  double power = 0.0;
  bool seen = false;
};

Line LineNear(const Eigen::VectorXd& power, double bin) {
  const double wander = kMainsWander * bin;
  const auto first = static_cast<Eigen::Index>(std::floor(bin - wander));
  const auto last = static_cast<Eigen::Index>(std::ceil(bin + wander));
  // The mean of the signal, and what drifts, fill the first bins.
  const Eigen::Index begin = std::max<Eigen::Index>(first - kReach - kBeside, 3);
  const Eigen::Index end = last + kReach + kBeside + 1;
  if (first - kReach - begin < kBeside / 2 || end > power.size()) return {};
  Eigen::Index peak = 0;
  const double most = power.segment(first, last - first + 1).maxCoeff(&peak);
  peak += first;
  const double beside = power.segment(begin, peak - kReach - begin).sum() +
                        power.segment(peak + kReach + 1, end - peak - kReach - 1).sum();
  const auto count = static_cast<double>(end - begin - 2 * kReach - 1);
  const double mean = beside / count;
  const double independent = kIndependent * count;
  const double log_p = -independent * std::log1p(most / mean / independent);
  const double tried = static_cast<double>(last - first + 1);
  return {power.segment(peak - kReach, 2 * kReach + 1).sum() - (2 * kReach + 1) * mean,
          log_p + std::log(tried) < std::log(kLeastProbability)};
}

}  // namespace

MainsLine HumBelowBand(const std::vector<double>& signal, double sampling_hz, double cycle_hz) {
  const double lowest_hz = RecordScale::kLowestOfCycle * cycle_hz;
  if (lowest_hz <= kMains_hz[0]) return {};
  const double bin_hz = sampling_hz / static_cast<double>(signal.size());
  const Eigen::VectorXd power = HannPower(signal);
  double most = 0.0;
  MainsLine out;
  for (const double mains_hz : kMains_hz) {
    for (int multiple = 1; multiple <= kMostMultiple; ++multiple) {
      const double line_hz = multiple * mains_hz;
      if (line_hz >= lowest_hz) break;
      const Line line = LineNear(power, line_hz / bin_hz);
      if (!line.seen || line.power <= most) continue;
      most = line.power;
      out.frequency_hz = line_hz;
    }
  }
  if (most == 0.0) return {};
  const auto from = static_cast<Eigen::Index>(0.5 * cycle_hz / bin_hz);
  const Eigen::Index to =
      std::min(static_cast<Eigen::Index>(1.5 * cycle_hz / bin_hz), power.size());
  out.of_cycle = std::sqrt(most / power.segment(from, to - from).sum());
  return out;
}

}  // namespace howl
