#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/command_line/asked_points.h"
#include "app/command_line/command.h"
#include "app/command_line/map_axes.h"
#include "app/family/bounds_run.h"
#include "app/family/family_questions.h"
#include "app/family/family_run.h"
#include "app/family/predict_map.h"
#include "app/family/record_predict_run.h"
#include "app/input/measured_flame.h"
#include "app/input/problem_input.h"
#include "app/input/without_conditions.h"
#include "app/text/conflict_text.h"
#include "app/text/predict_text.h"
#include "io/config/reading/config_reading.h"
#include "io/result_files.h"
#include "io/results/family/predict_files.h"
#include "io/results/family/stability_map_files.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

void CheckPoints(const Config& config, const OperatingPoints& points,
                 const std::vector<double>& asked) {
  if (points.size() > 1) return;
  for (const double phi : asked) {
    if (points.Measured(phi)) continue;
    throw UserError(config.source.string(), config.experiments.front().line, "experiments",
                    "one operating point, from which --at " + std::to_string(phi) +
                        " cannot be told, expected two or more; what is possible is --at " +
                        std::to_string(points.phi(0)) + ", the measured one");
  }
}

PredictedFlame FlameOf(const Config& config, const ProblemInput& input) {
  PredictedFlame flame;
  const SimulationSpec& spec = config.simulation;
  if (spec.flame_is_given) {
    flame.stated = Flame<double>{spec.flame_shape, -1.0, spec.saturation, 0.0};
    return flame;
  }
  for (const Experiment& experiment : input.experiments) {
    flame.measured.push_back(MeasuredFlame(input, experiment));
  }
  return flame;
}

// Of a point that one experiment measured.
std::optional<GuaranteedPoint> GuaranteeAt(const FamilyRun& run, const OperatingPoints& points,
                                           double phi) {
  const auto measured = points.Measured(phi);
  if (!measured || points.ExperimentsAt(*measured).size() != 1) return std::nullopt;
  const std::size_t i = points.ExperimentsAt(*measured).front();
  const Experiment& experiment = run.problem.experiments[i];
  GuaranteedPoint point;
  point.experiment = experiment.name;
  for (const FamilyParameter parameter : kFamilyParameters) {
    if (!HasParameter(run.problem, i, parameter) || !run.enclosure->IsBounded(i, parameter)) {
      continue;
    }
    const Range outer = run.enclosure->Bound(i, parameter).outer;
    point.parameters.emplace_back(parameter, outer);
    if (parameter != FamilyParameter::kTau) continue;
    if (const auto reach_hz = GuaranteedReachHz(run.problem, outer.lo)) {
      point.frequency_hz = {experiment.frequency_hz - *reach_hz,
                            experiment.frequency_hz + *reach_hz};
    }
  }
  return point;
}

PredictReport Predict(const Config& config, const Options& options, const FamilyRun& run,
                      const CarriedMembers& carried, const PredictedFlame& flame,
                      const std::vector<double>& asked) {
  const auto& [points, members, paths] = carried;
  PredictReport report;
  report.operating_parameter = config.operating_parameter;
  report.members = members;
  report.paths = paths.size();
  report.flame = flame.stated ? "config" : flame.IsAssumed() ? "assumed" : "measured";
  report.scatter_known = points.size() != 2;
  report.points = PredictPoints(run.problem, points, paths, flame, asked, options.threads);
  for (const PointPrediction& point : report.points) {
    report.guaranteed.push_back(GuaranteeAt(run, points, point.phi));
  }
  report.cycle = FindCycleLimits(points, paths, options.threads);
  return report;
}

// The points of --at; with a map alone the measured ones.
std::vector<double> AskedPoints(const Options& options, const std::optional<AskedMap>& map,
                                const OperatingPoints& points) {
  std::vector<double> asked;
  if (const auto at = options.Text("--at")) {
    asked = ParseAskedPoints("--at", *at);
  } else {
    for (std::size_t k = 0; k < points.size(); ++k) asked.push_back(points.phi(k));
  }
  if (!map || map->HasOperatingAxis() || asked.size() == 1) return asked;
  throw UsageError("--map: neither quantity is the operating parameter, expected one point, --at " +
                   std::to_string(points.phi(0)));
}

int RunPredictCommand(const Options& options) {
  if (const auto at = options.Text("--at")) ParseAskedPoints("--at", *at);
  const Config as_it_is = LoadConfig(options.config, LoopsTaken::kAny);
  if (as_it_is.record_loop) return RunRecordPrediction(as_it_is, options);
  if (!options.Has("--at") && !options.Has("--map")) {
    throw UsageError("predict: no operating point given, expected --at 0.6 or --at FROM:TO:STEP");
  }
  const Config config = WithoutConditions(as_it_is, options);
  const std::optional<AskedMap> map = ParseMap(config, options);
  const ProblemInput input = LoadInput(config, options);
  RequireExperiments(config, options, input);
  const OperatingPoints points(input.experiments);
  const std::vector<double> asked = AskedPoints(options, map, points);
  CheckPoints(config, points, asked);
  if (map && map->HasOperatingAxis() && points.size() < 2) {
    throw UsageError("--map: one operating point, expected two or more for an axis of it");
  }
  const FamilyRun run = RunFamilyAnew(config, options, input.experiments);
  if (run.members.empty()) {
    if (!options.quiet) PrintConflict(run.problem, run.conflict, run.recorded);
    return kNegativeAnswer;
  }
  const CarriedMembers carried = CarryMembers(options, run);
  const PredictReport report =
      Predict(config, options, run, carried, FlameOf(config, input), asked);
  nlohmann::ordered_json json = PredictJson(report);
  std::string text = PredictText(report);
  std::string written = "prediction.csv and prediction.json";
  std::error_code ignored;
  std::filesystem::remove(options.out / kPredictionMapCsv, ignored);  // of an earlier prediction
  if (map) {
    const MapReport mapped = MakeMap(config, options, carried, asked, *map);
    WriteWholeFile(options.out / kPredictionMapCsv, StabilityMapCsv(mapped));
    json["map"] = StabilityMapJson(mapped);
    text += MapText(mapped);
    written = "prediction.csv, prediction_map.csv and prediction.json";
  }
  WriteWholeFile(options.out / kPredictionCsv, PredictCsv(report));
  WriteWholeFile(options.out / "prediction.json", json.dump(2) + "\n");
  if (!options.quiet) {
    std::printf("%swritten: %s in %s\n", text.c_str(), written.c_str(), options.out.c_str());
  }
  const bool any = std::ranges::any_of(
      report.points, [](const PointPrediction& point) { return point.members > 0; });
  return any ? kDone : kNegativeAnswer;
}

}  // namespace

Command PredictCommand() {
  return {
      "predict",
      "what the family says of operating points that nobody measured",
      "Lists the family as howl family does, carries every member to the operating points\n"
      "asked for, and says how the loop would oscillate there: frequency, growth rate at rest,\n"
      "amplitude of the limit cycle, the share of members that is unstable, each with the\n"
      "interval that holds 95 % of the members; and where the cycle begins and ends. Only at\n"
      "a measured point is any of it guaranteed. A point further away than the measured range\n"
      "is wide has no prediction. Writes prediction.csv and prediction.json. Exits with 1\n"
      "when the family is empty, or no point asked for can be predicted. --map adds a\n"
      "stability chart over two quantities, prediction_map.csv. Of a loop that is fitted to\n"
      "whole records it says what the records tell, and the law over their points.",
      {{"--at", "PHI...",
        "operating points: 0.6 or 0.5:0.7:0.01 (from, to, step), joined by commas (with --map:\n"
        "the measured ones)"},
       WithoutOption(),
       {"--map", "X:Y",
        "growth rate at rest over two of the operating parameter, omega_hz, xi, N, M, tau_s and "
        "flame_slope"},
       {"--map-x", "FROM:TO:STEP", "values of X (default: 41 over what was measured or listed)"},
       {"--map-y", "FROM:TO:STEP", "values of Y"}},
      RunPredictCommand};
}

}  // namespace howl
