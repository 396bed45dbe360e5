// Autonomous systems with constant delays (O. Diekmann et al., Delay Equations, 1995):
//
//   x'(t) = f(lambda, x(t), x(t - tau_1), ..., x(t - tau_m)),     x in R^n
//
// integrated by the classical Runge-Kutta scheme of order four. What the right side reads of the
// past between two steps is Hermite's cubic through their states and rates, whose error is of order
// four too (A. Bellen and M. Zennaro, Numerical Methods for Delay Differential Equations, 2003, ch.
// 4 to 6), so that halving the step divides the error by sixteen where f is smooth and the delays
// are whole numbers of steps. No delay is shorter than the step.
//
// Units are the system's own.
#ifndef HOWL_MODEL_DELAY_SYSTEMS_DELAY_SYSTEM_H_
#define HOWL_MODEL_DELAY_SYSTEMS_DELAY_SYSTEM_H_

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace howl {

struct DelaySystem {
  // f: `delayed` has x(t - tau_k) in the order of `delays`, all positive.
  using Rate = std::function<void(double parameter, const Eigen::VectorXd& x,
                                  std::span<const Eigen::VectorXd> delayed, Eigen::VectorXd* rate)>;

  int dimension = 0;
  std::vector<double> delays;
  Rate rate;

  double LongestDelay() const;
};

// States and rates at the steps; time zero is the last step before the integration.
class DelayTrajectory {
 public:
  // Constant over the past, the longest delay long.
  DelayTrajectory(const DelaySystem& system, const Eigen::VectorXd& state, double step);

  // Goes on from its end for `duration`, with this parameter.
  void Continue(const DelaySystem& system, double parameter, double duration);

  double step() const { return step_; }
  double end() const { return TimeAt(states_.size() - 1); }
  const Eigen::VectorXd& last() const { return states_.back(); }
  // From the longest delay before zero to the end.
  Eigen::VectorXd At(double time) const;

  // The largest |c . x| over the last `duration`.
  double Amplitude(const Eigen::VectorXd& c, double duration) const;
  // The mean time between the last `periods` + 1 passages of c . x upwards through zero; none where
  // there are fewer.
  std::optional<double> Period(const Eigen::VectorXd& c, int periods) const;

 private:
  double TimeAt(std::size_t i) const { return first_time_ + step_ * static_cast<double>(i); }
  // At part * step_ after step i, 0 <= part <= 1.
  void Between(std::size_t i, double part, Eigen::VectorXd* x) const;

  double step_;
  double first_time_;
  std::vector<Eigen::VectorXd> states_;
  // The rate jumps where the parameter does, and at time zero.
  std::vector<Eigen::VectorXd> rates_before_;
  std::vector<Eigen::VectorXd> rates_after_;
};

}  // namespace howl

#endif  // HOWL_MODEL_DELAY_SYSTEMS_DELAY_SYSTEM_H_
