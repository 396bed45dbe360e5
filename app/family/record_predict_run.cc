#include "app/family/record_predict_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command_line/asked_points.h"
#include "app/command_line/command.h"
#include "app/input/record_solution.h"
#include "app/text/record_predict_text.h"
#include "estimation/joint_records/loop_prediction.h"
#include "io/result_files.h"
#include "io/results/record_prediction_files.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

// Two points or more at different operating parameters.
void RequirePoints(const Config& config) {
  const double first = config.experiments.front().experiment.phi;
  const bool several = std::ranges::any_of(config.experiments, [&](const ExperimentConfig& each) {
    return each.experiment.phi != first;
  });
  if (several) return;
  throw UserError(config.source.string(), config.experiments.front().line, "experiments",
                  "one operating point, from which no other can be told, expected two or more");
}

std::vector<double> AskedPoints(const Options& options, const std::vector<OperatingPoint>& points) {
  if (const auto at = options.Text("--at")) return ParseAskedPoints("--at", *at);
  std::vector<double> all;
  for (const OperatingPoint& point : points) all.push_back(point.operating_parameter);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string KindOf(double at, double lowest, double highest, bool measured) {
  if (measured) return "measured";
  if (at >= lowest && at <= highest) return "between";
  const double beyond = at < lowest ? lowest - at : at - highest;
  return beyond > highest - lowest ? "outside" : "beyond";
}

RecordPrediction Predict(const Config& config, const Options& options,
                         const RecordSolution& solution) {
  std::vector<OnsetPoint> loops;
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (std::size_t e = 0; e < solution.loop.points.size(); ++e) {
    const double at = solution.loop.points[e].operating_parameter;
    loops.push_back({at, solution.fitted[e].small_signal});
    lowest = std::min(lowest, at);
    highest = std::max(highest, at);
  }
  const LoopPredictor predictor(loops);
  RecordPrediction out;
  out.operating_parameter = config.operating_parameter;
  out.measured_points = solution.loop.points.size();
  for (const double at : AskedPoints(options, solution.loop.points)) {
    RecordPredictionPoint point{at, "", "", predictor.At(at)};
    if (point.loop.measured) point.experiment = solution.names[*point.loop.measured];
    point.kind = KindOf(at, lowest, highest, point.loop.measured.has_value());
    if (point.kind == "outside") point.loop = NoPrediction();
    out.points.push_back(std::move(point));
  }
  return out;
}

}  // namespace

int RunRecordPrediction(const Config& config, const Options& options) {
  for (const char* const option : {"--map", "--map-x", "--map-y", "--without"}) {
    if (!options.Has(option)) continue;
    throw UsageError(std::string(option) +
                     ": the config's model is fitted to whole records and has no family, expected "
                     "--at alone");
  }
  if (const auto at = options.Text("--at")) ParseAskedPoints("--at", *at);
  RequirePoints(config);
  const RecordSolution solution = SolveRecords(config, options, SolvedFor::kLoops);
  const RecordPrediction prediction = Predict(config, options, solution);
  std::error_code ignored;
  std::filesystem::remove(options.out / kPredictionMapCsv, ignored);  // of an earlier prediction
  WriteWholeFile(options.out / kPredictionCsv, RecordPredictionCsv(prediction));
  WriteWholeFile(options.out / "prediction.json", RecordPredictionJson(prediction).dump(2) + "\n");
  if (!options.quiet) {
    std::printf("%swritten: prediction.csv and prediction.json in %s\n",
                RecordPredictText(prediction).c_str(), options.out.c_str());
  }
  const bool any = std::ranges::any_of(prediction.points, [](const RecordPredictionPoint& point) {
    return std::isfinite(point.loop.frequency_hz.value);
  });
  return any ? kDone : kNegativeAnswer;
}

}  // namespace howl
