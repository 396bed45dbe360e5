#include "model/simulation/sweep.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <span>

#include "model/numerics/fft.h"
#include "model/simulation/ramp.h"

namespace howl {
namespace {

// Of one line it is no more than a swept parameter moves it from window to window, and the cycles
// of one loop lie farther apart.
constexpr double kSameLine = 0.1;
// Amplitudes on one cycle differ by what noise leaves; between two cycles, or a cycle and rest, by
// more.
constexpr double kSameAmplitude = 1.5;
// Below this share of the sweep's largest amplitude the strongest line is noise.
constexpr double kLeastAmplitude = 0.1;

bool IsSameLine(double a_hz, double b_hz) {
  return std::abs(a_hz - b_hz) <= kSameLine * std::max(a_hz, b_hz);
}

double LargestAmplitude(const std::vector<SweepWindow>& windows) {
  double largest = 0.0;
  for (const SweepWindow& window : windows) largest = std::max(largest, window.pressure_amplitude);
  return largest;
}

struct Line {
  double frequency_hz = 0.0;
  double amplitude = 0.0;
};

// By a Hann window, whose transform at d bins from a line is sinc(d) / (1 - d^2): the two largest
// neighbours give d, and that the amplitude (Grandke 1983). Exact for a line far from others.
Line StrongestLine(std::span<const double> p, double sampling_hz) {
  const std::size_t n = p.size();
  double mean = 0.0;
  for (const double value : p) mean += value / static_cast<double>(n);
  std::vector<double> tapered(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle =
        2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    tapered[i] = (p[i] - mean) * (1.0 - std::cos(angle));
  }
  std::vector<std::complex<double>> spectrum(n / 2 + 1);
  Fft().Forward(tapered, spectrum);
  std::size_t top = 2;
  for (std::size_t k = 2; k + 2 < n / 2; ++k) {
    if (std::norm(spectrum[k]) > std::norm(spectrum[top])) top = k;
  }
  const double left = std::abs(spectrum[top - 1]);
  const double middle = std::abs(spectrum[top]);
  const double right = std::abs(spectrum[top + 1]);
  if (!(middle > 0.0)) return {};
  const double ratio = std::max(left, right) / middle;
  const double distance = std::clamp((2.0 * ratio - 1.0) / (1.0 + ratio), 0.0, 0.5);
  const double lobe = distance > 0.0
                          ? std::sin(std::numbers::pi * distance) / (std::numbers::pi * distance) /
                                (1.0 - distance * distance)
                          : 1.0;
  return {(static_cast<double>(top) + (right > left ? distance : -distance)) * sampling_hz /
              static_cast<double>(n),
          2.0 * middle / (lobe * static_cast<double>(n))};
}

}  // namespace

ClosedLoop WithParameter(const ClosedLoop& model, SweptParameter parameter, double value) {
  ClosedLoop out = model;
  Acoustics<double>& acoustics = out.loop.acoustics;
  switch (parameter) {
    case SweptParameter::kOmega:
      acoustics.omega_hz = value;
      break;
    case SweptParameter::kXi:
      acoustics.xi = value;
      break;
    case SweptParameter::kN:
      acoustics.N = value;
      break;
    case SweptParameter::kM:
      acoustics.M = value;
      break;
    case SweptParameter::kMOverN:
      acoustics.M = value * acoustics.N;
      break;
    case SweptParameter::kHarmonicRatio:
      acoustics.harmonic_ratio = value;
      break;
    case SweptParameter::kTau:
      out.loop.tau_s = value;
      break;
    case SweptParameter::kSlopeFactor:
      out.flame.slope *= value;
      break;
  }
  return out;
}

std::vector<SweepWindow> SweepInTime(const SimulationCase& start, SweptParameter parameter,
                                     const SweepOptions& options) {
  CHECK_GT(options.one_way_s, 0.0);
  CHECK_GE(options.steps, 2);
  SimulationCase one = start;
  const auto at = [&](double value) { return WithParameter(start.rig.model, parameter, value); };
  const auto point = [&](double time_s, double value) {
    const ClosedLoop model = at(value);
    return LoopSchedule::Point{time_s, model.loop, model.flame};
  };
  one.rig.model = at(options.from);
  // First: effects of the rig act on the loop as it is at the time.
  one.rig.effects.insert(one.rig.effects.begin(),
                         std::make_shared<LoopSchedule>(std::vector<LoopSchedule::Point>{
                             point(0.0, options.from), point(options.one_way_s, options.to),
                             point(2.0 * options.one_way_s, options.from)}));
  const SimulatedRecord record = Simulate(one, {.duration_s = 2.0 * options.one_way_s,
                                                .sampling_hz = options.sampling_hz,
                                                .settle_s = options.settle_s});

  std::vector<SweepWindow> windows;
  const auto count = 2 * static_cast<std::size_t>(options.steps);
  const std::size_t length = record.pressure.size() / count;
  CHECK_GE(length, 16u) << "the sweep's windows are too short";
  for (std::size_t k = 0; k < count; ++k) {
    const Line line =
        StrongestLine(std::span(record.pressure).subspan(k * length, length), record.sampling_hz);
    const bool back = k >= count / 2;
    const double share = (static_cast<double>(back ? count - 1 - k : k) + 0.5) / options.steps;
    windows.push_back({back, options.from + share * (options.to - options.from), line.frequency_hz,
                       line.amplitude});
  }
  return windows;
}

std::vector<SweepJump> FindJumps(const std::vector<SweepWindow>& windows) {
  const double least = kLeastAmplitude * LargestAmplitude(windows);
  std::vector<SweepJump> jumps;
  for (std::size_t k = 1; k < windows.size(); ++k) {
    const SweepWindow& before = windows[k - 1];
    const SweepWindow& after = windows[k];
    if (std::min(before.pressure_amplitude, after.pressure_amplitude) < least) continue;
    if (IsSameLine(before.frequency_hz, after.frequency_hz)) continue;
    jumps.push_back({after.back, 0.5 * (before.parameter + after.parameter), before.frequency_hz,
                     after.frequency_hz});
  }
  return jumps;
}

std::vector<ParameterInterval> FindHysteresis(const std::vector<SweepWindow>& windows,
                                              const SweepOptions& options) {
  const double least = kLeastAmplitude * LargestAmplitude(windows);
  const double half_step = 0.5 * std::abs(options.to - options.from) / options.steps;
  std::vector<ParameterInterval> intervals;
  for (std::size_t k = 0; k < windows.size() / 2; ++k) {
    const SweepWindow& there = windows[k];
    const SweepWindow& back = windows[windows.size() - 1 - k];
    const double larger = std::max(there.pressure_amplitude, back.pressure_amplitude);
    const double smaller = std::min(there.pressure_amplitude, back.pressure_amplitude);
    const bool differ =
        larger > kSameAmplitude * smaller || !IsSameLine(there.frequency_hz, back.frequency_hz);
    if (larger < least || !differ) continue;
    intervals.push_back({there.parameter - half_step, there.parameter + half_step});
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const auto& a, const auto& b) { return a.lo < b.lo; });
  std::vector<ParameterInterval> merged;
  for (const ParameterInterval& each : intervals) {
    if (!merged.empty() && each.lo <= merged.back().hi + half_step) {
      merged.back().hi = each.hi;
    } else {
      merged.push_back(each);
    }
  }
  return merged;
}

}  // namespace howl
