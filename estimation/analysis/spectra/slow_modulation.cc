#include "estimation/analysis/spectra/slow_modulation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kSlowBlockPeriods = 4.0;
constexpr int kMostHarmonics = 3;
// Seven coefficients of a hundred blocks' noise alone lessen the scatter by a few percent.
constexpr double kLeastImprovement = 0.8;
constexpr int kSwingPasses = 3;  // blocks smear a swing, the more so the larger it is

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

// Columns 1, cos theta, sin theta, ... at `rows` times; empty where there are too few rows for the
// harmonics that the blocks resolve.
Eigen::MatrixXd PeriodicBasis(const Blocks& cycle, const SlowOscillation& slow, double sampling_hz,
                              double first_s, Eigen::Index rows) {
  const int resolved = static_cast<int>(0.5 / (cycle.hop_s * slow.frequency_hz));
  const int harmonics = std::clamp(resolved, 1, kMostHarmonics);
  const Eigen::Index columns = 1 + 2 * harmonics;
  if (!Follows(cycle.length_s, slow) || rows < 4 * columns) return {};
  const SlowPhase phase(slow, sampling_hz);
  Eigen::MatrixXd basis(rows, columns);
  for (Eigen::Index b = 0; b < rows; ++b) {
    const double theta = phase.At(first_s + static_cast<double>(b) * cycle.hop_s);
    basis(b, 0) = 1.0;
    for (Eigen::Index k = 1; k <= harmonics; ++k) {
      const double angle = static_cast<double>(k) * theta;
      basis(b, 2 * k - 1) = std::cos(angle);
      basis(b, 2 * k) = std::sin(angle);
    }
  }
  return basis;
}

// Least squares of the phase's steps from block to block on the basis, weighted by their power.
Eigen::VectorXd StepCoefficients(const Blocks& blocks, const Eigen::MatrixXd& basis) {
  const Eigen::Index n = basis.rows();
  std::complex<double> sum = 0.0;
  Eigen::VectorXcd product(n);
  for (Eigen::Index b = 0; b < n; ++b) {
    const auto i = static_cast<std::size_t>(b);
    product(b) = blocks.amplitude[i + 1] * std::conj(blocks.amplitude[i]);
    sum += product(b);
  }
  const Eigen::VectorXd weight = product.cwiseAbs();
  const Eigen::VectorXd steps = (product * std::polar(1.0, -std::arg(sum))).array().arg();
  const Eigen::MatrixXd weighted = weight.asDiagonal() * basis;
  return (basis.transpose() * weighted).ldlt().solve(weighted.transpose() * steps);
}

// One less the coherence of the phase's steps: half their variance where they are small.
double Scatter(const Blocks& blocks) {
  std::complex<double> sum = 0.0;
  double size = 0.0;
  for (std::size_t b = 0; b + 1 < blocks.amplitude.size(); ++b) {
    const std::complex<double> product = blocks.amplitude[b + 1] * std::conj(blocks.amplitude[b]);
    sum += product;
    size += std::abs(product);
  }
  return size > 0.0 ? 1.0 - std::abs(sum) / size : 0.0;
}

}  // namespace

double PeriodicFluctuation(const Blocks& cycle, const SlowOscillation& slow, double sampling_hz) {
  const auto n = static_cast<Eigen::Index>(cycle.amplitude.size());
  const Eigen::MatrixXd basis = PeriodicBasis(cycle, slow, sampling_hz, cycle.first_center_s, n);
  if (basis.size() == 0) return 0.0;
  Eigen::VectorXd power(n);
  for (Eigen::Index b = 0; b < n; ++b) {
    power(b) = std::norm(cycle.amplitude[static_cast<std::size_t>(b)]);
  }
  const Eigen::VectorXd periodic = basis * basis.colPivHouseholderQr().solve(power);
  const double mean = power.mean();
  const double fitted = (periodic.array() - periodic.mean()).square().mean();
  const auto columns = static_cast<double>(basis.cols());
  const double rest = (power - periodic).squaredNorm() / (static_cast<double>(n) - columns);
  // Half-overlapping blocks count as two thirds of their number.
  const double by_chance = 1.5 * rest * (columns - 1.0) / static_cast<double>(n);
  return mean > 0.0 ? std::max(fitted - by_chance, 0.0) / (mean * mean) : 0.0;
}

Blocks WithoutPhaseSwing(std::span<const double> samples, double sampling_hz, double frequency_hz,
                         const Blocks& cycle, const SlowOscillation& slow) {
  const auto n = static_cast<Eigen::Index>(cycle.amplitude.size()) - 1;
  const Eigen::MatrixXd basis =
      PeriodicBasis(cycle, slow, sampling_hz, cycle.first_center_s + 0.5 * cycle.hop_s, n);
  Blocks turned = cycle;
  if (basis.size() == 0) return turned;
  const SlowPhase phase(slow, sampling_hz);
  const Eigen::Index harmonics = (basis.cols() - 1) / 2;
  std::vector<std::complex<double>> swing(static_cast<std::size_t>(harmonics));
  for (int pass = 0; pass < kSwingPasses; ++pass) {
    const Eigen::VectorXd steps = StepCoefficients(turned, basis);
    // A phase of C sin(k theta) - D cos(k theta) goes 2 sin(k pi f hop) (C cos + D sin) further
    // from block to block, theta taken half-way.
    for (Eigen::Index k = 1; k <= harmonics; ++k) {
      const double step = 2.0 * std::sin(static_cast<double>(k) * std::numbers::pi *
                                         slow.frequency_hz * cycle.hop_s);
      swing[static_cast<std::size_t>(k) - 1] +=
          std::complex<double>(steps(2 * k - 1), steps(2 * k)) / step;
    }
    std::vector<std::complex<double>> straight(samples.size());
    for (std::size_t t = 0; t < samples.size(); ++t) {
      const double theta = phase.At(static_cast<double>(t) / sampling_hz);
      double turn = 0.0;
      for (std::size_t k = 0; k < swing.size(); ++k) {
        const double angle = static_cast<double>(k + 1) * theta;
        turn += swing[k].real() * std::sin(angle) - swing[k].imag() * std::cos(angle);
      }
      straight[t] = samples[t] * std::polar(1.0, -turn);
    }
    const int length = static_cast<int>(std::lround(cycle.length_s * sampling_hz));
    Blocks next = turned;
    next.amplitude = Demodulate(straight, sampling_hz, frequency_hz, length).amplitude;
    if (Scatter(next) > (pass == 0 ? kLeastImprovement : 1.0) * Scatter(turned)) break;
    turned = std::move(next);
  }
  return turned;
}

}  // namespace howl
