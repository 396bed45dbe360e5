// The published characteristics of test R228 (the paper, tables 1 to 3), for tests of every
// library.
#ifndef HOWL_TESTS_R228_H_
#define HOWL_TESTS_R228_H_

#include <vector>

#include "estimation/analysis/loop/experiment.h"

namespace howl {

inline std::vector<Experiment> R228() {
  return {
      {.name = "exp1",
       .phi = 0.56,
       .frequency_hz = 219.9,
       .phase_deg = -5.74,
       .gain = 12.14,
       .flame_slope = -0.703e-4},
      {.name = "exp2",
       .phi = 0.53,
       .frequency_hz = 209.1,
       .phase_deg = -9.44,
       .gain = 13.15,
       .flame_slope = -0.707e-4},
      {.name = "exp3",
       .phi = 0.51,
       .frequency_hz = 205.7,
       .phase_deg = -14.35,
       .gain = 14.79,
       .flame_slope = -0.670e-4},
      {.name = "exp4",
       .phi = 0.49,
       .frequency_hz = 202.7,
       .phase_deg = -19.18,
       .gain = 16.05,
       .flame_slope = -0.626e-4},
      {.name = "exp5",
       .phi = 0.47,
       .frequency_hz = 198.4,
       .phase_deg = -22.92,
       .gain = 18.80,
       .flame_slope = -0.401e-4,
       .reliable = false},
      {.name = "exp6",
       .phi = 0.45,
       .frequency_hz = 179.8,
       .phase_deg = -42.72,
       .gain = 45.01,
       .flame_slope = -0.0872e-4,
       .reliable = false},
  };
}

// The first four alone: the ones whose signals are stationary.
inline std::vector<Experiment> R228Reliable() {
  std::vector<Experiment> experiments = R228();
  experiments.resize(4);
  return experiments;
}

}  // namespace howl

#endif  // HOWL_TESTS_R228_H_
