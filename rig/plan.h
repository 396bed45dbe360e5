// From characteristics to rigs: at each operating point modes, delay and flame for which the loop
//
//   q = Phi[p'(t - tau)],  p = G q
//
// closes at the wanted frequency, with the wanted gain from q to p, and a loop gain a little above
// one. tau is shared, so that the phase from q to p follows from frequency and tau. What one cycle
// leaves open (damping, the second mode, the flame's shape) is drawn.
#ifndef HOWL_RIG_PLAN_H_
#define HOWL_RIG_PLAN_H_

#include <string>
#include <utility>
#include <vector>

#include "rig/duct.h"
#include "rig/spec.h"

namespace rig {

struct Point {
  std::string name;
  double phi = 0.0;
  double position = 0.0;  // of phi, -1/2 ... 1/2 over the experiments
  Modes modes;
  double tau_s = 0.0;
  Flame flame;
  // The cycle, by its fundamental alone.
  double frequency_hz = 0.0;
  double phase_deg = 0.0;
  double loop_gain = 0.0;
  double rate_amplitude = 0.0;  // of what drives the flame
  double p_amplitude = 0.0;
  double q_amplitude = 0.0;
};

struct Plan {
  std::vector<Point> points;
  std::vector<std::pair<std::string, Parameters>> effects;
  Behaviour behaviour;
  double combustion_noise = 0.0;  // rms over saturation
  double combustion_corner_hz = 0.0;
  double sensor_noise = 0.0;  // rms over the cycle's amplitude
  double mean_p_amplitude = 0.0;
  double mean_rate_amplitude = 0.0;
};

Plan MakePlan(const Spec& spec);

}  // namespace rig

#endif  // HOWL_RIG_PLAN_H_
