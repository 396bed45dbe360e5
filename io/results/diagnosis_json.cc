#include "io/results/diagnosis_json.h"

#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json VerdictJson(const Diagnosis& diagnosis) {
  Json probability = Json::object();
  for (const Candidate& candidate : diagnosis.candidates) {
    probability[candidate.effect] = candidate.probability;
  }
  probability["none"] = diagnosis.probability_none;
  probability["unknown"] = diagnosis.probability_unknown;
  return {
      {"kind", VerdictKindName(diagnosis.kind)},
      {"effect", diagnosis.kind == VerdictKind::kEffect ? Json(diagnosis.effect) : Json(nullptr)},
      {"indistinguishable", diagnosis.indistinguishable},
      {"together", diagnosis.together.empty() ? Json(nullptr) : Json(diagnosis.together)},
      {"probability", probability}};
}

Json WhereJson(const std::vector<Place>& places) {
  Json where = Json::array();
  for (const Place& place : places) {
    where.push_back({{"block", LoopBlockName(place.block)},
                     {"band_hz", {place.low_hz, place.high_hz}},
                     {"experiments", place.experiments},
                     {"share", place.share}});
  }
  return where;
}

Json OctavesJson(const std::vector<OctaveGap>& octaves) {
  Json out = Json::array();
  for (const OctaveGap& each : octaves) {
    out.push_back({{"experiment", each.experiment},
                   {"block", LoopBlockName(each.block)},
                   {"octave", each.octave},
                   {"band_hz", {each.low_hz, each.high_hz}},
                   {"gap", each.gap},
                   {"share", each.share}});
  }
  return out;
}

Json MapJson(const Diagnosis& diagnosis) {
  Json map = Json::array();
  for (const GapCell& cell : diagnosis.map) {
    map.push_back({{"signal", cell.signal},
                   {"experiment", cell.experiment},
                   {"band_hz", {cell.low_hz, cell.high_hz}},
                   {"before", NumberOrNull(cell.before)},
                   {"after", NumberOrNull(cell.after)},
                   {"before_found", cell.before_found},
                   {"after_found", cell.after_found}});
  }
  return map;
}

Json ParametersJson(const std::vector<EstimatedParameter>& all) {
  Json parameters = Json::object();
  for (const EstimatedParameter& parameter : all) {
    parameters[parameter.name] = {{"value", NumberOrNull(parameter.value)},
                                  {"lo", NumberOrNull(parameter.low)},
                                  {"hi", NumberOrNull(parameter.high)},
                                  {"unit", parameter.unit},
                                  {"at_bound", parameter.at_bound}};
  }
  return parameters;
}

Json SeenJson(const Budget& budget) {
  Json out = Json::array();
  for (const SampleFact& fact : budget.seen_in_samples) {
    out.push_back({{"effect", fact.effect},
                   {"value", fact.value},
                   {"experiments", {fact.experiments, budget.experiments}}});
  }
  return out;
}

// Of an item that has several.
Json FormOrNull(const std::string& form) { return form.empty() ? Json() : Json(form); }

Json GivenJson(const std::vector<GivenItem>& given) {
  Json out = Json::array();
  for (const GivenItem& each : given) {
    out.push_back({{"item", each.item},
                   {"form", FormOrNull(each.form)},
                   {"parameters", ParametersJson(each.parameters)}});
  }
  return out;
}

Json NotFoundJson(const std::vector<ItemBound>& bounds) {
  Json out = Json::array();
  for (const ItemBound& bound : bounds) {
    out.push_back({{"item", bound.item},
                   {"form", FormOrNull(bound.form)},
                   {"parameter", bound.name},
                   {"lo", NumberOrNull(bound.low)},
                   {"hi", NumberOrNull(bound.high)},
                   {"unit", bound.unit}});
  }
  return out;
}

Json StatedJson(const StatedLoop& stated) {
  const auto or_null = [](const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
  };
  return {{"model", stated.model},
          {"pressure_response", or_null(stated.pressure_response)},
          {"heat_release_response", or_null(stated.heat_release_response)},
          {"delay_s", stated.delay_s},
          {"pressure_in_heat_release", stated.pressure_in_heat_release},
          {"not_stated", stated.not_stated}};
}

Json BudgetJson(const Budget& budget) {
  Json entries = Json::array();
  for (const BudgetEntry& entry : budget.entries) {
    entries.push_back({{"item", entry.item},
                       {"form", FormOrNull(entry.form)},
                       {"gap_before", NumberOrNull(entry.gap_before)},
                       {"gap_after", NumberOrNull(entry.gap_after)},
                       {"lost_without",
                        {{"nats", NumberOrNull(entry.lost_nats)},
                         {"gap", NumberOrNull(entry.lost_gap)},
                         {"halves", entry.lost_on_halves},
                         {"experiments_better", {entry.experiments_better, budget.experiments}}}},
                       {"class", entry.equals},
                       {"parameters", ParametersJson(entry.parameters)}});
  }
  return entries;
}

Json CandidateJson(const Candidate& candidate) {
  return {{"effect", candidate.effect},
          {"gap_after", NumberOrNull(candidate.gap_after)},
          {"shrinkage", NumberOrNull(candidate.shrinkage)},
          {"shrinkage_interval",
           {NumberOrNull(candidate.shrinkage_low), NumberOrNull(candidate.shrinkage_high)}},
          {"p_value", NumberOrNull(candidate.p_value)},
          {"log_likelihood_gain", NumberOrNull(candidate.gain)},
          {"parameters", ParametersJson(candidate.parameters)}};
}

}  // namespace

std::string_view VerdictKindName(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::kNone:
      return "none";
    case VerdictKind::kEffect:
      return "effect";
    case VerdictKind::kUnknown:
      break;
  }
  return "unknown";
}

Json DiagnosisJson(const Diagnosis& diagnosis) {
  Json bootstrap = nullptr;
  if (!diagnosis.bootstrap_gains.empty()) {
    bootstrap = {{"replicates", diagnosis.bootstrap_gains.size()},
                 {"largest_gains", diagnosis.bootstrap_gains}};
  }
  Json candidates = Json::array();
  for (const Candidate& candidate : diagnosis.candidates) {
    candidates.push_back(CandidateJson(candidate));
  }
  Json base_parameters = Json::object();
  for (const MovedParameter& parameter : diagnosis.base_parameters) {
    base_parameters[parameter.name] = {{"without", NumberOrNull(parameter.without)},
                                       {"with", NumberOrNull(parameter.with)}};
  }
  Json json = {
      {"schema", "howl.diagnosis/1"},
      {"verdict", VerdictJson(diagnosis)},
      {"where", WhereJson(diagnosis.where)},
      {"gap",
       {{"before", NumberOrNull(diagnosis.gap_before)},
        {"after", NumberOrNull(diagnosis.gap_after)},
        {"floor", NumberOrNull(diagnosis.gap_floor)},
        {"shrinkage_by_no_meaning", NumberOrNull(diagnosis.placebo_shrinkage)},
        {"held_out", true}}},
      {"map", MapJson(diagnosis)},
      {"candidates", candidates},
      {"base",
       {{"modes", diagnosis.model.modes},
        {"second_mode_gain", NumberOrNull(diagnosis.second_mode_gain)},
        {"harmonic_ratio", diagnosis.model.harmonic_ratio},
        {"tau_scope", diagnosis.model.own_delays ? "experiment" : "shared"},
        {"own_delays_gain", NumberOrNull(diagnosis.own_delays_gain)},
        {"tau_scatter", diagnosis.delay_scatter}}},
      {"base_parameters", base_parameters},
      {"free_slack",
       {{"acoustic_cut",
         {{"before", diagnosis.slack_acoustic_before}, {"after", diagnosis.slack_acoustic_after}}},
        {"flame_cut",
         {{"before", diagnosis.slack_flame_before}, {"after", diagnosis.slack_flame_after}}}}},
      {"bootstrap", bootstrap},
      {"advice", diagnosis.advice}};
  if (diagnosis.budget) {
    const Budget& budget = *diagnosis.budget;
    json["gap"]["without_given"] =
        budget.gap_without_given ? NumberOrNull(*budget.gap_without_given) : Json(nullptr);
    json["budget"] = BudgetJson(budget);
    json["seen_in_samples"] = SeenJson(budget);
    json["given"] = GivenJson(budget.given);
    json["not_found"] = NotFoundJson(budget.not_found);
    json["stated"] = StatedJson(budget.stated);
    json["left"] = {{"gap", NumberOrNull(budget.gap_left)},
                    {"floor", NumberOrNull(budget.floor)},
                    {"where", WhereJson(budget.left)},
                    {"octaves", OctavesJson(budget.left_by_octave)},
                    {"model_error",
                     {{"p_from_q", NumberOrNull(budget.acoustic_error)},
                      {"q_from_p", NumberOrNull(budget.flame_error)}}}};
  }
  return json;
}

namespace {

Json LagJson(const LagInterval& lag) {
  return lag.any ? Json{lag.low_deg, lag.high_deg} : Json(nullptr);
}

}  // namespace

Json TableDiagnosisJson(const TableDiagnosis& table) {
  Json json = DiagnosisJson(table.diagnosis);
  json["gap"]["held_out"] = false;
  json.erase("free_slack");
  json.erase("base");
  Json experiments = Json::object();
  for (const TableExperiment& e : table.experiments) {
    experiments[e.name] = {{"lag_deg", LagJson(e.lag)},
                           {"tau_s_without_lag", e.tau_s},
                           {"tau_s", table.lag.any ? Json{e.tau_low_s, e.tau_high_s} : Json()}};
  }
  json["table"] = {{"lag_deg", LagJson(table.lag)},
                   {"at_hz", table.mean_frequency_hz},
                   {"cutoff_min_hz", NumberOrNull(table.cutoff_min_hz)},
                   {"experiments", experiments}};
  return json;
}

}  // namespace howl
