#include "io/report/page/page_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "io/json_fields.h"
#include "io/report/figures/curves.h"
#include "io/report/html_table.h"
#include "io/report/html_text.h"
#include "io/report/script.h"
#include "io/results/verdict_remarks.h"
#include "trial/power.h"

namespace howl {
namespace {

constexpr int kOperatingDigits = 6;  // as it was set on the rig

std::string Text(double value, int digits = 3) { return Spelled(value, digits); }

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f", 100.0 * share);
  return text;
}

std::string Joined(const nlohmann::json& names) {
  std::string out;
  for (const auto& name : names) {
    out += out.empty() ? "" : ", ";
    out +=
        "<code>" + EscapeHtml(name.is_string() ? name.get<std::string>() : name.dump()) + "</code>";
  }
  return out;
}

// Each set of conditions that exclude each other, and the value that each condition alone would
// need.
std::string ConflictHtml(const nlohmann::json& family) {
  if (!family.contains("conflict") || !family["conflict"].is_object()) return {};
  const nlohmann::json& conflict = family["conflict"];
  std::string out;
  for (const auto& set : ListAt(conflict, "minimal_sets")) {
    out += "<li>exclude each other: " +
           (set.empty() ? "the bounds of the parameters themselves" : Joined(set)) + "</li>";
  }
  for (const auto& each : ListAt(conflict, "relaxations")) {
    if (!each.value("suffices", false)) continue;
    const double needed = NumberAt(each, "needed");
    out += "<li><code>" + EscapeHtml(each.value("condition", "")) + "</code> is " +
           Text(NumberAt(each, "value")) + "; " +
           (std::isfinite(needed) ? "with " + Text(needed) : std::string("without it")) +
           " there is a member</li>";
  }
  const bool proved = conflict.value("proved", false);
  return (proved ? std::string() : "<p>As far as the search went: this is not a proof.</p>\n") +
         (out.empty() ? out : "<ul>" + out + "</ul>\n");
}

std::string TriedSize(const nlohmann::json& severity, const nlohmann::json& size) {
  if (!severity.is_number() || !size.is_number()) return "?";
  const std::string_view beyond = BeyondTried(severity.get<double>());
  return beyond.empty() ? Text(size.get<double>(), 3) : std::string(beyond);
}

// Of a loop that was fitted to records: a row for each mode of each experiment.
std::string RecordLoopTable(const ReportInput& input) {
  std::vector<TableRow> rows;
  for (const auto& experiment : ListAt(input.solution, "experiments")) {
    const Estimate tau_s = {NumberAt(experiment, "tau_s"), NumberAt(experiment, "tau_std_s")};
    const auto small = experiment.value("small_signal", nlohmann::json::object());
    for (const auto& mode : ListAt(experiment, "modes")) {
      rows.push_back({experiment.value("name", ""), TableCell(EstimateAt(mode, "omega_hz")),
                      TableCell(EstimateAt(mode, "xi")), TableCell(EstimateAt(mode, "N")),
                      TableCell(EstimateAt(mode, "B")), TableCell(tau_s, 1e3),
                      TableCell(EstimateAt(small, "growth_rate_1_s"))});
    }
  }
  if (rows.empty()) return {};
  return HtmlTable(
      "Loop fitted to the records; ± is half of a 95 % interval. N and B in (units of "
      "p per unit of q) rad/s; growth: of small signals about rest",
      {"experiment", "ω (Hz)", "ξ", "N", "B", "τ (ms)", "growth (1/s)"}, rows);
}

}  // namespace

std::string MeasuredTable(const ReportInput& input) {
  if (input.measured.empty()) return {};
  std::vector<TableRow> rows;
  for (const MeasuredPoint& point : input.measured) {
    rows.push_back({point.name + (point.reliable ? "" : " *"),
                    TableCell(point.phi, kOperatingDigits), TableCell(point.frequency_hz),
                    TableCell(point.phase_deg), TableCell(point.gain), TableCell(point.tau_s, 1e3),
                    TableCell(point.flame_slope), TableCell(point.loop_gain)});
  }
  return HtmlTable(
      "Characteristics of the limit cycle; ± is half of a 95 % interval where one is "
      "known; * not stationary, or no limit cycle",
      {"experiment", input.OperatingLabel(), "f (Hz)", "phase q to p (°)", "gain (p/q)", "τ (ms)",
       "Φ′(0)", "loop gain"},
      rows);
}

std::string FitTable(const ReportInput& input) {
  if (input.fitted.empty()) return RecordLoopTable(input);
  const bool two_modes =
      std::ranges::any_of(input.fitted, [](const auto& fit) { return fit.model.M > 0.0; });
  std::vector<std::string> head = {"experiment", input.OperatingLabel(), "ω (Hz)", "ξ", "N"};
  if (two_modes) head.emplace_back("M");
  head.emplace_back("τ (ms)");
  std::vector<TableRow> rows;
  for (const ExperimentModel& fit : input.fitted) {
    TableRow& row = rows.emplace_back();
    row = {fit.name, TableCell(fit.phi, kOperatingDigits), TableCell(fit.model.omega_hz),
           TableCell(fit.model.xi), TableCell(fit.model.N)};
    if (two_modes) row.push_back(TableCell(fit.model.M));
    row.push_back(TableCell(1e3 * fit.model.tau_s));
  }
  const bool converged = input.solution.value("converged", false);
  return HtmlTable("Joint fit: one choice among those that the data leave" +
                       std::string(converged ? "" : "; no start converged") + ". N" +
                       (two_modes ? " and M" : "") + " in (units of p per unit of q) rad/s",
                   head, rows);
}

std::string FamilySummary(const ReportInput& input) {
  if (input.family.is_null()) return {};
  std::string out = "<p>";
  if (input.members) {
    out += std::to_string(input.members->models.size()) +
           " models are listed that the data cannot reject.";
  } else if (input.FamilyIsEmpty()) {
    out += "No model passes the test.";
  } else {
    out += "Bounds of the models that the data cannot reject.";
  }
  return out + "</p>\n" + ConflictHtml(input.family);
}

std::string DiagnosisSummary(const ReportInput& input) {
  if (!input.diagnosis.contains("verdict")) return {};
  const auto& verdict = input.diagnosis["verdict"];
  const std::string kind = verdict.value("kind", "");
  std::string out = "<p>Verdict: <strong>";
  if (kind == "effect" && verdict["effect"].is_string()) {
    out += EscapeHtml(verdict["effect"].get<std::string>());
  } else {
    out += kind == "none" ? "none: the model explains the records" : "unknown";
  }
  out += "</strong>";
  if (verdict.contains("probability") && verdict["probability"].is_object()) {
    const std::string key = kind == "effect" && verdict["effect"].is_string()
                                ? verdict["effect"].get<std::string>()
                                : kind;
    const double probability = NumberAt(verdict["probability"], key.c_str());
    if (std::isfinite(probability)) out += " (probability " + Text(probability, 2) + ")";
  }
  if (verdict.contains("indistinguishable") && !verdict["indistinguishable"].empty()) {
    out += "; the data cannot tell it from ";
    bool first = true;
    for (const auto& id : verdict["indistinguishable"]) {
      out += (first ? "" : ", ") + EscapeHtml(id.get<std::string>());
      first = false;
    }
  }
  out += ".";
  if (kind == "unknown" && verdict.contains("together") && verdict["together"].is_string()) {
    out += " " + EscapeHtml(RemarkOnTogether(verdict["together"].get<std::string>())) + ".";
  }
  out += "</p>\n";
  std::vector<TableRow> rows;
  for (const auto& place : input.diagnosis.value("where", nlohmann::json::array())) {
    std::string names;
    for (const auto& name : place["experiments"]) {
      names += (names.empty() ? "" : ", ") + name.get<std::string>();
    }
    rows.push_back(
        {place.value("block", ""),
         Text(place["band_hz"][0].get<double>()) + " to " + Text(place["band_hz"][1].get<double>()),
         names, TableCell(NumberAt(place, "share"))});
  }
  if (!rows.empty()) {
    out += HtmlTable("Where", {"block", "band (Hz)", "experiments", "share of the gap"}, rows);
  }
  rows.clear();
  for (const auto& candidate : input.diagnosis.value("candidates", nlohmann::json::array())) {
    if (rows.size() == 5) break;
    // Of a budget only what is named was fitted to all points.
    if (!std::isfinite(NumberAt(candidate, "shrinkage"))) continue;
    std::string parameters;
    const nlohmann::json estimates = candidate.value("parameters", nlohmann::json::object());
    for (const auto& [name, value] : estimates.items()) {
      parameters += (parameters.empty() ? "" : "; ") + name + " " + Text(NumberAt(value, "value"));
      if (std::isfinite(NumberAt(value, "lo"))) {
        parameters +=
            " (" + Text(NumberAt(value, "lo")) + " to " + Text(NumberAt(value, "hi")) + ")";
      }
      const std::string unit = value.value("unit", "");
      if (!unit.empty()) parameters += " " + unit;
      if (value.value("at_bound", false)) parameters += " at a bound of the search";
    }
    rows.push_back({candidate.value("effect", ""),
                    TableCell(100.0 * NumberAt(candidate, "shrinkage")),
                    TableCell(NumberAt(candidate, "gap_after")), parameters});
  }
  if (!rows.empty()) {
    // Values that all operating points share have an interval, others a range over the points.
    out += HtmlTable(input.diagnosis.contains("budget")
                         ? "What is named, with 95 % intervals, or from the least to the largest "
                           "of the operating points"
                         : "The most probable candidates, with 95 % intervals",
                     {"effect", "gap removed (%)", "gap left", "estimate"}, rows);
  }
  rows.clear();
  for (const auto& bound : input.diagnosis.value("not_found", nlohmann::json::array())) {
    const std::string form = TextAt(bound, "form");
    rows.push_back({bound.value("item", "") + (form.empty() ? "" : " (" + form + ")"),
                    bound.value("parameter", ""), TableCell(NumberAt(bound, "lo")),
                    TableCell(NumberAt(bound, "hi")), bound.value("unit", "")});
  }
  if (!rows.empty()) {
    out += HtmlTable("What was not found, and how large it may still be, at 95 %",
                     {"effect", "parameter", "at least", "at most", "unit"}, rows);
  }
  if (input.diagnosis.contains("advice") && input.diagnosis["advice"].is_string()) {
    out += "<p>Next: " + EscapeHtml(input.diagnosis["advice"].get<std::string>()) + ".</p>\n";
  }
  return out;
}

std::string TrialSummary(const ReportInput& input) {
  if (!input.trial.contains("diagnose")) return {};
  const auto tally = [](const nlohmann::json& json) -> std::string {
    if (!json.is_object() || !(NumberAt(json, "total") > 0.0)) return "–";
    std::string text = Percent(NumberAt(json, "share")) + " %";
    const nlohmann::json& interval = ListAt(json, "interval");
    if (interval.size() == 2 && interval[0].is_number() && interval[1].is_number()) {
      text += " (" + Percent(interval[0].get<double>()) + " to " +
              Percent(interval[1].get<double>()) + ")";
    }
    return text;
  };
  const auto part = [](const nlohmann::json& json, const char* key) {
    return json.is_object() && json.contains(key) ? json[key] : nlohmann::json();
  };
  std::vector<nlohmann::json> methods = {input.trial["diagnose"]};
  for (const auto& rival : ListAt(input.trial, "rivals")) methods.push_back(rival);
  std::vector<TableRow> rows;
  for (const nlohmann::json& method : methods) {
    const nlohmann::json all = part(method, "all_severities");
    rows.push_back({method.value("method", ""), tally(part(all, "effect")),
                    tally(part(all, "class_of_at_most_three")), tally(part(all, "block")),
                    tally(part(method, "false_alarms")), tally(part(method, "unknown_recall")),
                    TableCell(NumberAt(method, "log_score")),
                    TableCell(NumberAt(method, "brier"))});
  }
  std::string out = "<p>" + Text(NumberAt(input.trial, "cases"), 6) +
                    " sealed cases from another simulator, diagnosed blind.";
  if (input.trial.contains("about") && input.trial["about"].is_object()) {
    const std::string seal = input.trial["about"].value("seal_sha256", "");
    if (!seal.empty()) out += " SHA-256 of the sealed key: <code>" + EscapeHtml(seal) + "</code>.";
  }
  out += "</p>\n";
  out += HtmlTable("Scores with 95 % (Wilson) intervals, and those of trivial rivals",
                   {"method", "effect named", "in a class of three", "block", "false alarms",
                    "unknown recognised", "log score", "Brier score"},
                   rows);
  rows.clear();
  for (const auto& each : ListAt(input.trial, "power")) {
    const nlohmann::json& sizes = ListAt(each, "size_interval");
    const nlohmann::json& severities = ListAt(each, "severity_interval");
    std::string size = each.value("resolved", false)
                           ? Text(NumberAt(each, "size_found_with_90_percent"), 3)
                           : "not resolved";
    if (sizes.size() == 2 && severities.size() == 2 && sizes[0].is_number()) {
      size += " (" + TriedSize(severities[0], sizes[0]) + " to " +
              TriedSize(severities[1], sizes[1]) + ")";
    }
    rows.push_back({each.value("effect", ""), each.value("parameter", ""), size,
                    Text(NumberAt(each, "found"), 5) + " of " + Text(NumberAt(each, "cases"), 5)});
  }
  if (!rows.empty()) {
    out += HtmlTable("Power: the size that is named in 90 % of cases",
                     {"effect", "parameter", "size", "named"}, rows);
  }
  return out;
}

}  // namespace howl
