#include "app/simulate/simulate_cases.h"

#include "app/simulate/simulate_times.h"
#include "estimation/unit_seed.h"

namespace howl {

std::vector<SimulationCase> CasesOf(const Config& config, const SimulationTimes& times,
                                    const std::vector<Experiment>& experiments,
                                    const std::vector<SimulatedRig>& rigs, std::uint64_t seed) {
  std::vector<SimulationCase> cases;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    CheckInternalRate(config, times, experiments[i], rigs[i].parameters);
    cases.push_back({rigs[i].parameters, UnitSeed(seed, experiments[i].name)});
  }
  return cases;
}

std::vector<SimulatedRecord> SimulateCases(const std::vector<SimulationCase>& cases,
                                           const SimulationTimes& times, int threads) {
  return SimulateBatch(cases, {.duration_s = times.duration_s,
                               .sampling_hz = times.sampling_hz,
                               .settle_s = times.settle_s,
                               .threads = threads});
}

}  // namespace howl
