#include "model/loop/instrument.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/loop/mode_step.h"

namespace howl {

std::unique_ptr<Instrument> GainInstrument::Clone() const {
  return std::make_unique<GainInstrument>(*this);
}

void GainInstrument::ApplyToChannel(double /*time_s*/, std::span<double> signal) {
  for (double& x : signal) x *= gain_;
}

std::unique_ptr<Instrument> ClippingInstrument::Clone() const {
  return std::make_unique<ClippingInstrument>(*this);
}

void ClippingInstrument::ApplyToChannel(double /*time_s*/, std::span<double> signal) {
  for (double& x : signal) x = std::clamp(x, -limit_, limit_);
}

std::unique_ptr<Instrument> FirstOrderLowPass::Clone() const {
  return std::make_unique<FirstOrderLowPass>(*this);
}

void FirstOrderLowPass::Start(double rate_hz, std::uint64_t /*seed*/) {
  CHECK_GT(cutoff_hz_, 0.0);
  const double z = 2.0 * std::numbers::pi * cutoff_hz_ / rate_hz;
  decay_ = std::exp(-z);
  // Of integral exp(-z (1 - s)) (x (1 - s) + x' s) z ds.
  weight_after_ = 1.0 + std::expm1(-z) / z;
  weight_before_ = -std::expm1(-z) - weight_after_;
  first_ = true;
}

void FirstOrderLowPass::ApplyToChannel(double /*time_s*/, std::span<double> signal) {
  if (std::isinf(cutoff_hz_)) return;
  for (double& x : signal) {
    if (first_) {  // as if the first value had always been there
      output_ = x;
      first_ = false;
    } else {
      output_ = decay_ * output_ + weight_before_ * input_ + weight_after_ * x;
    }
    input_ = x;
    x = output_;
  }
}

std::unique_ptr<Instrument> FirstOrderHighPass::Clone() const {
  return std::make_unique<FirstOrderHighPass>(*this);
}

void FirstOrderHighPass::Start(double rate_hz, std::uint64_t seed) {
  if (cutoff_hz_ > 0.0) slow_.Start(rate_hz, seed);
}

void FirstOrderHighPass::ApplyToChannel(double time_s, std::span<double> signal) {
  if (cutoff_hz_ == 0.0) return;
  slow_signal_.assign(signal.begin(), signal.end());
  // Low-passes act on one channel alone, whichever of the two they are given it as.
  slow_.Apply(time_s, slow_signal_, slow_signal_);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] -= slow_signal_[i];
}

std::unique_ptr<Instrument> SecondOrderResponse::Clone() const {
  return std::make_unique<SecondOrderResponse>(*this);
}

void SecondOrderResponse::Start(double rate_hz, std::uint64_t /*seed*/) {
  CHECK_GT(frequency_hz_, 0.0);
  first_ = true;
  if (std::isinf(frequency_hz_)) return;
  // The acoustic mode's propagator with N = omega: y' = w p, p' = -w y - 2 zeta w p + w x, whose
  // y is the response.
  const double w0 = 2.0 * std::numbers::pi * frequency_hz_;
  const ModeStep<2> step = MakeModeStep<2>(w0, zeta_, w0, 1.0 / rate_hz);
  e_[0] = step.exponential.a;
  e_[1] = step.exponential.b;
  e_[2] = step.exponential.c;
  e_[3] = step.exponential.d;
  before_[0] = step.weight_y[0];
  before_[1] = step.weight_p[0];
  after_[0] = step.weight_y[1];
  after_[1] = step.weight_p[1];
}

void SecondOrderResponse::ApplyToChannel(double /*time_s*/, std::span<double> signal) {
  if (std::isinf(frequency_hz_)) return;
  for (double& x : signal) {
    if (first_) {
      state_[0] = x;
      state_[1] = 0.0;
      first_ = false;
    } else {
      const double y = e_[0] * state_[0] + e_[1] * state_[1] + before_[0] * input_ + after_[0] * x;
      state_[1] = e_[2] * state_[0] + e_[3] * state_[1] + before_[1] * input_ + after_[1] * x;
      state_[0] = y;
    }
    input_ = x;
    x = state_[0];
  }
}

}  // namespace howl
