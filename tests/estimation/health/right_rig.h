// A rig whose every number is right, as a table and as records, for tests that then make one
// mistake in them. The table is the loop's own: the cycle at its phase crossing (1a), phase and
// gain of G there, a flame slope that gives a loop gain above one.
#ifndef HOWL_TESTS_ESTIMATION_HEALTH_RIGHT_RIG_H_
#define HOWL_TESTS_ESTIMATION_HEALTH_RIGHT_RIG_H_

#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/loop/crossings.h"
#include "model/loop/loop.h"
#include "model/simulation/simulate.h"

namespace howl {

inline constexpr int kRightPoints = 5;
inline constexpr double kRightLoopGain = 1.25;

inline LoopParameters<double> RightLoop(int point) {
  const double k = static_cast<double>(point);
  return {{216.0 - 8.0 * k, 0.15 - 0.028 * k, 5000.0 - 300.0 * k, 0.0, 3.0}, 0.00346};
}

inline double RightPhi(int point) { return 0.56 - 0.02 * point; }

// The lowest crossing, near omega: the limit cycle's frequency.
inline double CycleHz(const LoopParameters<double>& loop) {
  for (const PhaseCrossing& crossing : PhaseCrossings(loop, -1.0, 400.0)) {
    if (std::abs(crossing.frequency_hz / loop.acoustics.omega_hz - 1.0) < 0.2) {
      return crossing.frequency_hz;
    }
  }
  return 0.0;
}

// Of the five points, with errors of the size that the joint fit expects by default; none for
// seed 0.
inline std::vector<Experiment> RightTable(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto error = [&](double std) { return seed == 0 ? 0.0 : std * normal(random); };
  std::vector<Experiment> table;
  for (int point = 0; point < kRightPoints; ++point) {
    const LoopParameters<double> loop = RightLoop(point);
    const double f = CycleHz(loop);
    const Complex<double> g = AcousticResponse(loop.acoustics, f);
    const double gain = std::hypot(g.re, g.im);
    table.push_back({.name = "exp" + std::to_string(point + 1),
                     .phi = RightPhi(point),
                     .frequency_hz = f,
                     .phase_deg = std::atan2(g.im, g.re) * kDegPerRad + error(0.5),
                     .gain = gain * (1.0 + error(0.01)),
                     .flame_slope = -kRightLoopGain / (gain * kRadPerSPerHz * f)});
  }
  return table;
}

// The same loops in time, in noise.
inline std::vector<NamedRecord> RightRecords(unsigned seed, double loop_gain = kRightLoopGain) {
  std::vector<SimulationCase> cases;
  for (int point = 0; point < kRightPoints; ++point) {
    SimulationCase one;
    one.rig.model.loop = RightLoop(point);
    const double f = CycleHz(one.rig.model.loop);
    const double response = Magnitude(LoopResponse(one.rig.model.loop, f));
    one.rig.model.flame = {FlameShape::kTanh, -loop_gain / response, 1.0, 0.0};
    one.rig.noise.combustion_density = 1e-6;
    one.rig.noise.combustion_corner_hz = 1000.0;
    one.rig.noise.pressure_sensor_std = 0.01;
    one.rig.noise.heat_release_sensor_std = 0.001;
    one.rig.past = {{0.5, f, 0.0, 0.0}};
    one.seed = seed * 100 + static_cast<unsigned>(point);
    cases.push_back(std::move(one));
  }
  SimulationOptions options;
  options.duration_s = 3.2;
  options.settle_s = 0.5;
  return RecordedPoints<NamedRecord>(cases, options,
                                     [](std::size_t i) { return RightPhi(static_cast<int>(i)); });
}

}  // namespace howl

#endif  // HOWL_TESTS_ESTIMATION_HEALTH_RIGHT_RIG_H_
