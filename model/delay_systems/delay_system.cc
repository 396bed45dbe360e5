#include "model/delay_systems/delay_system.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace howl {

double DelaySystem::LongestDelay() const {
  CHECK(!delays.empty());
  return *std::max_element(delays.begin(), delays.end());
}

DelayTrajectory::DelayTrajectory(const DelaySystem& system, const Eigen::VectorXd& state,
                                 double step)
    : step_(step) {
  CHECK_GT(step, 0.0);
  CHECK_EQ(state.size(), system.dimension);
  for (const double delay : system.delays) CHECK_GE(delay, step);
  const auto past = static_cast<std::size_t>(std::ceil(system.LongestDelay() / step)) + 1;
  first_time_ = -step * static_cast<double>(past);
  states_.assign(past + 1, state);
  rates_before_.assign(past + 1, Eigen::VectorXd::Zero(system.dimension));
  rates_after_ = rates_before_;
}

void DelayTrajectory::Between(std::size_t i, double part, Eigen::VectorXd* x) const {
  const double rest = 1.0 - part;
  *x = (rest * rest * (1.0 + 2.0 * part)) * states_[i] +
       (part * part * (3.0 - 2.0 * part)) * states_[i + 1] +
       (step_ * part * rest) * (rest * rates_after_[i] - part * rates_before_[i + 1]);
}

Eigen::VectorXd DelayTrajectory::At(double time) const {
  const double place = (time - first_time_) / step_;
  CHECK(place >= -1e-9 && place <= static_cast<double>(states_.size() - 1) + 1e-9) << time;
  const auto i = std::min(static_cast<std::size_t>(std::max(place, 0.0)), states_.size() - 2);
  Eigen::VectorXd x;
  Between(i, place - static_cast<double>(i), &x);
  return x;
}

void DelayTrajectory::Continue(const DelaySystem& system, double parameter, double duration) {
  const auto steps = static_cast<std::size_t>(std::llround(duration / step_));
  states_.reserve(states_.size() + steps);
  rates_before_.reserve(states_.size() + steps);
  rates_after_.reserve(states_.size() + steps);
  std::vector<Eigen::VectorXd> delayed(system.delays.size());
  Eigen::VectorXd k2, k3, k4, x, k1_next;
  // `part` of a step after the last state.
  const auto rate = [&](double part, const Eigen::VectorXd& at, Eigen::VectorXd* out) {
    for (std::size_t k = 0; k < delayed.size(); ++k) {
      const double back = system.delays[k] / step_ - part;
      const auto whole = static_cast<std::size_t>(std::ceil(back - 1e-9));
      const std::size_t from = states_.size() - 1 - whole;
      if (whole == 0) {
        delayed[k] = states_.back();
      } else {
        Between(from, std::clamp(static_cast<double>(whole) - back, 0.0, 1.0), &delayed[k]);
      }
    }
    out->resize(system.dimension);
    system.rate(parameter, at, delayed, out);
  };
  rate(0.0, states_.back(), &x);
  rates_after_.back() = x;
  for (std::size_t i = 0; i < steps; ++i) {
    const Eigen::VectorXd& start = states_.back();
    const Eigen::VectorXd k1 = rates_after_.back();
    x = start + 0.5 * step_ * k1;
    rate(0.5, x, &k2);
    x = start + 0.5 * step_ * k2;
    rate(0.5, x, &k3);
    x = start + step_ * k3;
    rate(1.0, x, &k4);
    x = start + step_ / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    states_.push_back(x);
    rates_before_.push_back(k4);  // stands in until the state has its past
    rate(0.0, states_.back(), &k1_next);
    rates_before_.back() = k1_next;
    rates_after_.push_back(k1_next);
  }
}

double DelayTrajectory::Amplitude(const Eigen::VectorXd& c, double duration) const {
  const auto steps = static_cast<std::size_t>(std::llround(duration / step_));
  double largest = 0.0;
  for (std::size_t i = states_.size() - std::min(steps + 1, states_.size()); i < states_.size();
       ++i) {
    largest = std::max(largest, std::abs(c.dot(states_[i])));
  }
  return largest;
}

std::optional<double> DelayTrajectory::Period(const Eigen::VectorXd& c, int periods) const {
  double latest = 0.0;
  int passages = 0;
  Eigen::VectorXd x;
  for (std::size_t i = states_.size() - 1; i-- > 0 && TimeAt(i) >= 0.0;) {
    if (!(c.dot(states_[i]) < 0.0 && c.dot(states_[i + 1]) >= 0.0)) continue;
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = 0.5 * (low + high);
      Between(i, middle, &x);
      (c.dot(x) < 0.0 ? low : high) = middle;
    }
    const double time = TimeAt(i) + step_ * high;
    if (passages == 0) latest = time;
    if (++passages > periods) return (latest - time) / periods;
  }
  return std::nullopt;
}

}  // namespace howl
