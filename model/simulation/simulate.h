// The loop in time (the paper, figure 3), a delay equation with noise:
//
//   q(t) = Phi(p'(t - tau)) + n(t),    p = G q
//
// Scheme, of order 6 in the step: the modes are propagated exactly (model/loop/mode_step.h) with q
// interpolated by its six nearest samples, which a delay longer than the step makes explicit; p'
// is read tau earlier by interpolation of order 6, tau being any real number of steps.
//
// Members of a batch run side by side in vector lanes, batches in threads. A member's bits depend
// on its rig, its seed and the options alone: not on lanes, neighbours or threads.
//
// Recorded signals: true p and q -> instruments at the internal rate -> anti-alias filter
// (model/simulation/decimate.h) -> + sensor noise -> digitisers at the record's rate.
//
// Seconds, Hz, units of p and q as in the rig.
#ifndef HOWL_MODEL_SIMULATION_SIMULATE_H_
#define HOWL_MODEL_SIMULATION_SIMULATE_H_

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/loop/instrument.h"
#include "model/loop/laplace.h"
#include "model/loop/loop_effect.h"
#include "model/noise/noise.h"

namespace howl {

// c s / (s^2 + 2 omega xi s + omega^2), added to G.
struct ExtraMode {
  double frequency_hz = 0.0;
  double xi = 0.0;
  double coefficient = 0.0;
};

// The past, up to the first sample: q(t) = amplitude e^(growth_rate t) cos(2 pi f t + phase), and
// p and p' as G answers to it.
struct InitialWave {
  double amplitude = 0.0;  // of q
  double frequency_hz = 0.0;
  double growth_rate = 0.0;
  double phase_rad = 0.0;
};

struct RigParameters {
  ClosedLoop model;
  std::vector<ExtraMode> extra_modes;  // at most two
  Noise noise;
  std::vector<InitialWave> past;  // a sum; empty: at rest
  std::vector<std::shared_ptr<const LoopEffect>> effects;
  std::vector<std::shared_ptr<const Instrument>> instruments;
  std::vector<std::shared_ptr<const Instrument>> digitisers;
};

struct SimulationCase {
  RigParameters rig;
  std::uint64_t seed = 0;
};

struct SimulationOptions {
  double duration_s = 1.0;
  double sampling_hz = 5000.0;
  double settle_s = 0.0;     // run and thrown away first
  double internal_hz = 0.0;  // a multiple of sampling_hz; 0: InternalRate()
  bool keep_true_signals = false;
  int threads = 0;  // 0: as many as the machine has
};

struct SimulatedRecord {
  double sampling_hz = 0.0;
  std::vector<double> pressure;
  std::vector<double> heat_release;
  // On request, at the internal rate from the record's first sample on.
  double internal_hz = 0.0;
  std::vector<double> true_pressure;
  std::vector<double> true_heat_release;
};

// The smallest multiple of sampling_hz that is at least 20 kHz (of a mode at 220 Hz: cycle_scale.h)
// and gives the delay 48 steps (37 are needed; the rest is for effects that shorten it).
double InternalRate(const RigParameters& rig, double sampling_hz);

std::vector<SimulatedRecord> SimulateBatch(std::span<const SimulationCase> cases,
                                           const SimulationOptions& options);

SimulatedRecord Simulate(const SimulationCase& one, const SimulationOptions& options);

// The cycle as the past of a simulation, with its harmonics and, if any, its constant part.
struct LimitCycle;
std::vector<InitialWave> PastOnCycle(const LimitCycle& cycle);

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_SIMULATE_H_
