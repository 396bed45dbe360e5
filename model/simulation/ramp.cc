#include "model/simulation/ramp.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

namespace howl {

std::unique_ptr<LoopEffect> ParameterRamp::Clone() const {
  return std::make_unique<ParameterRamp>(*this);
}

double ParameterRamp::Factor(double time_s) const {
  const double share = std::clamp((time_s - start_s_) / (end_s_ - start_s_), 0.0, 1.0);
  return first_ + share * (last_ - first_);
}

void ParameterRamp::Parameters(const LoopContext& at, LoopParameters<double>* loop,
                               Flame<double>* flame) {
  const double factor = Factor(at.time_s + 0.5 * kLoopBlock * at.step_s);
  switch (parameter_) {
    case RampedParameter::kOmega:
      loop->acoustics.omega_hz *= factor;
      break;
    case RampedParameter::kXi:
      loop->acoustics.xi *= factor;
      break;
    case RampedParameter::kN:
      loop->acoustics.N *= factor;
      break;
    case RampedParameter::kM:
      loop->acoustics.M *= factor;
      break;
    case RampedParameter::kHarmonicRatio:
      loop->acoustics.harmonic_ratio *= factor;
      break;
    case RampedParameter::kTau:
      break;
    case RampedParameter::kFlameSlope:
      flame->slope *= factor;
      break;
    case RampedParameter::kFlameSaturation:
      flame->saturation *= factor;
      break;
  }
}

void ParameterRamp::Delay(const LoopContext& at, std::span<double> tau_s) {
  for (std::size_t i = 0; i < tau_s.size(); ++i) {
    tau_s[i] *= Factor(at.time_s + static_cast<double>(i) * at.step_s);
  }
}

namespace {

double Mix(double from, double to, double share) { return from + share * (to - from); }

}  // namespace

LoopSchedule::LoopSchedule(std::vector<Point> points) : points_(std::move(points)) {
  CHECK(!points_.empty());
  CHECK(std::is_sorted(points_.begin(), points_.end(),
                       [](const Point& a, const Point& b) { return a.time_s < b.time_s; }));
}

std::unique_ptr<LoopEffect> LoopSchedule::Clone() const {
  return std::make_unique<LoopSchedule>(*this);
}

LoopSchedule::Between LoopSchedule::Find(double time_s) const {
  const auto next = std::upper_bound(points_.begin(), points_.end(), time_s,
                                     [](double t, const Point& p) { return t < p.time_s; });
  if (next == points_.begin()) return {&points_.front(), &points_.front(), 0.0};
  if (next == points_.end()) return {&points_.back(), &points_.back(), 0.0};
  const Point& from = *(next - 1);
  return {&from, &*next, (time_s - from.time_s) / (next->time_s - from.time_s)};
}

void LoopSchedule::Parameters(const LoopContext& at, LoopParameters<double>* loop,
                              Flame<double>* flame) {
  const Between b = Find(at.time_s + 0.5 * kLoopBlock * at.step_s);
  const auto mix = [&b](double from, double to) { return Mix(from, to, b.share); };
  const Acoustics<double>& x = b.from->loop.acoustics;
  const Acoustics<double>& y = b.to->loop.acoustics;
  loop->acoustics = {mix(x.omega_hz, y.omega_hz), mix(x.xi, y.xi), mix(x.N, y.N), mix(x.M, y.M),
                     mix(x.harmonic_ratio, y.harmonic_ratio)};
  loop->tau_s = mix(b.from->loop.tau_s, b.to->loop.tau_s);
  flame->slope = mix(b.from->flame.slope, b.to->flame.slope);
  flame->saturation = mix(b.from->flame.saturation, b.to->flame.saturation);
  flame->offset = mix(b.from->flame.offset, b.to->flame.offset);
}

double LoopSchedule::ShortestDelay(double tau_s) const {
  for (const Point& point : points_) tau_s = std::min(tau_s, point.loop.tau_s);
  return tau_s;
}

double LoopSchedule::LongestDelay(double tau_s) const {
  for (const Point& point : points_) tau_s = std::max(tau_s, point.loop.tau_s);
  return tau_s;
}

void LoopSchedule::Delay(const LoopContext& at, std::span<double> tau_s) {
  for (std::size_t i = 0; i < tau_s.size(); ++i) {
    const Between b = Find(at.time_s + static_cast<double>(i) * at.step_s);
    tau_s[i] = Mix(b.from->loop.tau_s, b.to->loop.tau_s, b.share);
  }
}

}  // namespace howl
