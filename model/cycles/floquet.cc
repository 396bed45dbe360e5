#include "model/cycles/floquet.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/loop/mode_step.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr int kOrder = 8;
constexpr int kFirst = kFirstNode<kOrder>;  // -3
constexpr int kLast = kFirst + kOrder - 1;  // 4
constexpr int kMinDelaySteps = 2 * kLast;   // the scheme stays explicit

// Rows are linear functionals of the initial state (x_0: 4; p'_0, p'_-1, ...: past). Time is in
// units of 1 / w, w = 2 pi omega, so that p and p' are of one size and the eigenvalues do not lose
// digits to the frequency.
class Monodromy {
 public:
  Monodromy(const ClosedLoop& model, const LimitCycle& cycle, int steps) : steps_(steps) {
    const Acoustics<double>& a = model.loop.acoustics;
    const double w = kRadPerSPerHz * a.omega_hz;
    const double step = w / (cycle.frequency_hz * steps);
    omegas_ = {1.0, a.harmonic_ratio};
    xi_ = a.xi;
    direct_ = (a.N + a.M) / w;
    modes_[0] = MakeModeStep<kOrder>(omegas_[0], a.xi, a.N / w, step);
    modes_[1] = MakeModeStep<kOrder>(omegas_[1], a.xi, a.M / w, step);
    const double delay = model.loop.tau_s * cycle.frequency_hz * steps;
    delay_steps_ = static_cast<int>(std::ceil(delay));
    CHECK_GE(delay_steps_, kMinDelaySteps);
    delay_weights_ = LagrangeWeights<kOrder>(delay_steps_ - delay);
    past_ = delay_steps_ - 2 * kFirst + 1;
    slope_.resize(static_cast<std::size_t>(steps));
    for (int i = 0; i < steps; ++i) {
      const double v = EvaluateHarmonics(cycle.rate, 2.0 * std::numbers::pi * i / steps);
      slope_[static_cast<std::size_t>(i)] = w * FlameSlope(model.flame, v);
    }
  }

  Eigen::MatrixXd Build() const {
    const Eigen::Index dimension = 4 + past_;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Rows rate = Rows::Zero(past_ + steps_, dimension);  // row i: p' at step i - (past - 1)
    for (int i = 0; i < past_; ++i) rate(i, 4 + past_ - 1 - i) = 1.0;
    const auto rate_row = [this](int step) { return step + past_ - 1; };
    Rows heat = Rows::Zero(steps_ + kOrder, dimension);  // row i: q at step i + kFirst
    const auto heat_row = [](int step) { return step - kFirst; };
    const auto fill_heat = [&](int step) {
      auto row = heat.row(heat_row(step));
      for (int j = 0; j < kOrder; ++j) {
        row += delay_weights_[static_cast<std::size_t>(j)] *
               rate.row(rate_row(step - delay_steps_ + j + kFirst));
      }
      row *= slope_[static_cast<std::size_t>((step % steps_ + steps_) % steps_)];
    };
    for (int step = kFirst; step < kLast; ++step) fill_heat(step);

    Rows x = Rows::Zero(4, dimension);
    x.leftCols(4).setIdentity();
    for (int m = 0; m < steps_; ++m) {
      fill_heat(m + kLast);
      auto next_rate = rate.row(rate_row(m + 1));
      next_rate = direct_ * heat.row(heat_row(m + 1));
      for (Eigen::Index mode = 0; mode < 2; ++mode) {
        const auto& s = modes_[static_cast<std::size_t>(mode)];
        const Eigen::RowVectorXd y = x.row(2 * mode);
        const Eigen::RowVectorXd p = x.row(2 * mode + 1);
        x.row(2 * mode) = s.exponential.a * y + s.exponential.b * p;
        x.row(2 * mode + 1) = s.exponential.c * y + s.exponential.d * p;
        for (int j = 0; j < kOrder; ++j) {
          const auto q = heat.row(heat_row(m + j + kFirst));
          x.row(2 * mode) += s.weight_y[static_cast<std::size_t>(j)] * q;
          x.row(2 * mode + 1) += s.weight_p[static_cast<std::size_t>(j)] * q;
        }
        const double omega = omegas_[static_cast<std::size_t>(mode)];
        next_rate -= omega * x.row(2 * mode) + 2.0 * xi_ * omega * x.row(2 * mode + 1);
      }
    }
    Eigen::MatrixXd map(dimension, dimension);
    map.topRows(4) = x;
    for (int i = 0; i < past_; ++i) map.row(4 + i) = rate.row(rate_row(steps_ - i));
    return map;
  }

  int dimension() const { return 4 + past_; }

 private:
  int steps_;
  std::array<double, 2> omegas_{};
  double xi_ = 0.0;
  double direct_ = 0.0;
  std::array<ModeStep<kOrder>, 2> modes_{};
  int delay_steps_ = 0;
  int past_ = 0;
  std::array<double, kOrder> delay_weights_{};
  std::vector<double> slope_;
};

}  // namespace

FloquetMultipliers CycleStability(const ClosedLoop& model, const LimitCycle& cycle,
                                  const FloquetOptions& options) {
  const double delay_periods = model.loop.tau_s * cycle.frequency_hz;
  int steps =
      std::max(options.min_steps, static_cast<int>(std::ceil(kMinDelaySteps / delay_periods)));
  FloquetMultipliers result;
  for (;;) {
    const Monodromy monodromy(model, cycle, steps);
    const Eigen::VectorXcd eigenvalues = Eigenvalues(monodromy.Build());
    result.multipliers.assign(eigenvalues.begin(), eigenvalues.end());
    result.steps = steps;
    const auto trivial = std::min_element(
        result.multipliers.begin(), result.multipliers.end(),
        [](const auto& l, const auto& r) { return std::abs(l - 1.0) < std::abs(r - 1.0); });
    result.trivial_error = std::abs(*trivial - 1.0);
    result.multipliers.erase(trivial);
    std::sort(result.multipliers.begin(), result.multipliers.end(),
              [](const auto& l, const auto& r) { return std::abs(l) > std::abs(r); });
    result.stable = result.leading_modulus() < 1.0;
    if (result.trivial_error <= options.tolerance ||
        2 * monodromy.dimension() > options.max_dimension) {
      return result;
    }
    steps *= 2;
  }
}

}  // namespace howl
