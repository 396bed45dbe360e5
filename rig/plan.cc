#include "rig/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig/constants.h"

namespace rig {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSaturation = 0.5;
constexpr double kLargestPhaseDeg = 65.0;
constexpr double kSecondGainMax = 0.88;

// arg G + 90 degrees - 360 tau f = -180 degrees.
double TauOf(double frequency_hz, double phase_deg) {
  return (270.0 + phase_deg) / (360.0 * frequency_hz);
}
double PhaseOf(double frequency_hz, double tau_s) { return 360.0 * tau_s * frequency_hz - 270.0; }

// The first mode's natural frequency for which G has this phase at the cycle.
double OmegaFor(Modes modes, double frequency_hz, double phase_deg) {
  double low = 0.55 * frequency_hz;
  double high = 1.8 * frequency_hz;
  for (int i = 0; i < 60; ++i) {
    modes.omega_hz = 0.5 * (low + high);
    const double phase = std::arg(ModalResponse(modes, Complex(0.0, kTwoPi * frequency_hz)));
    (phase < phase_deg * kDegree ? low : high) = modes.omega_hz;
  }
  return 0.5 * (low + high);
}

// What effects that are linear and inside the loop add to it: before the flame ...
Complex DelayFactor(const Behaviour& at, Complex s) {
  return std::exp(0.5 * at.delay_spread_s * at.delay_spread_s * s * s) *
         (1.0 - at.second_path_share +
          at.second_path_share * std::exp(-s * at.second_path_extra_s));
}

// ... and everywhere.
Complex LoopFactor(const Behaviour& at, Complex s) {
  Complex factor = DelayFactor(at, s);
  if (at.flame_cutoff_hz < kNever) factor /= 1.0 + s / (kTwoPi * at.flame_cutoff_hz);
  factor *= 1.0 + at.entropy_share * std::exp(-s * at.entropy_delay_s);
  return factor;
}

// -s G e^(-tau s) with what effects add: positive real where the loop can oscillate.
Complex OpenLoop(const Point& point, const Behaviour& behaviour, double frequency_hz) {
  const Complex s(0.0, kTwoPi * frequency_hz);
  return -s * ModalResponse(point.modes, s) * std::exp(-s * point.tau_s) * LoopFactor(behaviour, s);
}

std::vector<double> Crossings(const Point& point, const Behaviour& behaviour, double low_hz,
                              double high_hz) {
  std::vector<double> found;
  const double step_hz = point.modes.omega_hz / 300.0;
  double before = std::arg(OpenLoop(point, behaviour, low_hz));
  const int steps = static_cast<int>((high_hz - low_hz) / step_hz);
  for (int i = 1; i <= steps; ++i) {
    const double f = low_hz + i * step_hz;
    const double after = std::arg(OpenLoop(point, behaviour, f));
    if ((before > 0.0) != (after > 0.0) && std::abs(before - after) < std::numbers::pi) {
      found.push_back(f - step_hz * after / (after - before));
    }
    before = after;
  }
  return found;
}

double Strength(const Point& point, const Behaviour& behaviour, double frequency_hz) {
  return std::abs(OpenLoop(point, behaviour, frequency_hz));
}

// The flame's slope and the cycle; the largest loop gain at other crossings.
double CloseLoop(const Behaviour& behaviour, double wanted_hz, Point& point) {
  const std::vector<double> all =
      Crossings(point, behaviour, 0.3 * wanted_hz, 6.0 * point.modes.omega_hz);
  double at_hz = wanted_hz;
  double best = 0.0;
  for (const double f : all) {
    if (f < 0.6 * wanted_hz || f > 1.6 * wanted_hz) continue;
    if (Strength(point, behaviour, f) > best) {
      best = Strength(point, behaviour, f);
      at_hz = f;
    }
  }
  const double strength = Strength(point, behaviour, at_hz);
  point.frequency_hz = at_hz;
  point.flame.slope = -point.loop_gain / strength;
  point.rate_amplitude = point.flame.AmplitudeAt(1.0 / point.loop_gain);
  point.p_amplitude = point.rate_amplitude / (kTwoPi * at_hz) /
                      std::abs(DelayFactor(behaviour, Complex(0.0, kTwoPi * at_hz)));
  const Complex response = ModalResponse(point.modes, Complex(0.0, kTwoPi * at_hz));
  point.q_amplitude = point.p_amplitude / std::abs(response);
  point.phase_deg = std::arg(response) / kDegree;
  double other = 0.0;
  for (const double f : all) {
    if (f > 0.6 * wanted_hz && f < 1.6 * wanted_hz) continue;
    other = std::max(other, point.loop_gain * Strength(point, behaviour, f) / strength);
  }
  return other;
}

}  // namespace

Plan MakePlan(const Spec& spec) {
  Plan plan;
  Random draw(spec.seed, "rig");
  const auto drawn = [&](double low, double high, double plain) {
    const double value = draw.Uniform(low, high);
    return spec.scatter ? value : plain;
  };
  double tau_s = 0.0;
  double low_phi = spec.experiments[0].phi;
  double high_phi = low_phi;
  double mean_hz = 0.0;
  for (const Characteristics& each : spec.experiments) {
    tau_s += TauOf(each.frequency_hz, each.phase_deg.value_or(-12.0));
    low_phi = std::min(low_phi, each.phi);
    high_phi = std::max(high_phi, each.phi);
    mean_hz += each.frequency_hz;
  }
  tau_s *= drawn(0.97, 1.03, 1.0) / static_cast<double>(spec.experiments.size());
  mean_hz /= static_cast<double>(spec.experiments.size());
  const double frequency_factor = drawn(0.98, 1.02, 1.0);
  const double gain_factor = drawn(0.85, 1.15, 1.0);
  const double xi = drawn(0.08, 0.2, 0.12);
  const double xi_slope = drawn(0.0, 0.4, 0.2);
  double second = drawn(0.18, 0.3, 0.22);
  const double shape = drawn(0.0, static_cast<double>(FlameShapeNames().size()), 0.5);
  plan.combustion_noise = drawn(0.035, 0.075, 0.055);
  plan.combustion_corner_hz = mean_hz * drawn(2.5, 5.0, 3.5);
  plan.sensor_noise = drawn(0.003, 0.006, 0.004);
  if (spec.combustion_noise) plan.combustion_noise = *spec.combustion_noise;
  if (spec.sensor_noise) plan.sensor_noise = *spec.sensor_noise;
  std::vector<double> loop_gains;
  for (std::size_t k = 0; k < spec.experiments.size(); ++k) {
    loop_gains.push_back(drawn(1.18, 1.5, 1.3));
  }

  const DrawScales scales{mean_hz, tau_s, spec.experiments.size()};
  for (const EffectRequest& request : spec.effects) {
    Random random(spec.seed, "effect " + request.id);
    plan.effects.emplace_back(
        request.id, request.parameters
                        ? *request.parameters
                        : DrawEffect(FindEffect(request.id), request.severity, scales, random));
    ApplyEffect(plan.effects.back().first, plan.effects.back().second, plan.behaviour);
  }
  const Behaviour& behaviour = plan.behaviour;

  // A second mode that would take over is made weaker.
  for (int attempt = 0; attempt < 12; ++attempt, second *= 0.8) {
    plan.points.clear();
    double other = 0.0;
    for (std::size_t k = 0; k < spec.experiments.size(); ++k) {
      const Characteristics& wanted = spec.experiments[k];
      Point point;
      point.name = wanted.name;
      point.phi = wanted.phi;
      point.position =
          high_phi > low_phi ? (wanted.phi - low_phi) / (high_phi - low_phi) - 0.5 : 0.0;
      double cycle_hz = wanted.frequency_hz * frequency_factor;
      double phase_deg = PhaseOf(cycle_hz, tau_s);
      if (std::abs(phase_deg) > kLargestPhaseDeg) {
        phase_deg = std::copysign(kLargestPhaseDeg, phase_deg);
        cycle_hz = (270.0 + phase_deg) / (360.0 * tau_s);
      }
      Modes& modes = point.modes;
      modes = {cycle_hz, xi * (1.0 + xi_slope * point.position), 1.0, second, 3.0, 1.0};
      modes.omega_hz = OmegaFor(modes, cycle_hz, phase_deg);
      modes.N = wanted.gain * gain_factor /
                std::abs(ModalResponse(modes, Complex(0.0, kTwoPi * cycle_hz)));
      modes.M *= modes.N;
      // The effects' part.
      modes.ratio = behaviour.second_mode_ratio;
      modes.second_xi_factor = behaviour.second_mode_damping;
      point.tau_s = tau_s * (1.0 + behaviour.delay_phi_span * point.position);
      if (behaviour.odd_point != 0.0 && k == static_cast<std::size_t>(behaviour.odd_point_index)) {
        point.tau_s *= 1.0 + behaviour.odd_point;
      }
      point.flame = {spec.flame.value_or(static_cast<FlameShape>(shape)), -1.0, kSaturation};
      point.loop_gain = loop_gains[k];
      other = std::max(other, CloseLoop(behaviour, cycle_hz, point));
      // At the cycle's amplitude the damping is what it would be without the effect.
      modes.xi = std::max(0.4 * modes.xi, modes.xi - behaviour.damping_at_cycle);
      plan.points.push_back(point);
    }
    if (other < kSecondGainMax) break;
  }
  for (const Point& point : plan.points) {
    plan.mean_p_amplitude += point.p_amplitude / static_cast<double>(plan.points.size());
    plan.mean_rate_amplitude += point.rate_amplitude / static_cast<double>(plan.points.size());
  }
  return plan;
}

}  // namespace rig
