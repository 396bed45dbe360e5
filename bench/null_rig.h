// Rigs with no effect from the project's own simulator, for studies of the diagnosis: all its flame
// shapes, offsets, and noise of many levels and colours.
#ifndef HOWL_BENCH_NULL_RIG_H_
#define HOWL_BENCH_NULL_RIG_H_

#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/noise/random_stream.h"
#include "model/simulation/simulate.h"

namespace howl {

inline constexpr int kNullRigPoints = 6;

struct NullRig {
  std::vector<SimulationCase> cases;
  std::string text;
};

inline NullRig DrawNullRig(std::uint64_t seed) {
  RandomStream random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.Uniform();
  };
  constexpr FlameShape kShapes[] = {FlameShape::kTanh, FlameShape::kArctan, FlameShape::kCubic,
                                    FlameShape::kPiecewiseLinear, FlameShape::kAlgebraic};
  constexpr const char* kNames[] = {"tanh", "arctan", "cubic", "clipped", "algebraic"};
  const auto shape = static_cast<std::size_t>(between(0.0, 4.999));
  const double omega_hz = between(195.0, 215.0);
  const double omega_step_hz = between(0.5, 3.0);
  const double xi = between(0.1, 0.2);
  const double xi_step = xi * between(0.03, 0.1);
  const double second_over_first = between(0.1, 0.35);
  const double tau_s = between(3.35e-3, 3.65e-3);
  const double saturation = between(0.3, 0.8);
  const double offset = between(-0.3, 0.3);
  const double slope = -between(6e-5, 8e-5);
  const double noise = between(0.03, 0.15) * saturation;  // rms of combustion noise
  const double corner_hz = between(200.0, 2000.0);
  const double pressure_noise = between(0.002, 0.01);
  const double heat_release_noise = between(0.001, 0.005);
  NullRig out;
  for (int point = 0; point < kNullRigPoints; ++point) {
    SimulationCase one;
    RigParameters& rig = one.rig;
    const double damping = xi - xi_step * point;
    const double loop_gain = between(1.2, 1.5);
    // At resonance s G = N w / (2 xi w).
    const double first = loop_gain * 2.0 * damping / -slope;
    rig.model = {
        {{omega_hz - omega_step_hz * point, damping, first, second_over_first * first, 3.0}, tau_s},
        {kShapes[shape], slope, saturation, offset * saturation / -slope}};
    rig.noise.combustion_corner_hz = corner_hz;
    rig.noise.combustion_density = noise * noise / (corner_hz * 0.5 * std::numbers::pi);
    // The cycle's p is about saturation times |G|.
    const double pressure =
        saturation * first / (2.0 * damping * 2.0 * std::numbers::pi * omega_hz);
    rig.noise.pressure_sensor_std = pressure_noise * pressure;
    rig.noise.heat_release_sensor_std = heat_release_noise * saturation;
    rig.past = {{0.3 * pressure, omega_hz, 0.0, 0.0}};
    one.seed = DeriveSeed(seed, static_cast<std::uint64_t>(point) + 1);
    out.cases.push_back(std::move(one));
  }
  char text[160];
  std::snprintf(text, sizeof text, "%s, offset %.2f, noise %.3f at %.0f Hz, p noise %.4f, M/N %.2f",
                kNames[shape], offset, noise / saturation, corner_hz, pressure_noise,
                second_over_first);
  out.text = text;
  return out;
}

// 3.2 s of each point, after it has settled.
inline std::vector<DiagnosisExperiment> Recorded(const NullRig& rig) {
  SimulationOptions how;
  how.duration_s = 3.2;
  how.settle_s = 1.0;
  return RecordedPoints<DiagnosisExperiment>(
      rig.cases, how, [](std::size_t i) { return 0.56 - 0.02 * static_cast<double>(i); });
}

}  // namespace howl

#endif  // HOWL_BENCH_NULL_RIG_H_
