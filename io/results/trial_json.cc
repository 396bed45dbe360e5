#include "io/results/trial_json.h"

#include <algorithm>
#include <cmath>

#include "io/results/csv_writer.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

// The price of parameters that diagnose subtracts from a gain, and what it adds where a signal is
// plainly clipped or quantised (diagnosis/); neither belongs to the in-sample gain.
constexpr double kParameterDataSize = 500.0;
constexpr double kFlagGain = 1e6;

double Number(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

Json TallyJson(const Tally& tally) {
  return {{"right", tally.right},
          {"total", tally.total},
          {"share", NumberOrNull(tally.Share())},
          {"interval", {tally.Low(), tally.High()}}};
}

Json AccuracyJson(const Accuracy& accuracy) {
  return {{"effect", TallyJson(accuracy.named)},
          {"class_of_at_most_three", TallyJson(accuracy.in_class)},
          {"block", TallyJson(accuracy.block)}};
}

Json MethodJson(const MethodScore& score) {
  Json by_severity = Json::object();
  for (const auto& [severity, accuracy] : score.by_severity) {
    by_severity[SeverityName(severity)] = AccuracyJson(accuracy);
  }
  Json reliability = Json::array();
  for (const ReliabilityBin& bin : score.reliability) {
    Json entry = {{"probability", {bin.low, bin.high}},
                  {"mean_probability", NumberOrNull(bin.mean_probability)}};
    entry["right"] = TallyJson(bin.right);
    reliability.push_back(entry);
  }
  Json by_answer = Json::object();
  for (const auto& [kind, right] : score.by_answer) by_answer[kind] = TallyJson(right);
  return {{"method", score.method},
          {"by_severity", by_severity},
          {"all_severities", AccuracyJson(score.catalogue)},
          {"medium_and_large", AccuracyJson(score.medium_and_large)},
          {"false_alarms", TallyJson(score.false_alarms)},
          {"effect_named_where_there_is_none", TallyJson(score.accused)},
          {"unknown_recall", TallyJson(score.unknown_recall)},
          {"unknown_recall_medium_and_large", TallyJson(score.unknown_recall_medium_and_large)},
          {"block_of_unknown", TallyJson(score.outside_block)},
          {"false_unknowns", TallyJson(score.false_unknowns)},
          {"two_effects",
           {{"both_named", TallyJson(score.pairs_both_named)},
            {"one_named", TallyJson(score.pairs_one_named)},
            {"unknown", TallyJson(score.pairs_unknown)}}},
          {"log_score", NumberOrNull(score.log_score)},
          {"brier", NumberOrNull(score.brier)},
          {"median_shrinkage_over_oracle", NumberOrNull(score.median_shrinkage_over_oracle)},
          {"cases_with_oracle", score.oracle_cases},
          {"right_by_answer", by_answer},
          {"reliability", reliability}};
}

Json PowerJson(const EffectPower& power) {
  return {{"effect", power.effect},
          {"cases", power.cases},
          {"found", power.found},
          {"resolved", power.resolved},
          {"parameter", power.size_name},
          {"size_found_with_90_percent", power.resolved ? NumberOrNull(power.size) : Json(nullptr)},
          {"size_interval", {NumberOrNull(power.size_low), NumberOrNull(power.size_high)}},
          {"severity", power.severity},
          {"severity_interval", {power.severity_low, power.severity_high}}};
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

void ReadDiagnosis(const nlohmann::json& diagnosis, CaseOutcome* one) {
  const nlohmann::json& verdict = diagnosis.at("verdict");
  one->answered = true;
  one->kind = verdict.at("kind").get<std::string>();
  if (verdict.at("effect").is_string()) one->effect = verdict.at("effect").get<std::string>();
  one->indistinguishable = verdict.at("indistinguishable").get<std::vector<std::string>>();
  for (const auto& [label, p] : verdict.at("probability").items()) {
    one->probability[label] = Number(p);
  }
  for (const nlohmann::json& place : diagnosis.at("where")) {
    one->blocks.push_back(place.at("block").get<std::string>());
  }
  const nlohmann::json& gap = diagnosis.at("gap");
  one->gap_before = Number(gap.at("before"));
  one->gap_after = Number(gap.at("after"));
  one->gap_floor = Number(gap.at("floor"));
  for (const nlohmann::json& each : diagnosis.at("candidates")) {
    CandidateOutcome candidate;
    candidate.effect = each.at("effect").get<std::string>();
    candidate.gap_after = Number(each.at("gap_after"));
    candidate.shrinkage = Number(each.at("shrinkage"));
    candidate.gain = Number(each.at("log_likelihood_gain"));
    if (each.contains("in_sample_gain")) {
      candidate.in_sample_gain = Number(each.at("in_sample_gain"));
    } else {
      candidate.in_sample_gain =
          candidate.gain +
          0.5 * static_cast<double>(each.at("parameters").size()) * std::log(kParameterDataSize);
    }
    const double flags = kFlagGain * std::round(candidate.in_sample_gain / kFlagGain);
    candidate.in_sample_gain -= flags;
    candidate.gain -= flags;
    one->candidates.push_back(std::move(candidate));
  }
}

Json TrialJson(const ScoreSheet& sheet, const Json& about) {
  Json rivals = Json::array();
  for (const MethodScore& rival : sheet.rivals) rivals.push_back(MethodJson(rival));
  Json effects = Json::object();
  for (const auto& [id, accuracy] : sheet.by_effect) effects[id] = AccuracyJson(accuracy);
  Json outside = Json::object();
  for (const auto& [id, tallies] : sheet.outside) {
    outside[id] = {{"unknown", TallyJson(tallies.first)}, {"block", TallyJson(tallies.second)}};
  }
  Json power = Json::array();
  for (const EffectPower& each : sheet.power) power.push_back(PowerJson(each));
  return {{"schema", "howl.trial/1"},
          {"about", about},
          {"cases", sheet.cases},
          {"failed", sheet.failed},
          {"floor",
           {{"cases", sheet.floor.cases},
            {"median_gap", NumberOrNull(sheet.floor.median_gap)},
            {"largest_gap", NumberOrNull(sheet.floor.largest_gap)},
            {"median_sampling_floor", NumberOrNull(sheet.floor.median_floor)}}},
          {"diagnose", MethodJson(sheet.howl)},
          {"rivals", rivals},
          {"effects", effects},
          {"outside_the_catalogue", outside},
          {"confusion",
           {{"withheld", sheet.confusion.rows},
            {"answer", sheet.confusion.columns},
            {"count", sheet.confusion.count}}},
          {"power", power}};
}

std::string TrialCsv(std::span<const CaseOutcome> cases) {
  CsvWriter csv(
      "case,withheld,block,severity,answer,indistinguishable,named,in_class,block_answer,"
      "block_right,probability_of_answer,probability_of_truth,gap_before,gap_after,gap_floor,"
      "seconds");
  for (const CaseOutcome& one : cases) {
    std::vector<std::string> ids;
    std::vector<std::string> blocks;
    for (const WithheldEffect& each : one.withheld) {
      ids.push_back(each.id);
      blocks.push_back(each.block);
    }
    const auto probability = [&](const std::string& label) {
      const auto found = one.probability.find(label);
      return found == one.probability.end() ? 0.0 : found->second;
    };
    csv.Cell(one.name)
        .Cell(ids.empty() ? "none" : Joined(ids))
        .Cell(Joined(blocks))
        .Cell(ids.empty() ? "" : SeverityName(one.Severity()))
        .Cell(one.AnswerName())
        .Cell(Joined(one.indistinguishable));
    const bool is_none = one.withheld.empty();
    const bool is_unknown = one.Truth() == TruthKind::kOutside;
    const bool named = is_none      ? one.kind == "none"
                       : is_unknown ? one.kind == "unknown"
                                    : IsNamed(one);
    csv.Cell(named ? "1" : "0")
        .Cell(named || IsInClass(one) ? "1" : "0")
        .Cell(one.blocks.empty() ? "" : one.blocks[0])
        .Cell(is_none             ? ""
              : IsRightBlock(one) ? "1"
                                  : "0")
        .Cell(probability(one.AnswerName()))
        .Cell(probability(one.TruthName()))
        .Cell(one.gap_before)
        .Cell(one.gap_after)
        .Cell(one.gap_floor)
        .Cell(one.seconds);
    csv.EndRow();
  }
  return csv.Text();
}

}  // namespace howl
