#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/input/asked_models.h"
#include "app/input/problem_input.h"
#include "app/simulate/record_simulation.h"
#include "app/simulate/simulate_cases.h"
#include "app/simulate/simulate_rig.h"
#include "app/simulate/simulate_rigs.h"
#include "app/simulate/simulate_sweep.h"
#include "app/simulate/simulate_times.h"
#include "app/text/text_table.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "estimation/family/problem/membership.h"
#include "io/config/reading/config_reading.h"
#include "io/records/records.h"
#include "io/result_files.h"
#include "io/results/records_yaml.h"
#include "io/results/simulation_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

std::string LoopsText(const Options& options, const std::vector<Experiment>& experiments,
                      const std::vector<SimulatedRig>& rigs) {
  std::vector<SimulatedLoop> loops;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const SimulatedRig& rig = rigs[i];
    loops.push_back(
        {.name = experiments[i].name,
         .loop_gain = rig.model_loop_gain,
         .simulated_loop_gain = rig.loop_gain,
         .flame_slope = rig.flame_slope,
         .slope_raised = rig.slope_raised,
         .flame = rig.flame,
         .cycle_hz = rig.cycle ? std::optional(rig.cycle->frequency_hz) : std::nullopt});
  }
  return SimulationJson(AskedMember(options), loops).dump(2) + "\n";
}

void PrintSimulated(const std::vector<Experiment>& experiments,
                    const std::vector<SimulatedRig>& rigs) {
  TextTable table({"experiment", "loop gain", "flame", "starts", "file"});
  bool any_raised = false;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    any_raised = any_raised || rigs[i].slope_raised;
    table.AddRow(
        {experiments[i].name, Fixed(rigs[i].loop_gain, 3) + (rigs[i].slope_raised ? " *" : ""),
         rigs[i].has_flame_table ? "table" : std::string(FlameShapeName(rigs[i].flame.shape)),
         rigs[i].origin, experiments[i].name + ".csv"});
  }
  std::printf("%s", table.Text().c_str());
  if (any_raised) {
    std::printf("* the flame slope was raised to simulate.loop_gain_min: a cycle was observed\n");
  }
}

int RunSimulateCommand(const Options& options) {
  const Config config = LoadConfig(options.config, LoopsTaken::kAny);
  if (config.record_loop) return RunRecordSimulation(config, options);
  const ProblemInput input = LoadInput(config, options);
  RequireExperiments(config, options, input);
  const std::vector<Experiment>& experiments = input.experiments;
  const SimulationTimes times = MakeSimulationTimes(config.simulation, experiments);
  CheckSimulationTimes(config, times, experiments);
  const std::vector<LoopModel> models = AskedModels(config, options, experiments);
  if (config.simulation.sweep) CheckSweep(config, times);
  std::vector<SimulatedRig> rigs = MakeRigs(config, input, models, times);
  AddEffects(config, experiments, times.duration_s, &rigs);
  const std::vector<SimulationCase> cases = CasesOf(config, times, experiments, rigs, options.seed);
  const std::vector<SimulatedRecord> records = SimulateCases(cases, times, options.threads);
  for (std::size_t i = 0; i < records.size(); ++i) {
    WriteRecordCsv(options.out / (experiments[i].name + ".csv"), ToRecord(records[i]));
  }
  WriteWholeFile(options.out / "records.yaml", RecordsYaml(config, experiments, times.sampling_hz));
  WriteWholeFile(options.out / "simulation.json", LoopsText(options, experiments, rigs));
  std::vector<SweepResult> sweeps;
  if (config.simulation.sweep) {
    std::vector<SweptRig> swept;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      swept.push_back({experiments[i].name, cases[i], experiments[i].frequency_hz});
    }
    sweeps = RunSweeps(config, times, std::move(swept), options.threads);
    WriteWholeFile(options.out / kSweepCsv, SweepCsv(*config.simulation.sweep, sweeps));
  }
  if (!options.quiet) {
    PrintSimulated(experiments, rigs);
    // Effects may put a stronger line there on purpose, so the note is printed for the bare loop
    // only.
    for (std::size_t i = 0; i < records.size() && config.simulation.effects.empty(); ++i) {
      const std::string left = LeftItsCycle(rigs[i], records[i]);
      if (!left.empty()) {
        std::printf("%s has left its cycle: %s\n", experiments[i].name.c_str(), left.c_str());
      }
    }
    if (config.simulation.sweep) {
      std::printf("%s", SweepText(*config.simulation.sweep, sweeps).c_str());
    }
    std::printf(
        "written: %srecords, records.yaml (a config of their own) and simulation.json in %s\n",
        config.simulation.sweep ? "sweep.csv, " : "", options.out.c_str());
  }
  return kDone;
}

}  // namespace

Command SimulateCommand() {
  return {
      "simulate",
      "simulate the fitted loop into records",
      "Fits the config (or takes a listed member of its family), closes the loop with a flame\n"
      "that saturates, and integrates it with noise, each experiment from its observed cycle on,\n"
      "or from the one that `simulate: start` names.\n"
      "Writes NAME.csv (p,q) for each experiment, records.yaml, a config that analyse, fit and\n"
      "family take as it is, and simulation.json, which says where a slope was raised. The\n"
      "config's `simulate:` has duration, sampling, flame, noise, and `effects:`, any of the\n"
      "catalogue of howl diagnose, which neither file tells.\n"
      "A loop that is fitted to whole records runs with the flame and noise that they show.\n"
      "With `sweep:` a parameter goes slowly there and back in one more run: sweep.csv, and where\n"
      "the loop jumps on the way up and on the way down.",
      {{"--member", "K", "member K of family.csv, which howl family wrote to DIR, not the fit"}},
      RunSimulateCommand};
}

}  // namespace howl
