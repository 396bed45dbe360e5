// A loop of any number of modes with complex residues, simulated step by step, independently of
// model/: what fits of records are tested against.
//
//   p = sum_k (a_k x_k' + b_k omega_k x_k),   x_k'' + 2 xi_k omega_k x_k' + omega_k^2 x_k = q
//   q(t) = Phi(p'(t - tau)) + n(t),   Phi(v) = -slope range tanh(v / range)
//
// In the middle of the record tau is changed by `drift`, about the stated one. Dampings grow with
// the square of the cycle's amplitude, as 2 p^2 through a lag tells it, tau with the amplitude; all
// frequencies move during the record. The flame's gain may fluctuate about its mean.
// Where a share of p' comes later, Phi is of (1 - share) p'(t - tau) + share p'(t - tau - later);
// where its delays are spread normally, of what it is in the mean over them, by the five values of
// Gauss and Hermite, exact as far as the ninth moment; where the flame lags, what Phi makes of it
// goes through 1 / (1 + s / w_lag).
//
// Each mode takes a step exactly, q being the mean of the step's ends: an error of (omega h)^2 /
// 12, 1e-5 at 200 Hz. n is white noise through a low-pass of fourth order, below the records' rate;
// both sensors have white noise. Frequencies in Hz, a and b in p per q rad/s.
#ifndef HOWL_TESTS_ESTIMATION_RECORD_FIT_MODAL_LOOP_H_
#define HOWL_TESTS_ESTIMATION_RECORD_FIT_MODAL_LOOP_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "estimation/analysis/spectra/record.h"
#include "model/noise/random_stream.h"

namespace howl {

struct ModalLoop {
  struct Mode {
    double omega_hz, xi, a, b;
  };
  std::vector<Mode> modes;
  double tau_s = 0.0;
  double share = 0.0;      // of the second path, before the curve
  double later_s = 0.0;    // which comes later by this
  double spread_s = 0.0;   // of what drives the curve: deviation of its delays
  double lag_hz = 0.0;     // of the flame's answer; 0: none
  double tone = 0.0;       // amplitude in p of an oscillation from outside, which the flame answers
  double tone_hz = 0.0;    // to as to all of p
  double drift = 0.0;      // of tau: so much longer in the record's second half, of tau
  double memory_s = 0.01;  // of the lag
  double damping_per_square = 0.0;   // added to xi
  double delay_per_amplitude = 0.0;  // added to tau, s
  double gain_per_amplitude = 0.0;   // of the flame's answer, added to one
  double frequency_span = 0.0;       // of omega, from the record's start to its end
  double gain_rms = 0.0;             // of the flame's answer, relative: it fluctuates
  double input_gain_rms = 0.0;       // of what drives the flame's curve
  double gain_memory_s = 0.02;       // of both
  double slope = 0.0;
  double range = 1000.0;
  double noise = 0.1;          // of q at saturation, root mean square
  double noise_hz = 800.0;     // the low-pass
  double sensor_noise = 5e-3;  // of each signal's root mean square
  double sampling_hz = 10000.0;

  static constexpr int kSteps = 16;  // of the simulation, for each sample
  double Step() const { return 1.0 / (sampling_hz * kSteps); }

  // The loop but for the flame's slope, with the sign of its feedback.
  std::complex<double> Open(double hz) const { return OpenAt({0.0, 2.0 * std::numbers::pi * hz}); }
  std::complex<double> OpenAt(std::complex<double> s) const {
    std::complex<double> g = 0.0;
    for (const Mode& mode : modes) {
      const double w = 2.0 * std::numbers::pi * mode.omega_hz;
      g += (mode.a * s + mode.b * w) / (s * s + 2.0 * mode.xi * w * s + w * w);
    }
    const std::complex<double> lag =
        lag_hz > 0.0 ? 1.0 / (1.0 + s / (2.0 * std::numbers::pi * lag_hz)) : 1.0;
    return -s * g * std::exp(-s * tau_s) * (1.0 - share + share * std::exp(-s * later_s)) *
           std::exp(0.5 * spread_s * spread_s * s * s) * lag;
  }
};

// The lowest frequency at which the loop's phase lets it oscillate.
inline double CycleFrequency(const ModalLoop& loop, double from_hz, double to_hz) {
  for (double hz = from_hz; hz < to_hz; hz += 0.25) {
    const std::complex<double> here = loop.Open(hz);
    const std::complex<double> there = loop.Open(hz + 0.25);
    if (here.real() > 0.0 && here.imag() > 0.0 && there.imag() <= 0.0) return hz;
  }
  return 0.0;
}

// Where slope Open(s) = 1 next to this frequency, by Newton's method: growth rate and angular
// frequency of small oscillations about rest.
inline std::complex<double> RestRoot(const ModalLoop& loop, double near_hz) {
  std::complex<double> s(0.0, 2.0 * std::numbers::pi * near_hz);
  for (int i = 0; i < 50; ++i) {
    const auto at = [&](double by) { return loop.slope * loop.OpenAt(s + by) - 1.0; };
    s -= at(0.0) * 2e-3 / (at(1e-3) - at(-1e-3));
  }
  return s;
}

inline double RootMeanSquare(const std::vector<double>& x) {
  double sum = 0.0;
  double square = 0.0;
  for (const double value : x) {
    sum += value;
    square += value * value;
  }
  const auto n = static_cast<double>(x.size());
  return std::sqrt(square / n - sum * sum / (n * n));
}

// What comes in between the signals and their sensors' noise.
using ModalInstruments = std::function<void(Record*)>;

inline Record SimulateModalLoop(const ModalLoop& loop, double duration_s, std::uint64_t seed,
                                const ModalInstruments& instruments = {}) {
  struct State {
    double w, xi, a, b;
    double e00, e01, e10, e11, input0, input1;  // over one step
    double x = 0.0, rate = 0.0;
  };
  const double h = loop.Step();
  std::vector<State> states;
  for (const ModalLoop::Mode& mode : loop.modes) {
    const double w = 2.0 * std::numbers::pi * mode.omega_hz;
    const double damped = w * std::sqrt(1.0 - mode.xi * mode.xi);
    const double decay = std::exp(-mode.xi * w * h);
    const double c = decay * std::cos(damped * h);
    const double s = decay * std::sin(damped * h);
    const double lean = mode.xi * w / damped;
    State state{
        w,   mode.xi,   mode.a, mode.b, c + lean * s, s / damped, -w * w / damped * s, c - lean * s,
        0.0, s / damped};
    state.input0 = (1.0 - state.e00) / (w * w);
    states.push_back(state);
  }
  // v of the step before the last is needed tau later, less the step by which q comes after p.
  const auto steps_of = [&](double tau_s) {
    return static_cast<std::size_t>(std::lround(tau_s / h)) - 1;
  };
  const std::size_t early = steps_of((1.0 - 0.5 * loop.drift) * loop.tau_s);
  const std::size_t late = steps_of((1.0 + 0.5 * loop.drift) * loop.tau_s);
  const auto later = static_cast<std::size_t>(std::lround(loop.later_s / h));
  struct Part {
    double share;
    std::size_t later;  // than the least of the delays
  };
  std::vector<Part> parts = {{1.0 - loop.share, 0}, {loop.share, later}};
  std::size_t sooner = 0;
  if (loop.spread_s > 0.0) {
    parts.clear();
    constexpr std::array<double, 5> kNodes = {-2.8569700138728, -1.3556261799743, 0.0,
                                              1.3556261799743, 2.8569700138728};
    constexpr std::array<double, 5> kShares = {0.0112574113277, 0.2220759220056, 0.5333333333333,
                                               0.2220759220056, 0.0112574113277};
    const double step = loop.spread_s / h;
    sooner = static_cast<std::size_t>(std::lround(-kNodes[0] * step));
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      parts.push_back(
          {kShares[i], static_cast<std::size_t>(std::lround((kNodes[i] - kNodes[0]) * step))});
    }
  }
  std::vector<double> past(2 * std::max(early, late) + parts.back().later + 1, 0.0);
  std::size_t newest = 0;
  const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * loop.noise_hz * h);
  // The low-pass of fourth order passes 5/16 of the power of one of first order.
  const double drive = loop.noise * loop.range * loop.slope / std::sqrt(share / 2.0 * 5.0 / 16.0);
  std::array<double, 4> lowpass{};
  const double lag =
      loop.lag_hz > 0.0 ? 1.0 - std::exp(-2.0 * std::numbers::pi * loop.lag_hz * h) : 1.0;
  double burning = 0.0;
  RandomStream random(seed);
  Record out;
  out.sampling_hz = loop.sampling_hz;
  const auto settle = static_cast<std::size_t>(loop.sampling_hz) * ModalLoop::kSteps;
  const auto steps = static_cast<std::size_t>(duration_s * loop.sampling_hz) * ModalLoop::kSteps;
  double q = 0.0;
  double square = 0.0;
  double gain = 0.0;
  double input_gain = 0.0;
  for (std::size_t i = 0; i < settle + steps; ++i) {
    const double added = loop.damping_per_square * square;
    const double place =
        i < settle ? -0.5 : static_cast<double>(i - settle) / static_cast<double>(steps) - 0.5;
    const double moved = 1.0 + loop.frequency_span * place;  // of omega
    const auto damping = [&](const State& m) { return (m.xi + added) * moved; };
    double p = 0.0;
    double rate = 0.0;
    for (const State& m : states) {
      p += m.a * m.rate + m.b * m.w * m.x;
      rate += m.a * (q - 2.0 * damping(m) * m.w * m.rate - moved * moved * m.w * m.w * m.x) +
              m.b * m.w * m.rate;
    }
    if (loop.tone != 0.0) {
      const double tone_rad_s = 2.0 * std::numbers::pi * loop.tone_hz;
      const double turn = tone_rad_s * h * static_cast<double>(i);
      p += loop.tone * std::cos(turn);
      rate -= loop.tone * tone_rad_s * std::sin(turn);
    }
    square += h / loop.memory_s * (2.0 * p * p - square);
    if (i >= settle && (i - settle) % ModalLoop::kSteps == 0) {
      out.pressure.push_back(p);
      out.heat_release.push_back(q);
    }
    past[newest] = rate;
    newest = (newest + 1) % past.size();
    double drawn = drive * random.Normal();
    for (double& stage : lowpass) drawn = stage += share * (drawn - stage);
    const std::size_t delay =
        (i < settle + steps / 2 ? early : late) +
        static_cast<std::size_t>(std::lround(loop.delay_per_amplitude * std::sqrt(square) / h));
    const auto before = [&](std::size_t age) {
      return past[(newest + past.size() - 1 - age) % past.size()];
    };
    double v = 0.0;
    for (const Part& part : parts) v += part.share * before(delay - sooner + part.later);
    const double keep = std::exp(-h / loop.gain_memory_s);
    const auto wander = [&](double rms, double* of) {
      if (rms > 0.0) *of = keep * *of + std::sqrt(1.0 - keep * keep) * rms * random.Normal();
    };
    wander(loop.input_gain_rms, &input_gain);
    v *= 1.0 + input_gain;
    burning += lag * (-loop.slope * loop.range * std::tanh(v / loop.range) - burning);
    wander(loop.gain_rms, &gain);
    const double follows = 1.0 + loop.gain_per_amplitude * std::sqrt(square);
    const double next = (1.0 + gain) * follows * burning + drawn;
    const double mean = 0.5 * (q + next);
    for (State& m : states) {
      const double x = m.e00 * m.x + m.e01 * m.rate + m.input0 * mean;
      m.rate = m.e10 * m.x + m.e11 * m.rate + m.input1 * mean;
      m.x = x;
      m.rate -= h * m.w * (2.0 * (damping(m) - m.xi) * m.rate + (moved * moved - 1.0) * m.w * m.x);
    }
    q = next;
  }
  if (instruments) instruments(&out);
  for (std::vector<double>* signal : {&out.pressure, &out.heat_release}) {
    const double deviation = loop.sensor_noise * RootMeanSquare(*signal);
    for (double& value : *signal) value += deviation * random.Normal();
  }
  return out;
}

// A duct of two modes or more whose first carries a cycle near 203 Hz, 1.5 times beyond its onset.
inline ModalLoop DuctOfModes(int modes) {
  ModalLoop loop;
  loop.modes = {{200.0, 0.06, 300.0, 60.0}, {455.0, 0.04, 40.0, -20.0}};
  if (modes > 2) loop.modes.push_back({640.0, 0.08, 40.0, 10.0});
  if (modes > 3) loop.modes.push_back({930.0, 0.05, 30.0, -15.0});
  loop.tau_s = 0.0033;
  loop.slope = 1.5 / loop.Open(CycleFrequency(loop, 150.0, 300.0)).real();
  return loop;
}

}  // namespace howl

#endif  // HOWL_TESTS_ESTIMATION_RECORD_FIT_MODAL_LOOP_H_
