#include "estimation/analysis/slow_modulation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "model/units.h"

namespace howl {
namespace {

constexpr double kSlowBlockPeriods = 4.0;
constexpr int kMostHarmonics = 3;

// The slow oscillation's phase at time t, from the complex amplitudes of its own blocks.
class SlowPhase {
 public:
  SlowPhase(const SlowOscillation& slow, double sampling_hz)
      : frequency_hz_(slow.frequency_hz),
        blocks_(Demodulate(
            slow.samples, sampling_hz, slow.frequency_hz,
            std::min(static_cast<int>(kSlowBlockPeriods / slow.frequency_hz * sampling_hz),
                     static_cast<int>(slow.samples.size() / 2)))) {}

  double At(double time_s) const {
    const auto last = static_cast<double>(blocks_.amplitude.size() - 1);
    const double place = std::clamp((time_s - blocks_.first_center_s) / blocks_.hop_s, 0.0, last);
    const auto i = static_cast<std::size_t>(std::min(place, std::max(last - 1.0, 0.0)));
    const double part = place - static_cast<double>(i);
    const std::complex<double> next =
        blocks_.amplitude[std::min(i + 1, blocks_.amplitude.size() - 1)];
    return std::arg((1.0 - part) * blocks_.amplitude[i] + part * next) +
           kRadPerSPerHz * frequency_hz_ * time_s;
  }

 private:
  double frequency_hz_;
  Blocks blocks_;
};

}  // namespace

double PeriodicFluctuation(const Blocks& cycle, const SlowOscillation& slow, double sampling_hz) {
  if (!Follows(cycle.length_s, slow)) return 0.0;
  const auto n = static_cast<Eigen::Index>(cycle.amplitude.size());
  const int resolved = static_cast<int>(0.5 / (cycle.hop_s * slow.frequency_hz));
  const int harmonics = std::clamp(resolved, 1, kMostHarmonics);
  const Eigen::Index columns = 1 + 2 * harmonics;
  if (n < 4 * columns) return 0.0;
  const SlowPhase phase(slow, sampling_hz);
  Eigen::MatrixXd basis(n, columns);
  Eigen::VectorXd power(n);
  for (Eigen::Index b = 0; b < n; ++b) {
    const double theta = phase.At(cycle.first_center_s + static_cast<double>(b) * cycle.hop_s);
    basis(b, 0) = 1.0;
    for (int k = 1; k <= harmonics; ++k) {
      basis(b, 2 * k - 1) = std::cos(k * theta);
      basis(b, 2 * k) = std::sin(k * theta);
    }
    power(b) = std::norm(cycle.amplitude[static_cast<std::size_t>(b)]);
  }
  const Eigen::VectorXd periodic = basis * basis.colPivHouseholderQr().solve(power);
  const double mean = power.mean();
  const double fitted = (periodic.array() - periodic.mean()).square().mean();
  const double rest = (power - periodic).squaredNorm() / static_cast<double>(n - columns);
  // Half-overlapping blocks count as two thirds of their number.
  const double by_chance = 1.5 * rest * static_cast<double>(columns - 1) / static_cast<double>(n);
  return mean > 0.0 ? std::max(fitted - by_chance, 0.0) / (mean * mean) : 0.0;
}

}  // namespace howl
