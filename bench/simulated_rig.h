// Operating points of one simulated rig, as loads of the diagnosis: 3.2 s at 5 kHz each.
#ifndef HOWL_BENCH_SIMULATED_RIG_H_
#define HOWL_BENCH_SIMULATED_RIG_H_

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/simulation/simulate.h"

namespace howl {

inline std::vector<DiagnosisExperiment> SimulatedPoints(int count) {
  std::vector<SimulationCase> cases;
  for (int k = 0; k < count; ++k) {
    SimulationCase one;
    one.rig.model = {{{206.0 - 2.0 * k, 0.17 - 0.01 * k, 6400.0 - 200.0 * k, 1700.0, 3.0}, 0.00352},
                     {FlameShape::kTanh, -0.72e-4, 0.45, 0.0}};
    one.rig.noise = {4e-7, 1200.0, 0.02, 0.002};
    one.rig.past = {{0.1, 205.0, 0.0, 0.0}};
    one.seed = static_cast<std::uint64_t>(k);
    cases.push_back(std::move(one));
  }
  SimulationOptions options;
  options.duration_s = 3.2;
  options.settle_s = 0.5;
  return RecordedPoints<DiagnosisExperiment>(
      cases, options, [](std::size_t i) { return 0.56 - 0.02 * static_cast<double>(i); });
}

}  // namespace howl

#endif  // HOWL_BENCH_SIMULATED_RIG_H_
