// What a rig can have beyond the loop of duct, delay and flame. Each effect is a few numbers of
// Behaviour; at their defaults they do nothing.
#ifndef HOWL_RIG_EFFECTS_H_
#define HOWL_RIG_EFFECTS_H_

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "rig/random.h"

namespace rig {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct Behaviour {
  // Acoustics. Frequencies as ratios are over the first mode's.
  double second_mode_ratio = 3.0;
  double second_mode_damping = 1.0;   // its damping ratio over the first mode's
  double side_branch_ratio = 2.0;     // one more resonance
  double side_branch_strength = 0.0;  // over N
  double side_branch_damping = 0.05;
  double damping_at_cycle = 0.0;  // added to xi, times the squared amplitude of p
  double drift_span = 0.0;        // of all acoustic frequencies over a record
  double entropy_share = 0.0;     // of q that drives the duct once more ...
  double entropy_delay_s = 0.01;  // ... after this long

  // Flame.
  double flame_cutoff_hz = kNever;
  double flame_peak_gain = 0.0;  // a resonance in parallel with the flame
  double flame_peak_ratio = 2.5;
  double flame_play = 0.0;        // backlash before the flame, over the amplitude of v
  double gain_fluctuation = 0.0;  // rms
  double gain_fluctuation_s = 0.05;
  double gain_drop = 0.0;  // at random times
  double gain_dwell_s = 0.2;

  // Delay.
  double delay_spread_s = 0.0;
  double delay_phi_span = 0.0;  // relative, over the experiments
  double delay_at_cycle = 0.0;  // relative, times the amplitude
  double second_path_share = 0.0;
  double second_path_extra_s = 1e-3;
  double delay_wander = 0.0;  // relative rms, slow

  // Sources other than the flame, relative to the amplitude of q.
  double tone = 0.0;
  double tone_hz = 100.0;
  double sweep = 0.0;
  double sweep_low_hz = 300.0;
  double sweep_high_hz = 400.0;
  double duct_noise = 0.0;  // rms over that of the combustion noise

  // What records p.
  double p_resonance_hz = kNever;
  double p_resonance_damping = 0.2;
  double p_clip = kNever;  // over the amplitude
  double p_levels = kNever;
  double p_hum = 0.0;  // over the amplitude
  double p_highpass_hz = 0.0;
  double p_dropouts_per_s = 0.0;
  double p_echo = 0.0;     // share of p that its line reflects ...
  double p_echo_s = 2e-3;  // ... and that comes this much later

  // What records q.
  double q_cutoff_hz = kNever;
  double q_cutoff_order = 1.0;
  double q_skew_s = 0.0;
  double q_clip = kNever;
  double q_hum = 0.0;
  double hum_hz = 50.0;
  double q_leak = 0.0;  // of p, in units of both amplitudes
  double q_highpass_hz = 0.0;
  double q_compression = 0.0;
  double q_clock = 0.0;  // relative rate by which its clock gains on that of p

  // Operating point.
  double point_wander = 0.0;  // flame gain and delay move together, slowly
  double odd_point = 0.0;     // relative: the delay of one experiment
  double odd_point_index = 0.0;
};

using Parameters = std::map<std::string, double>;

struct EffectInfo {
  std::string id;
  std::string block;
  bool in_catalogue = true;
  // The parameter that carries the effect's size, at severities 0.25, 0.55 and 0.85: hardly seen in
  // six records of 16 000 samples; plain in some signal; as bad as instruments and rigs get.
  std::string size_name;
  double small = 0.0;
  double medium = 0.0;
  double large = 0.0;
};

const std::vector<EffectInfo>& Effects();

// Throws std::runtime_error naming the nearest identifier where there is no such effect.
const EffectInfo& FindEffect(const std::string& id);

// The scales of the rig to which an effect is drawn in proportion, and its number of experiments.
struct DrawScales {
  double cycle_hz = 200.0;
  double tau_s = 3.4e-3;
  std::size_t experiments = 6;
};

// severity: 0.25 small, 0.55 medium, 0.85 large; sizes lie evenly in the logarithm between them.
Parameters DrawEffect(const EffectInfo& effect, double severity, const DrawScales& scales,
                      Random& random);

// Puts the effect's numbers into the behaviour. Throws std::runtime_error at a parameter that the
// effect has not.
void ApplyEffect(const std::string& id, const Parameters& parameters, Behaviour& behaviour);

// Size at a severity, without the draw's scatter.
double SizeAt(const EffectInfo& effect, double severity);

}  // namespace rig

#endif  // HOWL_RIG_EFFECTS_H_
