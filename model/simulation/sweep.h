// A parameter lambda of the loop swept slowly there and back within one run, as a rig's valve
// would:
//
//   lambda(t):  from -> to in one_way_s, to -> from in as long again, linear in t
//
// The run is cut into windows; the strongest line of p tells which cycle the loop is on. Where two
// cycles attract (section 4 of the paper: near 215 and 750 Hz) the loop jumps at one value on the
// way there and at another on the way back. A jump comes late: a cycle that attracts no more is
// left once what noise there is has grown. The faster the sweep and the smaller the noise, the
// later; strong noise jumps early. Where each cycle attracts by itself:
// model/cycles/continuation.h.
//
// Hz, seconds, units of p; lambda in units of its own.
#ifndef HOWL_MODEL_SIMULATION_SWEEP_H_
#define HOWL_MODEL_SIMULATION_SWEEP_H_

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "model/cycles/continuation.h"
#include "model/simulation/simulate.h"

namespace howl {

enum class SweptParameter : std::uint8_t {
  kOmega,
  kXi,
  kN,
  kM,
  kMOverN,
  kHarmonicRatio,
  kTau,
  kSlopeFactor
};
inline constexpr std::array kSweptParameters = {
    SweptParameter::kOmega, SweptParameter::kXi,         SweptParameter::kN,
    SweptParameter::kM,     SweptParameter::kMOverN,     SweptParameter::kHarmonicRatio,
    SweptParameter::kTau,   SweptParameter::kSlopeFactor};

// As in configs.
constexpr std::string_view SweptParameterName(SweptParameter parameter) {
  constexpr std::array<std::string_view, kSweptParameters.size()> kNames = {
      "omega_hz", "xi", "N", "M", "M_over_N", "harmonic_ratio", "tau_s", "flame_slope_factor"};
  return kNames[static_cast<std::size_t>(parameter)];
}

// The loop with the parameter at `value`; N leaves M alone. kSlopeFactor: over the loop's own
// slope.
ClosedLoop WithParameter(const ClosedLoop& model, SweptParameter parameter, double value);

struct SweepOptions {
  double from = 0.0;
  double to = 1.0;
  double one_way_s = 40.0;
  int steps = 50;  // windows each way
  double sampling_hz = 5000.0;
  double settle_s = 1.0;  // at `from`, thrown away
};

struct SweepWindow {
  bool back = false;
  double parameter = 0.0;     // in the window's middle
  double frequency_hz = 0.0;  // of p's strongest line
  double pressure_amplitude = 0.0;
};

struct SweepJump {
  bool back = false;
  double parameter = 0.0;  // half-way between the windows; off by half a window at most
  double from_hz = 0.0;
  double to_hz = 0.0;
};

// `start`: the rig at `from`, with its past and its noise; its effects act on the swept loop.
std::vector<SweepWindow> SweepInTime(const SimulationCase& start, SweptParameter parameter,
                                     const SweepOptions& options);

// Where the strongest line of one window is another than that of the window before.
std::vector<SweepJump> FindJumps(const std::vector<SweepWindow>& windows);

// Where the loop is on another line, or has another amplitude, on the way back than on the way
// there: by windows, merged, in order.
std::vector<ParameterInterval> FindHysteresis(const std::vector<SweepWindow>& windows,
                                              const SweepOptions& options);

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_SWEEP_H_
