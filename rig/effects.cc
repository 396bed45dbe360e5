#include "rig/effects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace rig {
namespace {

constexpr double kSmall = 0.25;
constexpr double kMedium = 0.55;
constexpr double kLarge = 0.85;
constexpr double kScatter = 1.15;

using Setter = double Behaviour::*;

// Which number of Behaviour each parameter of each effect is.
const std::map<std::string, std::map<std::string, Setter>>& Numbers() {
  static const std::map<std::string, std::map<std::string, Setter>> numbers = {
      {"q_sensor_lowpass",
       {{"cutoff_hz", &Behaviour::q_cutoff_hz}, {"order", &Behaviour::q_cutoff_order}}},
      {"flame_lowpass", {{"cutoff_hz", &Behaviour::flame_cutoff_hz}}},
      {"p_sensor_resonance",
       {{"f0_hz", &Behaviour::p_resonance_hz}, {"zeta", &Behaviour::p_resonance_damping}}},
      {"channel_skew", {{"skew_s", &Behaviour::q_skew_s}}},
      {"extra_acoustic_mode",
       {{"ratio", &Behaviour::side_branch_ratio},
        {"coeff_over_N", &Behaviour::side_branch_strength},
        {"zeta", &Behaviour::side_branch_damping}}},
      {"mode_detuning", {{"ratio", &Behaviour::second_mode_ratio}}},
      {"delay_dispersion", {{"sigma_s", &Behaviour::delay_spread_s}}},
      {"delay_varies_with_phi", {{"rel_span", &Behaviour::delay_phi_span}}},
      {"amplitude_dependent_delay", {{"rel_at_cycle", &Behaviour::delay_at_cycle}}},
      {"nonlinear_damping", {{"xi_add_at_cycle", &Behaviour::damping_at_cycle}}},
      {"parametric_noise",
       {{"rel_rms", &Behaviour::gain_fluctuation},
        {"correlation_s", &Behaviour::gain_fluctuation_s}}},
      {"slow_drift", {{"rel_span", &Behaviour::drift_span}}},
      {"intermittency",
       {{"gain_drop", &Behaviour::gain_drop}, {"dwell_s", &Behaviour::gain_dwell_s}}},
      {"p_clipping", {{"fraction", &Behaviour::p_clip}}},
      {"q_clipping", {{"fraction", &Behaviour::q_clip}}},
      {"quantisation", {{"levels", &Behaviour::p_levels}}},
      {"mains_hum",
       {{"rel_p", &Behaviour::p_hum}, {"rel_q", &Behaviour::q_hum}, {"hz", &Behaviour::hum_hz}}},
      {"crosstalk_p_to_q", {{"rel", &Behaviour::q_leak}}},
      {"second_delay_path",
       {{"share", &Behaviour::second_path_share}, {"extra_s", &Behaviour::second_path_extra_s}}},
      {"external_tone", {{"rel", &Behaviour::tone}, {"hz", &Behaviour::tone_hz}}},
      {"x_entropy_wave",
       {{"rel", &Behaviour::entropy_share}, {"delay_s", &Behaviour::entropy_delay_s}}},
      {"own_damping", {{"factor", &Behaviour::second_mode_damping}}},
      {"x_flame_resonance",
       {{"gain", &Behaviour::flame_peak_gain}, {"ratio", &Behaviour::flame_peak_ratio}}},
      {"x_flame_play", {{"rel", &Behaviour::flame_play}}},
      {"x_delay_wander", {{"rel_rms", &Behaviour::delay_wander}}},
      {"duct_noise", {{"rel", &Behaviour::duct_noise}}},
      {"x_swept_source",
       {{"rel", &Behaviour::sweep},
        {"low_hz", &Behaviour::sweep_low_hz},
        {"high_hz", &Behaviour::sweep_high_hz}}},
      {"p_sensor_highpass", {{"cutoff_hz", &Behaviour::p_highpass_hz}}},
      {"p_dropouts", {{"per_s", &Behaviour::p_dropouts_per_s}}},
      {"x_p_echo", {{"share", &Behaviour::p_echo}, {"delay_s", &Behaviour::p_echo_s}}},
      {"x_q_clock", {{"rel", &Behaviour::q_clock}}},
      {"q_sensor_highpass", {{"cutoff_hz", &Behaviour::q_highpass_hz}}},
      {"x_q_compression", {{"rel", &Behaviour::q_compression}}},
      {"x_point_wander", {{"rel_rms", &Behaviour::point_wander}}},
      {"x_odd_point", {{"rel", &Behaviour::odd_point}, {"index", &Behaviour::odd_point_index}}}};
  return numbers;
}

}  // namespace

const std::vector<EffectInfo>& Effects() {
  static const std::vector<EffectInfo> effects = {
      {"q_sensor_lowpass", "q_instrument", true, "cutoff_hz", 1500, 450, 240},
      {"flame_lowpass", "flame", true, "cutoff_hz", 2500, 700, 340},
      {"p_sensor_resonance", "p_instrument", true, "f0_hz", 2000, 1100, 760},
      {"channel_skew", "q_instrument", true, "skew_s", 4e-5, 1.8e-4, 4e-4},
      {"extra_acoustic_mode", "acoustics", true, "coeff_over_N", 0.04, 0.15, 0.3},
      {"mode_detuning", "acoustics", true, "ratio", 0.06, 0.22, 0.42},
      {"delay_dispersion", "delay", true, "sigma_s", 1.2e-4, 2.6e-4, 4e-4},
      {"delay_varies_with_phi", "delay", true, "rel_span", 0.012, 0.045, 0.09},
      {"amplitude_dependent_delay", "delay", true, "rel_at_cycle", 0.012, 0.04, 0.08},
      {"nonlinear_damping", "acoustics", true, "xi_add_at_cycle", 0.02, 0.06, 0.1},
      {"parametric_noise", "flame", true, "rel_rms", 0.05, 0.13, 0.22},
      {"slow_drift", "acoustics", true, "rel_span", 0.008, 0.028, 0.055},
      {"intermittency", "flame", true, "gain_drop", 0.12, 0.32, 0.55},
      {"p_clipping", "p_instrument", true, "fraction", 0.96, 0.85, 0.72},
      {"q_clipping", "q_instrument", true, "fraction", 0.96, 0.85, 0.72},
      {"quantisation", "p_instrument", true, "levels", 120, 32, 14},
      {"mains_hum", "p_instrument or q_instrument", true, "rel", 0.012, 0.07, 0.17},
      {"crosstalk_p_to_q", "q_instrument", true, "rel", 0.03, 0.12, 0.26},
      {"second_delay_path", "delay", true, "share", 0.07, 0.2, 0.34},
      {"external_tone", "source", true, "rel", 0.015, 0.08, 0.2},
      {"x_entropy_wave", "acoustics", false, "rel", 0.06, 0.16, 0.3},
      {"own_damping", "acoustics", true, "factor", 1.2, 1.6, 2.5},
      {"x_flame_resonance", "flame", false, "gain", 0.1, 0.3, 0.8},
      {"x_flame_play", "flame", false, "rel", 0.03, 0.065, 0.13},
      {"x_delay_wander", "delay", false, "rel_rms", 0.006, 0.016, 0.04},
      {"duct_noise", "source", true, "rel", 0.15, 0.4, 1.2},
      {"x_swept_source", "source", false, "rel", 0.03, 0.09, 0.24},
      {"p_sensor_highpass", "p_instrument", true, "cutoff_hz", 6, 22, 80},
      {"p_dropouts", "p_instrument", true, "per_s", 2, 6, 20},
      {"x_p_echo", "p_instrument", false, "share", 0.04, 0.12, 0.35},
      {"x_q_clock", "q_instrument", false, "rel", 3e-5, 1.2e-4, 4e-4},
      {"q_sensor_highpass", "q_instrument", true, "cutoff_hz", 15, 60, 150},
      {"x_q_compression", "q_instrument", false, "rel", 0.05, 0.14, 0.35},
      {"x_point_wander", "operating_point", false, "rel_rms", 0.015, 0.04, 0.1},
      {"x_odd_point", "operating_point", false, "rel", 0.015, 0.04, 0.1}};
  return effects;
}

const EffectInfo& FindEffect(const std::string& id) {
  for (const EffectInfo& effect : Effects()) {
    if (effect.id == id) return effect;
  }
  throw std::runtime_error(id + " is no effect, expected one that howl_rig --list shows");
}

double SizeAt(const EffectInfo& effect, double severity) {
  const bool upper = severity > kMedium;
  const double part =
      upper ? (severity - kMedium) / (kLarge - kMedium) : (severity - kSmall) / (kMedium - kSmall);
  const double from = upper ? effect.medium : effect.small;
  const double to = upper ? effect.large : effect.medium;
  return from * std::pow(to / from, part);
}

Parameters DrawEffect(const EffectInfo& effect, double severity, const DrawScales& scales,
                      Random& random) {
  const double size = SizeAt(effect, severity);
  const double scattered = size * random.LogUniform(1.0 / kScatter, kScatter);
  const std::string& id = effect.id;
  Parameters out = {{effect.size_name, scattered}};
  if (id == "q_sensor_lowpass") {
    out["order"] = random.Uniform() < 0.5 ? 1.0 : 2.0;
  } else if (id == "p_sensor_resonance") {
    out["zeta"] = random.LogUniform(0.1, 0.4);
  } else if (id == "channel_skew" || id == "delay_varies_with_phi" || id == "slow_drift" ||
             id == "amplitude_dependent_delay" || id == "crosstalk_p_to_q" || id == "x_odd_point" ||
             id == "x_q_clock") {
    out[effect.size_name] *= random.Sign();
  } else if (id == "extra_acoustic_mode") {
    // Away from the two modes that the duct has anyhow.
    out["ratio"] = random.Uniform() < 0.5 ? random.Uniform(1.5, 2.5) : random.Uniform(3.6, 5.4);
    out["zeta"] = random.LogUniform(0.02, 0.05);
  } else if (id == "mode_detuning") {
    out["ratio"] = 3.0 + scattered * random.Sign();
  } else if (id == "p_clipping" || id == "q_clipping") {
    // The scatter is of what is cut off.
    out["fraction"] = 1.0 - (1.0 - size) * random.LogUniform(1.0 / kScatter, kScatter);
  } else if (id == "mains_hum") {
    out = {{random.Uniform() < 0.5 ? "rel_p" : "rel_q", scattered},
           {"hz", random.Uniform() < 0.5 ? 50.0 : 60.0}};
  } else if (id == "second_delay_path") {
    out["extra_s"] = scales.tau_s * random.Uniform(0.25, 0.75);
  } else if (id == "external_tone") {
    double ratio = 1.0;
    // Not where the cycle or one of its harmonics hides it.
    while (std::abs(ratio - std::round(ratio)) < 0.15) ratio = random.Uniform(0.4, 3.6);
    out["hz"] = ratio * scales.cycle_hz;
  } else if (id == "intermittency") {
    out["dwell_s"] = random.Uniform(0.15, 0.4);
  } else if (id == "parametric_noise") {
    out["correlation_s"] = random.Uniform(0.03, 0.08);
  } else if (id == "x_entropy_wave") {
    out["delay_s"] = scales.tau_s * random.Uniform(2.2, 4.0);
  } else if (id == "x_p_echo") {
    out["delay_s"] = random.Uniform(0.15, 0.6) / scales.cycle_hz;
  } else if (id == "own_damping") {
    if (random.Uniform() < 0.5) out["factor"] = 1.0 / scattered;
  } else if (id == "x_flame_resonance") {
    out["ratio"] = random.Uniform(1.8, 3.6);
  } else if (id == "x_swept_source") {
    const double low = scales.cycle_hz * random.Uniform(1.2, 1.6);
    out["low_hz"] = low;
    out["high_hz"] = low + scales.cycle_hz * random.Uniform(0.25, 0.35);
  } else if (id == "x_odd_point") {
    out["index"] = std::floor(random.Uniform() * static_cast<double>(scales.experiments));
  }
  return out;
}

void ApplyEffect(const std::string& id, const Parameters& parameters, Behaviour& behaviour) {
  FindEffect(id);
  const std::map<std::string, Setter>& numbers = Numbers().at(id);
  for (const auto& [name, value] : parameters) {
    const auto number = numbers.find(name);
    if (number == numbers.end()) {
      std::string known;
      for (const auto& [other, setter] : numbers) known += (known.empty() ? "" : ", ") + other;
      throw std::runtime_error(name + " is no parameter of " + id + ", expected " + known);
    }
    behaviour.*(number->second) = value;
  }
}

}  // namespace rig
