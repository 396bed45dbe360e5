#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "app/check/check_run.h"
#include "app/command_line/command.h"
#include "app/text/text_table.h"
#include "io/json_text.h"
#include "io/results/health_json.h"
#include "io/results/solution_json.h"
#include "io/whole_file.h"

namespace howl {
namespace {

std::string Count(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

nlohmann::ordered_json CheckJson(const CheckReport& report) {
  using Json = nlohmann::ordered_json;
  Json json = {{"schema", "howl.check/1"}, {"config", report.config}};
  json["errors"] = Json::array();
  for (const UserError& error : report.errors) {
    json["errors"].push_back({{"file", error.file()},
                              {"line", error.line() > 0 ? Json(error.line()) : Json(nullptr)},
                              {"key", error.key()},
                              {"text", error.mistake()}});
  }
  json["warnings"] = HealthJson(report.warnings);
  json["experiments"] = Json::array();
  for (const CheckedExperiment& row : report.rows) {
    Json one = {{"name", row.name}, {"phi", NumberOrNull(row.phi)}};
    one["frequency_hz"] = NumberOrNull(row.frequency_hz);
    if (row.has_record) {
      one["record"] = {{"samples", row.samples},
                       {"sampling_hz", row.sampling_hz},
                       {"duration_s", row.duration_s},
                       {"heat_release", row.has_heat_release},
                       {"state", row.state}};
    }
    json["experiments"].push_back(std::move(one));
  }
  json["commands"] = Json::object();
  for (const Ability& ability : report.abilities) {
    Json one = {{"possible", ability.possible}, {"text", ability.text}};
    one.update(ability.details);
    json["commands"][ability.command] = std::move(one);
  }
  return json;
}

void PrintExperiments(const CheckReport& report) {
  if (report.rows.empty()) return;
  TextTable table(
      {"experiment", report.operating_parameter, "samples", "Hz", "s", "p, q", "state", "f Hz"});
  for (const CheckedExperiment& row : report.rows) {
    const auto of_record = [&](const std::string& text) { return row.has_record ? text : "-"; };
    table.AddRow({row.name, std::isnan(row.phi) ? "FILL_IN" : Significant(row.phi, 4),
                  of_record(std::to_string(row.samples)), of_record(Significant(row.sampling_hz)),
                  of_record(Significant(row.duration_s, 4)),
                  of_record(row.has_heat_release ? "p, q" : "p"), of_record(row.state),
                  Significant(row.frequency_hz, 4)});
  }
  std::printf("%s", table.Text().c_str());
}

// Each part of the text on a line of its own.
void PrintAbility(const Ability& ability) {
  std::string line = "  " + ability.command + ": " + (ability.possible ? "" : "cannot: ");
  constexpr std::string_view kBetween = "; ";
  for (std::size_t begin = 0; begin != std::string::npos;) {
    const std::size_t end =
        ability.possible ? ability.text.find(kBetween, begin) : std::string::npos;
    line += ability.text.substr(begin, end == std::string::npos ? end : end - begin);
    std::printf("%s\n", Wrapped(line, 6).c_str());
    line = "    ";
    begin = end == std::string::npos ? end : end + kBetween.size();
  }
}

void PrintFindings(const CheckReport& report) {
  PrintExperiments(report);
  if (!report.errors.empty()) std::printf("%s\n", Bold("errors:").c_str());
  for (const UserError& error : report.errors) {
    std::printf("%s\n", Wrapped(std::string("  ") + error.what(), 4).c_str());
  }
  if (!report.warnings.empty()) std::printf("%s\n", Bold("warnings:").c_str());
  for (const Finding& finding : report.warnings) {
    std::printf("%s\n", Wrapped("  " + finding.text, 4).c_str());
  }
  if (!report.abilities.empty()) std::printf("%s\n", Bold("what the commands can do:").c_str());
  for (const Ability& ability : report.abilities) {
    PrintAbility(ability);
  }
  std::printf("%s, %s\n", Count(report.errors.size(), "error").c_str(),
              Count(report.warnings.size(), "warning").c_str());
}

int RunCheckCommand(const Options& options) {
  const CheckReport report = RunCheck(options);
  if (options.out_is_given) {
    WriteWholeFile(options.out / "check.json", JsonText(CheckJson(report), 2) + "\n");
  }
  if (options.quiet) {
    for (const UserError& error : report.errors) std::fprintf(stderr, "%s\n", error.what());
  } else {
    PrintFindings(report);
  }
  return report.errors.empty() ? kDone : kBadInput;
}

}  // namespace

Command CheckCommand() {
  return {
      "check",
      "say all that is wrong with a config and its records, and what they allow",
      "Reads the config and every record on behind the first mistake, and lists all of them:\n"
      "keys and values, missing files and columns, samples that are no numbers, times that do\n"
      "not fit the sampling rate. Warns of clipped, stuck and coarse signals, records without\n"
      "a steady cycle, equal operating points. Then says what fit, family, predict and\n"
      "diagnose can do with it: residuals, free parameters, whether tau is shared. Runs no fit\n"
      "and no search. With --out DIR also writes DIR/check.json. Exit status 2 for an error;\n"
      "warnings alone: 0.",
      {},
      RunCheckCommand,
      false};
}

}  // namespace howl
