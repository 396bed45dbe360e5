#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/command.h"
#include "app/config_fit.h"
#include "app/problem_input.h"
#include "app/simulate_start.h"
#include "app/simulate_sweep.h"
#include "app/simulate_times.h"
#include "app/text_table.h"
#include "estimation/family/membership.h"
#include "estimation/joint_fit.h"
#include "estimation/unit_seed.h"
#include "io/records/records.h"
#include "io/results/family_csv.h"
#include "io/results/records_yaml.h"
#include "io/results/simulation_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"
#include "model/harmonic_balance.h"
#include "model/simulate.h"

namespace howl {
namespace {

constexpr int kMostMembers = 100000000;

// The loop of one experiment, ready to run, and what was decided about it.
struct Rig {
  RigParameters parameters;
  double loop_gain = 0.0;        // at rest, as it runs
  double model_loop_gain = 0.0;  // with the measured slope
  double flame_slope = 0.0;      // as it runs, without effects
  bool slope_raised = false;
  std::string origin;               // "on the cycle at 219.9 Hz"
  double pressure_amplitude = 0.0;  // of the observed cycle; saturation's where there is none
  double heat_release_amplitude = 0.0;
};

// The stable solution's models, or one listed member's.
std::vector<LoopModel> ModelsToSimulate(const Config& config, const Options& options,
                                        const std::vector<Experiment>& experiments) {
  const auto number = options.Count("--member", 1, kMostMembers);
  if (!number) {
    const JointProblem problem = MakeJointProblem(config, experiments);
    return SolveConfig(config, options, problem).models;
  }
  const FamilyTable table = ReadFamilyCsv(options.out / "family.csv");
  if (*number > static_cast<int>(table.rows.size())) {
    throw UsageError("--member: " + std::to_string(*number) + ", expected at most " +
                     std::to_string(table.rows.size()) + ", the members of family.csv");
  }
  const std::vector<double>& row = table.rows[static_cast<std::size_t>(*number - 1)];
  std::vector<LoopModel> models;
  for (const Experiment& experiment : experiments) {
    const auto value = [&](const char* column) {
      return row[table.Column(experiment.name + "." + column)];
    };
    models.push_back({.omega_hz = value("omega_hz"),
                      .xi = value("xi"),
                      .N = value("N"),
                      .M = value("M"),
                      .tau_s = value("tau_s"),
                      .harmonic_ratio = config.model.harmonic_ratio});
  }
  return models;
}

Rig MakeRig(const Config& config, const Experiment& experiment, const LoopModel& model,
            const SimulationTimes& times) {
  const SimulationSpec& spec = config.simulation;
  Rig rig;
  const LoopParameters<double> loop = model.Loop();
  const double response = Magnitude(LoopResponse(loop, experiment.frequency_hz));
  double slope = experiment.flame_slope.value_or(0.0);
  rig.model_loop_gain = response * std::abs(slope);
  rig.loop_gain = rig.model_loop_gain;
  if (rig.loop_gain < spec.loop_gain_min) {
    rig.loop_gain = spec.loop_gain_min;
    slope = -rig.loop_gain / response;
    rig.slope_raised = true;
  }
  rig.flame_slope = slope;
  rig.parameters.model = {loop, {spec.flame_shape, slope, spec.saturation, 0.0}};
  Noise& noise = rig.parameters.noise;
  const double combustion_std = spec.combustion_noise_relative * spec.saturation;
  noise.combustion_corner_hz = times.combustion_noise_corner_hz;
  noise.combustion_density =
      2.0 * combustion_std * combustion_std / (std::numbers::pi * noise.combustion_corner_hz);
  rig.heat_release_amplitude = spec.saturation;
  rig.pressure_amplitude =
      spec.saturation * response / (kRadPerSPerHz * experiment.frequency_hz);  // |G|
  const auto cycle = ObservedCycle(rig.parameters.model, experiment.frequency_hz);
  const SimulationOrigin origin = FindOrigin(config, experiment, rig.parameters.model, cycle);
  rig.origin = origin.text;
  if (origin.cycle) rig.parameters.past = PastOnCycle(*origin.cycle);
  if (cycle) {
    rig.pressure_amplitude = cycle->pressure_amplitude();
    rig.heat_release_amplitude = cycle->heat_release_amplitude();
    noise.pressure_sensor_std = spec.sensor_noise_relative * cycle->pressure_amplitude();
    noise.heat_release_sensor_std = spec.sensor_noise_relative * cycle->heat_release_amplitude();
  }
  return rig;
}

// Amplitude of p' at the cycle.
double Rate(const Rig& rig, const Experiment& experiment) {
  return kRadPerSPerHz * experiment.frequency_hz * rig.pressure_amplitude;
}

// The config's effects, relative to the cycles that the rigs have without them.
void AddEffects(const Config& config, const std::vector<Experiment>& experiments, double duration_s,
                std::vector<Rig>* rigs) {
  const auto count = static_cast<double>(rigs->size());
  double pressure = 0.0;
  double heat_release = 0.0;
  double rate = 0.0;
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (std::size_t i = 0; i < rigs->size(); ++i) {
    pressure += (*rigs)[i].pressure_amplitude / count;
    heat_release += (*rigs)[i].heat_release_amplitude / count;
    rate += Rate((*rigs)[i], experiments[i]) / count;
    lowest = std::min(lowest, experiments[i].phi);
    highest = std::max(highest, experiments[i].phi);
  }
  for (std::size_t i = 0; i < rigs->size(); ++i) {
    Rig& rig = (*rigs)[i];
    SimulationScale scale;
    scale.at.phi_position =
        highest > lowest ? (experiments[i].phi - lowest) / (highest - lowest) - 0.5 : 0.0;
    scale.at.cycle_frequency_hz = experiments[i].frequency_hz;
    scale.at.relative_amplitude = rig.pressure_amplitude / pressure;
    scale.at.heat_release_over_pressure = heat_release / pressure;
    scale.at.own_heat_release_over_pressure = rig.heat_release_amplitude / rig.pressure_amplitude;
    scale.at.relative_rate_amplitude = Rate(rig, experiments[i]) / rate;
    scale.pressure_amplitude = rig.pressure_amplitude;
    scale.heat_release_amplitude = rig.heat_release_amplitude;
    scale.mean_pressure_amplitude = pressure;
    scale.mean_rate_amplitude = rate;
    scale.duration_s = duration_s;
    for (const SimulatedEffect& one : config.simulation.effects) {
      const std::string fault = one.effect->SimulationFault(rig.parameters, one.values);
      if (!fault.empty()) throw UserError(config.source.string(), one.line, one.key, fault);
      CHECK(one.effect->AddTo(scale, one.values, &rig.parameters)) << one.effect->id();
    }
  }
}

std::string LoopsText(const Options& options, const std::vector<Experiment>& experiments,
                      const std::vector<Rig>& rigs) {
  std::vector<SimulatedLoop> loops;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const Rig& rig = rigs[i];
    loops.push_back({experiments[i].name, rig.model_loop_gain, rig.loop_gain, rig.flame_slope,
                     rig.slope_raised});
  }
  return SimulationJson(options.Count("--member", 1, kMostMembers), loops).dump(2) + "\n";
}

void Print(const std::vector<Experiment>& experiments, const std::vector<Rig>& rigs) {
  TextTable table({"experiment", "loop gain", "starts", "file"});
  bool any_raised = false;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    any_raised = any_raised || rigs[i].slope_raised;
    table.AddRow({experiments[i].name,
                  Fixed(rigs[i].loop_gain, 3) + (rigs[i].slope_raised ? " *" : ""), rigs[i].origin,
                  experiments[i].name + ".csv"});
  }
  std::printf("%s", table.Text().c_str());
  if (any_raised) {
    std::printf("* the flame slope was raised to simulate.loop_gain_min: a cycle was observed\n");
  }
}

int Run(const Options& options) {
  const Config config = LoadConfig(options.config);
  const std::vector<Experiment> experiments = LoadExperiments(config, options);
  const SimulationTimes times = MakeSimulationTimes(config.simulation, experiments);
  CheckSimulationTimes(config, times, experiments);
  const std::vector<LoopModel> models = ModelsToSimulate(config, options, experiments);
  if (config.simulation.sweep) CheckSweep(config, times);
  std::vector<Rig> rigs;
  std::vector<SimulationCase> cases;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    rigs.push_back(MakeRig(config, experiments[i], models[i], times));
  }
  AddEffects(config, experiments, times.duration_s, &rigs);
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    CheckInternalRate(config, times, experiments[i], rigs[i].parameters);
    cases.push_back({rigs[i].parameters, UnitSeed(options.seed, experiments[i].name)});
  }
  const std::vector<SimulatedRecord> records =
      SimulateBatch(cases, {.duration_s = times.duration_s,
                            .sampling_hz = times.sampling_hz,
                            .settle_s = times.settle_s,
                            .threads = options.threads});
  for (std::size_t i = 0; i < records.size(); ++i) {
    WriteRecordCsv(options.out / (experiments[i].name + ".csv"),
                   {records[i].sampling_hz, records[i].pressure, records[i].heat_release});
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
    WriteWholeFile(options.out / "sweep.csv", SweepCsv(*config.simulation.sweep, sweeps));
  }
  if (!options.quiet) {
    Print(experiments, rigs);
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
      "With `sweep:` a parameter goes slowly there and back in one more run: sweep.csv, and where\n"
      "the loop jumps on the way up and on the way down.",
      {{"--member", "K", "member K of family.csv, which howl family wrote to DIR, not the fit"}},
      Run};
}

}  // namespace howl
