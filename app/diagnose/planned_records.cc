#include "app/diagnose/planned_records.h"

#include <algorithm>

#include "app/input/config_fit.h"
#include "app/input/diagnose_input.h"
#include "app/input/measured_flame.h"
#include "app/input/problem_input.h"
#include "app/simulate/flame_table_rig.h"
#include "app/simulate/simulate_cases.h"
#include "app/simulate/simulate_rig.h"
#include "app/simulate/simulate_times.h"

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
  const JointProblem problem = MakeJointProblem(config, experiments);
  const std::vector<LoopModel> models = SolveConfig(config, options, problem).models;
  std::vector<SimulatedRig> rigs;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    rigs.push_back(
        MakeRig(config, experiments[i], models[i], MeasuredFlame(input, experiments[i]), times));
    if (config.simulation.flame_table) {
      UseFlameTable(config, input, experiments[i], &rigs.back());
    }
  }
  const std::vector<SimulatedRecord> simulated = SimulateCases(
      CasesOf(config, times, experiments, rigs, options.seed), times, options.threads);
  std::vector<NamedRecord> records;
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    records.push_back(
        {.name = experiments[i].name,
         .phi = experiments[i].phi,
         .record = {simulated[i].sampling_hz, simulated[i].pressure, simulated[i].heat_release}});
  }
  return MakeDiagnosisExperiments(config, std::move(records));
}

}  // namespace howl
