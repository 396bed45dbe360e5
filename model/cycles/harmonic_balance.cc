#include "model/cycles/harmonic_balance.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "model/cycles/balance_equations.h"
#include "model/loop/crossings.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using internal::BalanceState;

bool Newton(const ClosedLoop& model, const HarmonicBalanceOptions& options, BalanceState* state) {
  const double scale = internal::RateScale(model.flame);
  Eigen::VectorXd u = internal::PackState(*state, scale);
  Eigen::MatrixXd jacobian;
  for (int i = 0; i < options.max_iterations; ++i) {
    const Eigen::VectorXd r = internal::BalanceResiduals(model, *state, &jacobian);
    Eigen::VectorXd step = SolveByLu(jacobian, r);
    if (!step.allFinite()) return false;
    // Far from the solution: neither leave the neighbourhood of the frequency nor jump past rest.
    const double limit = std::max(std::abs(step(1)) / 0.05, std::abs(step(0)) / (0.5 * u(0)));
    if (limit > 1.0) step /= limit;
    u -= step;
    *state = internal::UnpackState(u, scale);
    if (step.cwiseAbs().maxCoeff() < 0.1 * options.tolerance * std::max(1.0, u(0))) {
      return u(0) > 1e-9;
    }
  }
  return false;
}

std::optional<LimitCycle> Solve(const ClosedLoop& model, BalanceState state,
                                const HarmonicBalanceOptions& options) {
  for (;;) {
    if (!Newton(model, options, &state)) return std::nullopt;
    if (internal::Tail(state.rate) <= options.tolerance) {
      return internal::MakeLimitCycle(model, state);
    }
    const int next = 2 * (static_cast<int>(state.rate.size()) - 1);
    if (next > options.max_harmonics) return std::nullopt;
    state.rate.resize(static_cast<std::size_t>(next) + 1, 0.0);
  }
}

// The describing function against amplitude, from nearly linear to far in saturation.
class DescribingTable {
 public:
  explicit DescribingTable(const Flame<double>& flame) {
    const double scale = internal::RateScale(flame);
    constexpr double kRatio = 1.15;
    for (double a = 0.003; a < 300.0; a *= kRatio) {
      const double amplitude = a * scale;
      amplitudes_.push_back(amplitude);
      gains_.push_back(std::abs(DescribingFunction(flame, amplitude, 256)));
    }
  }

  // Amplitudes at which |L| D(A) = 1: one for flames that only flatten, two where the flame is
  // steeper at some amplitude than at rest.
  std::vector<double> Solutions(double loop_magnitude) const {
    std::vector<double> solutions;
    for (std::size_t i = 1; i < gains_.size(); ++i) {
      const double before = std::log(loop_magnitude * gains_[i - 1]);
      const double after = std::log(loop_magnitude * gains_[i]);
      if (before * after > 0.0 || before == after) continue;
      const double share = before / (before - after);
      solutions.push_back(amplitudes_[i - 1] *
                          std::pow(amplitudes_[i] / amplitudes_[i - 1], share));
    }
    return solutions;
  }

 private:
  std::vector<double> amplitudes_;
  std::vector<double> gains_;
};

}  // namespace

std::optional<LimitCycle> SolveLimitCycle(const ClosedLoop& model, double frequency_guess_hz,
                                          double rate_amplitude_guess,
                                          const HarmonicBalanceOptions& options) {
  CHECK_GT(frequency_guess_hz, 0.0);
  CHECK_GT(rate_amplitude_guess, 0.0);
  BalanceState state;
  state.frequency_hz = frequency_guess_hz;
  state.rate.assign(static_cast<std::size_t>(options.min_harmonics) + 1, 0.0);
  state.rate[1] = rate_amplitude_guess;
  return Solve(model, std::move(state), options);
}

std::optional<LimitCycle> RefineLimitCycle(const ClosedLoop& model, const LimitCycle& start,
                                           const HarmonicBalanceOptions& options) {
  return Solve(model, {start.rate, start.frequency_hz}, options);
}

std::vector<LimitCycle> LimitCycles(const ClosedLoop& model, double frequency_max_hz,
                                    const HarmonicBalanceOptions& options) {
  std::vector<LimitCycle> cycles;
  const double slope = FlameSlope(model.flame, 0.0);
  const DescribingTable table(model.flame);
  const auto add = [&](LimitCycle cycle) {
    if (cycle.frequency_hz > 1.05 * frequency_max_hz) return;
    const bool known = std::any_of(cycles.begin(), cycles.end(), [&](const LimitCycle& other) {
      return std::abs(other.frequency_hz - cycle.frequency_hz) < 1e-6 * cycle.frequency_hz &&
             std::abs(other.rate_amplitude() - cycle.rate_amplitude()) <
                 1e-6 * cycle.rate_amplitude();
    });
    if (!known) cycles.push_back(std::move(cycle));
  };
  for (const PhaseCrossing& crossing : PhaseCrossings(model.loop, slope, frequency_max_hz)) {
    for (const double amplitude : table.Solutions(crossing.gain / std::abs(slope))) {
      auto cycle = SolveLimitCycle(model, crossing.frequency_hz, amplitude, options);
      if (cycle) add(std::move(*cycle));
    }
  }
  std::sort(cycles.begin(), cycles.end(), [](const LimitCycle& l, const LimitCycle& r) {
    return l.frequency_hz < r.frequency_hz;
  });
  return cycles;
}

double EvaluateHarmonics(const std::vector<std::complex<double>>& series, double theta) {
  double value = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double angle = static_cast<double>(k) * theta;
    value += series[k].real() * std::cos(angle) - series[k].imag() * std::sin(angle);
  }
  return value;
}

}  // namespace howl
