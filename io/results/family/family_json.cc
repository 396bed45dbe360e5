#include "io/results/family/family_json.h"

#include <algorithm>

#include "io/results/csv_writer.h"
#include "io/results/family/family_changes.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json TestJson(const MembershipTest& test) {
  return {
      {"gain_tolerance", NumberOrNull(test.gain_tolerance)},
      {"phase_tolerance_deg", NumberOrNull(test.phase_tolerance_deg)},
      {"loop_phase_tolerance_deg", NumberOrNull(test.loop_phase_tolerance_deg)},
      {"loop_gain_min", NumberOrNull(test.loop_gain_min)},
      {"second_crossing_tolerance_deg", NumberOrNull(test.second_crossing_tolerance_deg)},
      {"omega_spread_max", NumberOrNull(test.omega_spread_max)},
      {"xi_max", NumberOrNull(test.xi_max)},
      {"xi_increasing", test.xi_increasing},
      {"transfer_distance_max", NumberOrNull(test.transfer_distance_max)},
      {"second_mode_share_max", NumberOrNull(test.second_mode_share_max)},
      {"second_crossing_gain_min",
       test.second_crossing_gain_min > 0.0 ? Json(test.second_crossing_gain_min) : Json(nullptr)}};
}

Json OptionalNumber(const std::optional<double>& value) {
  return value ? NumberOrNull(*value) : Json(nullptr);
}

Json ExperimentsJson(const std::vector<Experiment>& experiments) {
  Json json = Json::array();
  for (const Experiment& experiment : experiments) {
    json.push_back({{"name", experiment.name},
                    {"phi", experiment.phi},
                    {"reliable", experiment.reliable},
                    {"frequency_hz", experiment.frequency_hz},
                    {"frequency_std_hz", OptionalNumber(experiment.frequency_std_hz)},
                    {"phase_deg", experiment.phase_deg},
                    {"phase_std_deg", OptionalNumber(experiment.phase_std_deg)},
                    {"gain", experiment.gain},
                    {"gain_std", OptionalNumber(experiment.gain_std)},
                    {"flame_slope", OptionalNumber(experiment.flame_slope)},
                    {"flame_slope_std", OptionalNumber(experiment.flame_slope_std)},
                    {"delay_periods", experiment.delay_periods}});
  }
  return json;
}

Json RangeJson(const Range& range) {
  return Json::array({NumberOrNull(range.lo), NumberOrNull(range.hi)});
}

// A bound that holds no member has null for `inner`.
Json BoundsJson(const FamilyProblem& problem, const Enclosure& enclosure) {
  Json bounds = Json::object();
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    Json& own = bounds[problem.experiments[i].name] = Json::object();
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!enclosure.IsBounded(i, parameter)) continue;
      const EnclosedBound bound = enclosure.Bound(i, parameter);
      const bool has_member = bound.inner.lo <= bound.inner.hi;
      own[std::string(FamilyParameterName(parameter))] = {
          {"outer", RangeJson(bound.outer)},
          {"inner", has_member ? RangeJson(bound.inner) : Json(nullptr)},
          {"closed", bound.closed}};
    }
  }
  return bounds;
}

Json CountsJson(const FamilyReport& report) {
  const CellCounts cells = report.enclosure.Counts();
  const SampleDiagnostics& what = report.diagnostics;
  return {
      {"members", report.members},
      {"requested", report.requested},
      {"effective_sample_size", NumberOrNull(what.effective_sample_size)},
      {"split_r_hat", NumberOrNull(what.split_r_hat)},
      {"largest_hole", NumberOrNull(what.largest_hole)},
      {"boxes",
       {{"outside", cells.outside}, {"undecided", cells.undecided}, {"pending", cells.pending}}}};
}

Json PredictionsJson(const std::vector<ExperimentPrediction>& predictions) {
  Json json = Json::array();
  for (const ExperimentPrediction& each : predictions) {
    const bool guaranteed = each.prediction.kind == IntervalKind::kGuaranteed;
    json.push_back({{"name", each.prediction.name},
                    {"experiment", each.experiment.empty() ? Json(nullptr) : Json(each.experiment)},
                    {"interval", each.prediction.interval.lo <= each.prediction.interval.hi
                                     ? RangeJson(each.prediction.interval)
                                     : Json(nullptr)},
                    {"kind", guaranteed ? "guaranteed" : "sampled"},
                    {"members", each.prediction.members}});
  }
  return json;
}

Json FurtherJson(const FurtherTest& further) {
  Json rejected_by = Json::object();
  for (const Condition condition : kConditions) {
    const std::size_t count = further.counts.rejected_by[static_cast<std::size_t>(condition)];
    if (count > 0) rejected_by[std::string(ConditionName(condition))] = count;
  }
  return {{"config", further.config},
          {"experiments", further.experiments},
          {"survive", further.counts.survive},
          {"rejected", further.counts.rejected},
          {"untested", further.counts.untested},
          {"rejected_by", rejected_by}};
}

Json AdviceJson(const std::vector<Advice>& advice) {
  Json json = Json::array();
  for (const Advice& one : advice) {
    const bool has_value = one.predicted.lo <= one.predicted.hi;
    json.push_back({{"measurement", one.name},
                    {"std", one.std},
                    {"expected_remaining", NumberOrNull(one.expected_remaining)},
                    {"predicted", has_value ? RangeJson(one.predicted) : Json(nullptr)}});
  }
  return json;
}

// The ranges in which members were found without the condition.
Json WithoutJson(const FamilyProblem& problem, const std::vector<Member>& members) {
  Json json = Json::object();
  for (std::size_t i = 0; i < problem.experiments.size() && !members.empty(); ++i) {
    Json& own = json[problem.experiments[i].name] = Json::object();
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (parameter == FamilyParameter::kM && problem.model.modes == 1) continue;
      Range seen{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      for (const Member& member : members) {
        const double value = ParameterValue(problem.experiments[i], member[i], parameter);
        seen = {std::min(seen.lo, value), std::max(seen.hi, value)};
      }
      if (seen.lo <= seen.hi) own[std::string(FamilyParameterName(parameter))] = RangeJson(seen);
    }
  }
  return json;
}

Json TransferJson(const FamilyProblem& problem, const TransferReport& report) {
  const TransferVolume& volume = report.volume;
  return {{"experiments", volume.experiments},
          {"finite_without", volume.finite_without},
          {"ln_volume_ratio", OptionalNumber(volume.ln_ratio)},
          {"ln_volume_ratio_std", volume.ln_ratio ? Json(volume.ln_std) : Json(nullptr)},
          {"least_distance", OptionalNumber(volume.least_distance)},
          {"seen_without", WithoutJson(problem, report.without)}};
}

Json ProfileJson(const ProfileReport& report) {
  const Profile& profile = report.profile;
  return {{"quantity", report.quantity},
          {"interval", RangeJson({profile.lo, profile.hi})},
          {"ends", {ProfileEndName(profile.lo_end), ProfileEndName(profile.hi_end)}},
          {"points", profile.points.size()},
          {"flagged", profile.flagged},
          {"sound", profile.IsSound()}};
}

}  // namespace

std::string_view ProfileEndName(ProfileEnd end) {
  constexpr std::string_view kNames[] = {"edge", "bound", "failed", "points"};
  return kNames[static_cast<std::size_t>(end)];
}

Json FamilyJson(const FamilyReport& report) {
  const bool has_members = report.members > 0;
  Json empty_because = Json::array();
  for (const std::string_view name : ConflictNames(report.conflict)) empty_because.push_back(name);
  Json json = {
      {"schema", "howl.family/1"},
      {"experiments", ExperimentsJson(report.problem.experiments)},
      {"test", TestJson(report.problem.test)},
      {"counts", CountsJson(report)},
      {"bounds", has_members ? BoundsJson(report.problem, report.enclosure) : Json::object()},
      {"predictions", PredictionsJson(report.predictions)},
      {"empty_because", empty_because}};
  if (report.falsified) json["falsified"] = FurtherJson(*report.falsified);
  if (report.advice) json["advice"] = AdviceJson(*report.advice);
  if (report.transfer) json["transfer"] = TransferJson(report.problem, *report.transfer);
  if (report.profile) json["profile"] = ProfileJson(*report.profile);
  if (report.conflict.is_empty) {
    json["conflict"] = ConflictJson(report.problem, report.conflict, report.recorded);
  }
  return json;
}

Json FamilyFiguresJson(const FamilyReport& report) {
  const Json whole = FamilyJson(report);
  Json figures = {{"test", whole["test"]},
                  {"counts", {{"members", report.members}, {"requested", report.requested}}},
                  {"bounds", whole["bounds"]},
                  {"predictions", whole["predictions"]}};
  for (const char* const key : {"transfer", "conflict"}) {
    if (whole.contains(key)) figures[key] = whole[key];
  }
  return figures;
}

std::string ProfileCsv(std::span<const Experiment> experiments, const Profile& profile) {
  constexpr std::string_view kNames[kProfileParameters] = {"omega_hz", "xi", "N", "M", "tau_s"};
  std::string header = "value,cost,flagged";
  for (const Experiment& experiment : experiments) {
    for (const std::string_view name : kNames) {
      header += "," + experiment.name + "." + std::string(name);
    }
  }
  CsvWriter csv(header);
  for (const ProfilePoint& point : profile.points) {
    csv.Cell(point.value).Cell(point.cost).Cell(point.flagged ? "true" : "false");
    for (const double parameter : point.parameters) csv.Cell(parameter);
    csv.EndRow();
  }
  return csv.Text();
}

std::string TradeoffCsv(std::span<const TradeoffPoint> points) {
  CsvWriter csv("omega_spread,xi_max");
  for (const TradeoffPoint& point : points) {
    if (!point.xi_max) continue;
    csv.Cell(point.omega_spread).Cell(*point.xi_max).EndRow();
  }
  return csv.Text();
}

}  // namespace howl
