#include "rig/march.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "rig/constants.h"
#include "rig/filters.h"
#include "rig/moving_lines.h"
#include "rig/slow_noise.h"

namespace rig {
namespace {

constexpr double kTapsInRoundTrip = 47.0;
constexpr double kSlowSteps = 64.0;
constexpr double kPeakDamping = 0.12;
constexpr double kWanderSeconds = 0.15;
constexpr double kSecondCornerHz = 12.0;  // of the combustion noise, over the cycle's frequency

}  // namespace

Grid MakeGrid(const Plan& plan, double sampling_hz, int refine) {
  double highest_hz = 0.0;
  for (const Point& point : plan.points) highest_hz = std::max(highest_hz, point.modes.omega_hz);
  const auto base = static_cast<std::size_t>(
      std::max(1.0, std::ceil(2.0 * kTapsInRoundTrip * highest_hz / sampling_hz)));
  Grid grid;
  grid.per_sample = base * static_cast<std::size_t>(refine);
  grid.step_s = 1.0 / (sampling_hz * static_cast<double>(grid.per_sample));
  return grid;
}

TrueSignals March(const Plan& plan, std::size_t index, const Grid& grid, std::size_t settle,
                  std::size_t steps, std::uint64_t seed) {
  const Point& point = plan.points[index];
  const Behaviour& behaviour = plan.behaviour;
  const double step_s = grid.step_s;
  DuctOnGrid duct(plan, point, grid);
  DelayOnGrid delay(behaviour, point.tau_s, step_s);
  const double cycle_hz = point.frequency_hz;
  const auto stream = [&](const char* purpose) { return Random(seed, purpose, index + 1); };

  Noise combustion(plan.combustion_noise * point.flame.saturation, plan.combustion_corner_hz,
                   kSecondCornerHz * cycle_hz, step_s, stream("combustion"));
  Noise further(behaviour.duct_noise * plan.combustion_noise * point.flame.saturation,
                plan.combustion_corner_hz, kSecondCornerHz * cycle_hz, step_s, stream("duct"));
  const auto slow = [&](double rms, double correlation_s, const char* purpose) {
    const double corner_hz = 1.0 / (kTwoPi * correlation_s);
    return Noise(rms, corner_hz, 0.5 * cycle_hz, step_s, stream(purpose));
  };
  Noise gain_noise = slow(behaviour.gain_fluctuation, behaviour.gain_fluctuation_s, "gain");
  Noise delay_noise = slow(behaviour.delay_wander, kWanderSeconds, "delay");
  Noise point_noise = slow(behaviour.point_wander, kWanderSeconds, "point");
  Random switches = stream("switches");
  bool low = false;
  Random phases = stream("phases");
  const double tone_phase = kTwoPi * phases.Uniform();
  Lag flame_lag(behaviour.flame_cutoff_hz, step_s);
  Resonance flame_peak(behaviour.flame_peak_ratio * cycle_hz, kPeakDamping, step_s);
  SideBranch branch(behaviour.side_branch_ratio * point.modes.omega_hz,
                    behaviour.side_branch_damping, behaviour.side_branch_strength * point.modes.N,
                    step_s);
  Envelope p_envelope(cycle_hz, step_s, point.p_amplitude);
  Envelope v_envelope(cycle_hz, step_s, point.rate_amplitude);

  // The past is the cycle, so that the loop starts near where it will stay.
  const std::size_t taps = std::max(duct.reflection.reach(), duct.distribution.reach());
  const double longest = std::max(
      {2.0 * static_cast<double>(taps),
       (2.0 * point.tau_s + behaviour.second_path_extra_s + 6.0 * behaviour.delay_spread_s) /
           step_s,
       behaviour.entropy_delay_s / step_s});
  const std::size_t past = static_cast<std::size_t>(longest) + 16;
  const std::size_t total = past + settle + steps;
  std::vector<double> p(total, 0.0);
  std::vector<double> q(total, 0.0);
  std::vector<double> drive(total, 0.0);
  std::vector<double> duct_p(total, 0.0);
  const Complex g = ModalResponse(point.modes, Complex(0.0, kTwoPi * cycle_hz));
  for (std::size_t n = 0; n < past; ++n) {
    const double angle =
        kTwoPi * cycle_hz * (static_cast<double>(n) - static_cast<double>(past)) * step_s;
    q[n] = drive[n] = point.q_amplitude * std::cos(angle);
    p[n] = duct_p[n] = point.q_amplitude * std::abs(g) * std::cos(angle + std::arg(g));
  }
  const auto entropy_steps =
      static_cast<std::size_t>(std::lround(behaviour.entropy_delay_s / step_s));
  const double record_s = static_cast<double>(steps) * step_s;
  double played = 0.0;
  double amplitude = point.p_amplitude;
  double v_amplitude = point.rate_amplitude;
  const bool duct_moves = duct.moves();
  const bool delay_moves = delay.moves();
  for (std::size_t n = past; n < total; ++n) {
    const double time_s = (static_cast<double>(n) - static_cast<double>(past + settle)) * step_s;
    if (duct_moves && std::fmod(static_cast<double>(n - past), kSlowSteps) == 0.0) {
      const double place = std::clamp(time_s / record_s, 0.0, 1.0) - 0.5;
      duct.Set(1.0 + behaviour.drift_span * place, amplitude / plan.mean_p_amplitude);
    }
    double gain = 1.0;
    if (delay_moves) {
      double factor = 1.0 + behaviour.delay_at_cycle * v_amplitude / plan.mean_rate_amplitude;
      if (behaviour.delay_wander != 0.0) factor += delay_noise.Next();
      if (behaviour.point_wander != 0.0) {
        const double moved = point_noise.Next();
        factor += 0.5 * moved;
        gain += moved;
      }
      delay.Set(std::max(0.2, factor));
    }
    double v = delay.filter(&p[n]);
    if (behaviour.delay_at_cycle != 0.0) v_amplitude = v_envelope.Next(v);
    if (behaviour.flame_play != 0.0) {
      const double half = behaviour.flame_play * point.rate_amplitude;
      played = std::clamp(played, v - half, v + half);
      v = played;
    }
    if (behaviour.gain_fluctuation != 0.0) gain += gain_noise.Next();
    if (behaviour.gain_drop != 0.0) {
      if (switches.Uniform() < step_s / behaviour.gain_dwell_s) low = !low;
      if (low) gain *= 1.0 - behaviour.gain_drop;
    }
    double heat = gain * point.flame(v);
    if (behaviour.flame_peak_gain != 0.0) heat += behaviour.flame_peak_gain * flame_peak.Next(heat);
    if (behaviour.flame_cutoff_hz < kNever) heat = flame_lag.Next(heat);
    q[n] = heat + combustion.Next();
    double driving = q[n];
    if (behaviour.tone != 0.0) {
      driving += behaviour.tone * point.q_amplitude *
                 std::cos(kTwoPi * behaviour.tone_hz * time_s + tone_phase);
    }
    if (behaviour.sweep != 0.0) {
      const double rise = (behaviour.sweep_high_hz - behaviour.sweep_low_hz) / record_s;
      driving +=
          behaviour.sweep * point.q_amplitude *
          std::cos(kTwoPi * (behaviour.sweep_low_hz + 0.5 * rise * time_s) * time_s + tone_phase);
    }
    if (behaviour.duct_noise != 0.0) driving += further.Next();
    if (behaviour.entropy_share != 0.0) driving += behaviour.entropy_share * q[n - entropy_steps];
    drive[n] = driving;
    duct_p[n] = duct.distribution(&drive[n]) + duct.reflection(&duct_p[n]);
    p[n] = duct_p[n];
    if (behaviour.side_branch_strength != 0.0) p[n] += branch.Next(driving);
    if (duct_moves) amplitude = p_envelope.Next(p[n]);
    if (!(std::abs(p[n]) < 1e3 * point.p_amplitude)) {
      throw std::runtime_error(point.name + ": the loop runs away");
    }
  }
  const auto from = static_cast<std::ptrdiff_t>(past + settle);
  return {{p.begin() + from, p.end()}, {q.begin() + from, q.end()}};
}

}  // namespace rig
