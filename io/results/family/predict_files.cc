#include "io/results/family/predict_files.h"

#include <array>
#include <cmath>

#include "io/results/csv_writer.h"
#include "io/results/family/sampled_value_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json EndJson(const CycleEnd& end) {
  return {{"value", NumberOrNull(end.median)},
          {"lo", NumberOrNull(end.lo)},
          {"hi", NumberOrNull(end.hi)},
          {"share_crossing", end.share_crossing}};
}

Json GuaranteedJson(const std::optional<GuaranteedPoint>& point) {
  if (!point) return nullptr;
  Json json = Json::object();
  if (point->frequency_hz) {
    json["frequency_hz"] = {point->frequency_hz->lo, point->frequency_hz->hi};
  }
  for (const auto& [parameter, range] : point->parameters) {
    json[std::string(FamilyParameterName(parameter))] = {NumberOrNull(range.lo),
                                                         NumberOrNull(range.hi)};
  }
  return json;
}

}  // namespace

std::string PointKindName(PointKind kind) {
  constexpr std::array<const char*, 4> kNames = {"measured", "between", "beyond", "outside"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string AmplitudeName(const PredictReport& report) {
  return report.flame == "assumed" ? "q_amplitude_relative" : "p_amplitude";
}

std::string PredictCsv(const PredictReport& report) {
  const OwnNameColumn own(report.operating_parameter);
  CsvWriter csv("phi,quantity,value,lo,hi,guaranteed_lo,guaranteed_hi" + own.Header());
  constexpr Range kNone{std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::quiet_NaN()};
  for (std::size_t k = 0; k < report.points.size(); ++k) {
    const PointPrediction& point = report.points[k];
    const auto& guaranteed = report.guaranteed[k];
    const auto row = [&](const std::string& name, const SampledValue& value, const Range& sure) {
      csv.Cell(point.phi).Cell(name).Cell(value.median).Cell(value.lo).Cell(value.hi);
      csv.Cell(sure.lo).Cell(sure.hi);
      own.Add(csv, point.phi).EndRow();
    };
    Range loop_gain = kNone;
    if (guaranteed) {
      for (const auto& [parameter, range] : guaranteed->parameters) {
        if (parameter == FamilyParameter::kLoopGain) loop_gain = range;
      }
    }
    row("frequency_hz", point.frequency_hz,
        guaranteed && guaranteed->frequency_hz ? *guaranteed->frequency_hz : kNone);
    row("growth_rate_1_s", point.growth_rate, kNone);
    row("loop_gain", point.loop_gain, loop_gain);
    row(AmplitudeName(report), point.amplitude, kNone);
    row("share_unstable", {.median = point.share_unstable}, kNone);
  }
  return csv.Text();
}

Json PredictJson(const PredictReport& report) {
  Json points = Json::array();
  for (std::size_t k = 0; k < report.points.size(); ++k) {
    const PointPrediction& point = report.points[k];
    const auto& guaranteed = report.guaranteed[k];
    points.push_back({{"phi", point.phi},
                      {"status", PointKindName(point.kind)},
                      {"experiment", guaranteed ? Json(guaranteed->experiment) : Json(nullptr)},
                      {"next_to_unreliable", point.rests_on_unreliable},
                      {"paths", point.members},
                      {"paths_without_loop", point.without},
                      {"frequency_hz", SampledValueJson(point.frequency_hz)},
                      {"growth_rate_1_s", SampledValueJson(point.growth_rate)},
                      {"loop_gain", SampledValueJson(point.loop_gain)},
                      {AmplitudeName(report), SampledValueJson(point.amplitude)},
                      {"share_unstable", NumberOrNull(point.share_unstable)},
                      {"guaranteed", GuaranteedJson(guaranteed)}});
  }
  Json cycle = nullptr;
  if (report.cycle) {
    cycle = {{"from", report.cycle->from_phi},
             {"share_unstable", report.cycle->share_unstable},
             {"begins", EndJson(report.cycle->below)},
             {"ends", EndJson(report.cycle->above)}};
  }
  return {{"schema", "howl.prediction/1"},
          {"operating_parameter", report.operating_parameter},
          {"members", report.members},
          {"paths", report.paths},
          {"interval", "95 % of the members"},
          {"flame", report.flame},
          {"scatter_known", report.scatter_known},
          {"points", points},
          {"cycle", cycle}};
}

}  // namespace howl
