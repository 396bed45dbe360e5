#include "app/diagnose/planned_records.h"

#include <algorithm>
#include <utility>

#include "app/input/asked_models.h"
#include "app/input/diagnose_input.h"
#include "app/input/problem_input.h"
#include "app/simulate/simulate_cases.h"
#include "app/simulate/simulate_rigs.h"
#include "app/simulate/simulate_times.h"
#include "estimation/analysis/spectra/simulated_record.h"

namespace howl {

bool HasRecords(const Config& config) {
  return std::ranges::any_of(config.experiments,
                             [](const auto& each) { return each.record.has_value(); });
}

std::vector<DiagnosisExperiment> SimulatedExperiments(const Config& config,
                                                      const Options& options) {
  const ProblemInput input = LoadInput(config, options);
  RequireExperiments(config, options, input);
  const std::vector<Experiment>& experiments = input.experiments;
  const SimulationTimes times = MakeSimulationTimes(config.simulation, experiments);
  CheckSimulationTimes(config, times, experiments);
  const std::vector<LoopModel> models = AskedModels(config, options, experiments);
  const std::vector<SimulatedRig> rigs = MakeRigs(config, input, models, times);
  std::vector<SimulatedRecord> simulated = SimulateCases(
      CasesOf(config, times, experiments, rigs, options.seed), times, options.threads);
  std::vector<NamedRecord> records;
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    records.push_back({.name = experiments[i].name,
                       .phi = experiments[i].phi,
                       .record = ToRecord(std::move(simulated[i]))});
  }
  return MakeDiagnosisExperiments(config, std::move(records));
}

}  // namespace howl
