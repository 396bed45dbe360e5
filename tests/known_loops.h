// Tables of many experiments whose loops are known, for tests and studies of every library: in the
// range of the paper's test R228, phi from 0.45 to 0.56, xi rising with it from 0.04 to 0.15, omega
// within 1 % of 215 Hz, delays near 0.72 periods, loop gains of 1.15 to 1.6. The characteristics
// are exact: the frequency where (1a) holds, found by bisection, gain and phase of G there, and the
// slope from the loop gain.
#ifndef HOWL_TESTS_KNOWN_LOOPS_H_
#define HOWL_TESTS_KNOWN_LOOPS_H_

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "model/loop/loop.h"
#include "model/numerics/units.h"

namespace howl {

struct KnownLoops {
  std::vector<Experiment> experiments;
  std::vector<LoopModel> models;  // of each
};

// `gain_noise`: relative standard deviation of the gains; `phase_noise_deg`: of the phases.
inline KnownLoops DrawKnownLoops(int count, int modes, double gain_noise = 0.0,
                                 double phase_noise_deg = 0.0) {
  std::mt19937_64 random(20011);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * uniform(random); };
  KnownLoops known;
  for (int k = 0; k < count; ++k) {
    const double x = (k + 0.5) / count;
    LoopModel model;
    model.omega_hz = 215.0 * between(0.99, 1.01);
    model.xi = 0.04 * std::pow(0.15 / 0.04, x);
    model.N = 15.0 * 2.0 * model.xi * kRadPerSPerHz * model.omega_hz * between(0.8, 1.25);
    model.M = modes == 2 ? 300.0 : 0.0;
    model.tau_s = between(0.715, 0.725) / model.omega_hz;
    double lo = model.omega_hz, hi = 1.3 * lo;
    for (int halving = 0; halving < 100; ++halving) {
      const double middle = 0.5 * (lo + hi);
      (LoopPhaseError(model.Loop(), middle) > 0.0 ? lo : hi) = middle;
    }
    Experiment experiment;
    experiment.name = "exp" + std::to_string(k + 1);
    experiment.phi = 0.45 + 0.11 * x;
    experiment.frequency_hz = 0.5 * (lo + hi);
    const Complex<double> z = AcousticResponse(model.Loop().acoustics, experiment.frequency_hz);
    experiment.gain = Magnitude(z) * (1.0 + gain_noise * normal(random));
    experiment.phase_deg = Angle(z) * kDegPerRad + phase_noise_deg * normal(random);
    experiment.flame_slope =
        -between(1.15, 1.6) / (kRadPerSPerHz * experiment.frequency_hz * Magnitude(z));
    known.experiments.push_back(experiment);
    known.models.push_back(model);
  }
  return known;
}

}  // namespace howl

#endif  // HOWL_TESTS_KNOWN_LOOPS_H_
