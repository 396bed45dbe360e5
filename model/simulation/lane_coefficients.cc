// From a rig's parameters to the numbers of the simulator's scheme.
#include <glog/logging.h>

#include <array>

#include "model/simulation/lane_group.h"

namespace howl::internal {

std::array<ModeParameters, kMaxModes> Modes(const RigParameters& rig,
                                            const LoopParameters<double>& loop) {
  const Acoustics<double>& a = loop.acoustics;
  const double omega = kRadPerSPerHz * a.omega_hz;
  std::array<ModeParameters, kMaxModes> modes{};
  modes[0] = {omega, a.xi, a.N};
  modes[1] = {a.harmonic_ratio * omega, a.xi, a.M};
  for (std::size_t k = 0; k < rig.extra_modes.size(); ++k) {
    const ExtraMode& extra = rig.extra_modes[k];
    modes[2 + k] = {kRadPerSPerHz * extra.frequency_hz, extra.xi, extra.coefficient};
  }
  return modes;
}

int NumModes(const RigParameters& rig) {
  CHECK_LE(rig.extra_modes.size(), 2u);
  return 2 + static_cast<int>(rig.extra_modes.size());
}

LaneCoefficients MakeCoefficients(const RigParameters& rig, const LoopParameters<double>& loop,
                                  const Flame<double>& flame, double step_s) {
  const auto modes = Modes(rig, loop);
  LaneCoefficients c;
  for (int k = 0; k < NumModes(rig); ++k) {
    const auto at = static_cast<std::size_t>(k);
    c.steps[at] =
        MakeModeStep<kOrder>(modes[at].omega_rad_s, modes[at].xi, modes[at].coefficient, step_s);
    c.omega_rad_s[at] = modes[at].omega_rad_s;
    c.damping_rad_s[at] = 2.0 * modes[at].omega_rad_s * modes[at].xi;
    c.direct += modes[at].coefficient;
  }
  const DelaySteps delay = SplitDelay(loop.tau_s, step_s);
  c.delay_steps = delay.steps;
  c.delay_weights = delay.weights;
  c.flame_gain = flame.slope / flame.saturation;
  c.flame_offset = flame.offset;
  c.saturation = flame.saturation;
  return c;
}

}  // namespace howl::internal
