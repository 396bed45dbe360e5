#include "rig/recording.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig/constants.h"
#include "rig/delay_line.h"
#include "rig/filters.h"

namespace rig {
namespace {

constexpr double kAntiAliasReach = 14.0;  // samples of the record on each side
constexpr double kAntiAliasBand = 0.44;   // of the sampling rate, where it has lost half
constexpr double kRingSeconds = 0.05;     // for instruments to forget how they began
constexpr double kDropoutSeconds = 0.004;

double Amplitude(const std::vector<double>& x) {
  double mean = 0.0;
  for (const double value : x) mean += value / static_cast<double>(x.size());
  double square = 0.0;
  for (const double value : x) square += (value - mean) * (value - mean);
  return std::sqrt(2.0 * square / static_cast<double>(x.size()));
}

// Read so many steps late as `steps` says at each of its own.
template <typename Steps>
std::vector<double> ReadLate(const Steps& steps, const std::vector<double>& x) {
  std::vector<double> out(x.size(), 0.0);
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double late = steps(i);
    // Ahead where it is read late, so that the stencil is centred.
    const auto whole = static_cast<std::ptrdiff_t>(std::floor(late)) - 8;
    const Stencil stencil = ValueAt(late - static_cast<double>(whole));
    double sum = 0.0;
    for (std::size_t j = 0; j < kStencil; ++j) {
      const std::ptrdiff_t k = i - whole - stencil.first - static_cast<std::ptrdiff_t>(j);
      sum +=
          stencil.weight[j] * x[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k, 0, n - 1))];
    }
    out[static_cast<std::size_t>(i)] = sum;
  }
  return out;
}

void Skew(double steps, std::vector<double>& x) {
  if (steps != 0.0) x = ReadLate([&](std::ptrdiff_t /*i*/) { return steps; }, x);
}

// As late at the end as it is early at the beginning.
void SkewMoreAndMore(double rate, std::vector<double>& x) {
  if (rate == 0.0) return;
  const double middle = 0.5 * static_cast<double>(x.size());
  x = ReadLate([&](std::ptrdiff_t i) { return rate * (static_cast<double>(i) - middle); }, x);
}

void Echo(double share, double steps, std::vector<double>& x) {
  if (share == 0.0) return;
  const std::vector<double> late = ReadLate([&](std::ptrdiff_t /*i*/) { return steps; }, x);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * late[i];
}

template <typename F>
void Pass(F filter, std::vector<double>& x) {
  for (double& value : x) value = filter.Next(value);
}

void HighPass(double corner_hz, double step_s, std::vector<double>& x) {
  if (corner_hz == 0.0) return;
  Lag lag(corner_hz, step_s);
  for (double& value : x) value -= lag.Next(value);
}

std::vector<double> Decimate(const std::vector<double>& x, std::size_t lead, std::size_t factor,
                             std::size_t samples) {
  std::vector<double> out(samples);
  if (factor == 1) {
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(lead), samples, out.begin());
    return out;
  }
  const auto reach = static_cast<std::size_t>(kAntiAliasReach * static_cast<double>(factor));
  std::vector<double> taps(reach + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k <= reach; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(factor);
    const double sinc =
        k == 0 ? 1.0 : std::sin(2.0 * kPi * kAntiAliasBand * t) / (2.0 * kPi * kAntiAliasBand * t);
    // Blackman's window, 74 dB down beside the main lobe.
    const double u = kPi * (t / kAntiAliasReach + 1.0);
    taps[k] = sinc * (0.42 - 0.5 * std::cos(u) + 0.08 * std::cos(2.0 * u));
    sum += (k == 0 ? 1.0 : 2.0) * taps[k];
  }
  for (double& tap : taps) tap /= sum;
  for (std::size_t i = 0; i < samples; ++i) {
    const double* at = x.data() + lead + i * factor;
    double value = taps[0] * at[0];
    for (std::size_t k = 1; k <= reach; ++k) {
      value += taps[k] * (at[k] + *(at - k));
    }
    out[i] = value;
  }
  return out;
}

void AddNoise(double rms, Random random, std::vector<double>& x) {
  for (double& value : x) value += rms * random.Normal();
}

void AddHum(double amplitude, double hz, double sampling_hz, Random random,
            std::vector<double>& x) {
  if (amplitude == 0.0) return;
  const double phase = 2.0 * kPi * random.Uniform();
  const double third = 2.0 * kPi * random.Uniform();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle = 2.0 * kPi * hz * static_cast<double>(i) / sampling_hz;
    x[i] += amplitude * (std::cos(angle + phase) + 0.3 * std::cos(3.0 * angle + third));
  }
}

void Clip(double level, std::vector<double>& x) {
  if (!std::isfinite(level)) return;
  for (double& value : x) value = std::clamp(value, -level, level);
}

void Quantise(double levels, std::vector<double>& x) {
  if (!std::isfinite(levels)) return;
  double largest = 0.0;
  for (const double value : x) largest = std::max(largest, std::abs(value));
  const double step = 2.0 * largest / levels;
  for (double& value : x) value = step * std::round(value / step);
}

void DropOut(double per_s, double sampling_hz, Random random, std::vector<double>& x) {
  if (per_s == 0.0) return;
  const auto length = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(kDropoutSeconds * sampling_hz)));
  std::size_t left = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (left == 0 && random.Uniform() < per_s / sampling_hz) left = length;
    if (left == 0) continue;
    x[i] = x[i - 1];
    --left;
  }
}

}  // namespace

std::size_t LeadSteps(const Plan& plan, const Grid& grid) {
  const double steps = kRingSeconds / grid.step_s +
                       std::abs(plan.behaviour.q_skew_s) / grid.step_s +
                       (kAntiAliasReach + 2.0) * static_cast<double>(grid.per_sample);
  return static_cast<std::size_t>(steps) + 32;
}

Record Digitise(const Plan& plan, std::size_t index, const Grid& grid, const TrueSignals& signals,
                std::size_t samples, double sampling_hz, std::uint64_t seed) {
  const Behaviour& at = plan.behaviour;
  const auto stream = [&](const char* purpose) { return Random(seed, purpose, index + 1); };
  const double step_s = grid.step_s;
  std::vector<double> p = signals.p;
  std::vector<double> q = signals.q;
  const double p_amplitude = Amplitude(p);
  const double q_amplitude = Amplitude(q);

  Echo(at.p_echo, at.p_echo_s / step_s, p);
  HighPass(at.p_highpass_hz, step_s, p);
  if (std::isfinite(at.p_resonance_hz)) {
    Pass(SecondOrder(at.p_resonance_hz, at.p_resonance_damping, 1.0, 0.0, 0.0, step_s), p);
  }
  HighPass(at.q_highpass_hz, step_s, q);
  if (std::isfinite(at.q_cutoff_hz)) {
    if (at.q_cutoff_order < 1.5) {
      Pass(Lag(at.q_cutoff_hz, step_s), q);
    } else {
      Pass(SecondOrder(at.q_cutoff_hz, std::numbers::sqrt2 / 2.0, 1.0, 0.0, 0.0, step_s), q);
    }
  }
  Skew(at.q_skew_s / step_s, q);
  SkewMoreAndMore(at.q_clock, q);
  if (at.q_compression != 0.0) {
    const double k = at.q_compression / q_amplitude;
    for (double& value : q) value /= 1.0 + k * std::abs(value);
  }
  if (at.q_leak != 0.0) {
    const double leak = at.q_leak * q_amplitude / p_amplitude;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += leak * p[i];
  }

  const std::size_t lead = LeadSteps(plan, grid);
  Record record = {Decimate(p, lead, grid.per_sample, samples),
                   Decimate(q, lead, grid.per_sample, samples)};
  const double p_recorded = Amplitude(record.p);
  const double q_recorded = Amplitude(record.q);
  AddHum(at.p_hum * p_recorded, at.hum_hz, sampling_hz, stream("hum p"), record.p);
  AddHum(at.q_hum * q_recorded, at.hum_hz, sampling_hz, stream("hum q"), record.q);
  AddNoise(plan.sensor_noise * p_recorded, stream("sensor p"), record.p);
  AddNoise(plan.sensor_noise * q_recorded, stream("sensor q"), record.q);
  Clip(at.p_clip * p_recorded, record.p);
  Clip(at.q_clip * q_recorded, record.q);
  Quantise(at.p_levels, record.p);
  DropOut(at.p_dropouts_per_s, sampling_hz, stream("dropouts"), record.p);
  return record;
}

}  // namespace rig
