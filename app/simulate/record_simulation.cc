#include "app/simulate/record_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/input/record_solution.h"
#include "app/simulate/simulate_times.h"
#include "app/text/text_table.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "estimation/joint_records/fitted_rig.h"
#include "estimation/parallel.h"
#include "estimation/unit_seed.h"
#include "io/memory.h"
#include "io/records/records.h"
#include "io/results/record_simulation_json.h"
#include "io/results/records_yaml.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

constexpr std::array<std::string_view, 4> kTaken = {"duration_s", "sampling_hz", "settle_s",
                                                    "start"};
// Of p, q, v and noise at the internal rate, and of the transforms that make the noise.
constexpr double kBytesPerStep = 100.0;

[[noreturn]] void Fail(const Config& config, std::string_view key, const std::string& what) {
  const LocatedMember* const simulate = config.tree.Find("simulate");
  const LocatedMember* const member =
      simulate != nullptr ? simulate->value.Find(std::string(key)) : nullptr;
  const int line = member != nullptr     ? member->key_line
                   : simulate != nullptr ? simulate->key_line
                                         : 1;
  throw UserError(config.source.string(), line, "simulate." + std::string(key), what);
}

// Its flame and noise are those that the records show: what states others must not be passed over.
void RequireTaken(const Config& config) {
  if (config.record_loop) {
    const RecordLoopSpec& loop = *config.record_loop;
    const auto fail = [&](const char* key, const char* expected) {
      throw UserError(
          config.source.string(), config.model_line, key,
          std::string("is not taken by simulate, which has one delay, expected ") + expected);
    };
    if (loop.delay_spread != DelaySpread::kNone) fail("model.delay_spread", "none");
    if (loop.second_path) fail("model.delay_paths", "1");
  }
  const LocatedMember* const simulate = config.tree.Find("simulate");
  if (simulate == nullptr) return;
  for (const LocatedMember& member : simulate->value.members) {
    if (std::ranges::find(kTaken, member.key) != kTaken.end()) continue;
    Fail(config, member.key,
         "is not taken by a loop that is fitted to whole records, whose flame and noise they show; "
         "expected duration_s, sampling_hz, settle_s or start");
  }
  if (config.simulation.start == SimulationStart::kUpperCycle) {
    Fail(config, "start", "is upper, expected observed or rest for a loop fitted to whole records");
  }
}

std::vector<Experiment> ExperimentsOf(const RecordSolution& solution) {
  std::vector<Experiment> out;
  for (std::size_t e = 0; e < solution.loop.points.size(); ++e) {
    Experiment experiment;
    experiment.name = solution.names[e];
    experiment.phi = solution.loop.points[e].operating_parameter;
    experiment.frequency_hz = solution.fitted[e].cycle_hz;
    out.push_back(std::move(experiment));
  }
  return out;
}

// As long as the longest record and at the highest rate, where the config states no other.
SimulationTimes TimesOf(const Config& config, const RecordSolution& solution,
                        const std::vector<Experiment>& experiments) {
  SimulationTimes times = MakeSimulationTimes(config.simulation, experiments);
  double duration_s = 0.0;
  double sampling_hz = 0.0;
  for (const OperatingPoint& point : solution.loop.points) {
    duration_s = std::max(duration_s, 1.0 / point.record.bin_hz);
    sampling_hz = std::max(sampling_hz, point.record.sampling_hz);
  }
  times.duration_s = config.simulation.duration_s.value_or(duration_s);
  times.sampling_hz = config.simulation.sampling_hz.value_or(sampling_hz);
  return times;
}

std::vector<ModalRig> RigsOf(const Config& config, const RecordSolution& solution) {
  const RecordsFit& fit = solution.loop.fit;
  std::vector<ModalRig> rigs;
  for (std::size_t e = 0; e < solution.loop.points.size(); ++e) {
    const RecordSpectra& record = solution.loop.points[e].record;
    const bool at_rest = config.simulation.start == SimulationStart::kRest;
    rigs.push_back(
        FittedRigOf(record, fit.structure,
                    ToPoint(fit.structure, record.flame.cols(), fit.points[e].parameters),
                    at_rest ? 0.0 : solution.cycle_amplitude[e]));
  }
  return rigs;
}

void RequireMemory(const Config& config, const SimulationTimes& times,
                   const std::vector<ModalRig>& rigs, int threads) {
  double most = 0.0;
  for (const ModalRig& rig : rigs) {
    most = std::max(most, ModalInternalRate(rig, times.sampling_hz));
  }
  const double at_once = static_cast<double>(std::min(rigs.size(), std::size_t(threads)));
  const double bytes = kBytesPerStep * most * (times.duration_s + times.settle_s) * at_once;
  if (bytes <= MemoryBytes()) return;
  Fail(config, "duration_s",
       Significant(times.duration_s, 4) + " s at " + Significant(most, 4) +
           " steps a second need " + Significant(bytes * 1e-9, 3) +
           " GB of memory, expected at "
           "most " +
           Significant(MemoryBytes() * 1e-9, 3) + ": a shorter duration_s");
}

double RootMeanSquare(const std::vector<double>& x) {
  double sum = 0.0;
  double square = 0.0;
  for (const double value : x) {
    sum += value;
    square += value * value;
  }
  const auto count = static_cast<double>(x.size());
  return std::sqrt(std::max(square / count - sum * sum / (count * count), 0.0));
}

std::string StartText(const ModalRig& rig) {
  if (!rig.past) return "at rest";
  return "on the cycle at " + Fixed(rig.past->frequency_hz, 1) + " Hz";
}

std::string Text(const RecordSolution& solution, const std::vector<ModalRig>& rigs,
                 const std::vector<SimulatedRecord>& records) {
  TextTable table({"experiment", "loop gain", "starts", "p rms", "recorded", "file"});
  for (std::size_t e = 0; e < rigs.size(); ++e) {
    table.AddRow({solution.names[e],
                  Significant(solution.fitted[e].small_signal.loop_gain.value, 4),
                  StartText(rigs[e]), Significant(RootMeanSquare(records[e].pressure), 4),
                  Significant(solution.loop.points[e].record.scale.pressure, 4),
                  solution.names[e] + ".csv"});
  }
  return table.Text() + "the loops, flames and noise are those that the records show\n";
}

}  // namespace

int RunRecordSimulation(const Config& config, const Options& options) {
  if (options.Has("--member")) {
    throw UsageError(
        "--member: the config's model is fitted to whole records and has no family, expected none");
  }
  RequireTaken(config);
  const RecordSolution solution = SolveRecords(config, options, SolvedFor::kLoops);
  const std::vector<Experiment> experiments = ExperimentsOf(solution);
  const SimulationTimes times = TimesOf(config, solution, experiments);
  CheckSimulationTimes(config, times, experiments);
  const std::vector<ModalRig> rigs = RigsOf(config, solution);
  RequireMemory(config, times, rigs, options.threads);
  std::vector<SimulatedRecord> records(rigs.size());
  RunUnits(rigs.size(), options.threads, [&](std::size_t e) {
    records[e] = SimulateModal(rigs[e],
                               {.duration_s = times.duration_s,
                                .sampling_hz = times.sampling_hz,
                                .settle_s = times.settle_s},
                               UnitSeed(options.seed, experiments[e].name));
  });
  const std::string text = Text(solution, rigs, records);
  for (std::size_t e = 0; e < rigs.size(); ++e) {
    WriteRecordCsv(options.out / (experiments[e].name + ".csv"), ToRecord(std::move(records[e])));
  }
  WriteWholeFile(options.out / "records.yaml", RecordsYaml(config, experiments, times.sampling_hz));
  WriteWholeFile(options.out / "simulation.json",
                 RecordSimulationJson(solution, rigs).dump(2) + "\n");
  if (!options.quiet) {
    std::printf(
        "%swritten: records, records.yaml (a config of their own) and simulation.json in "
        "%s\n",
        text.c_str(), options.out.c_str());
  }
  return solution.Converged() ? kDone : kNegativeAnswer;
}

}  // namespace howl
