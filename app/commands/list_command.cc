#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "app/command_line/command.h"
#include "app/text/text_table.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/result_files.h"
#include "io/results/family/family_csv.h"

namespace howl {
namespace {

constexpr int kDefaultRows = 20;

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

std::size_t FindColumn(const FamilyTable& table, const std::string& option,
                       const std::string& name) {
  try {
    return table.Column(name);
  } catch (const std::out_of_range&) {
    throw UsageError(option + ": no column " + name +
                     ", expected member, omega_spread, xi_max or EXPERIMENT.PARAMETER such as " +
                     table.experiments.front() + ".xi");
  }
}

using Test = std::function<bool(const std::vector<double>&)>;

// "exp1.xi<0.2"
Test ParseCondition(const FamilyTable& table, const std::string& text) {
  static const std::regex form(R"(^\s*([^\s<>=]+)\s*(<=|>=|<|>)\s*([-+0-9.eE]+)\s*$)");
  std::smatch match;
  if (!std::regex_match(text, match, form)) {
    throw UsageError("--filter: " + text + ", expected COLUMN<NUMBER, <=, > or >=");
  }
  const std::size_t column = FindColumn(table, "--filter", match[1]);
  double bound = 0.0;
  try {
    std::size_t used = 0;
    bound = std::stod(match[3], &used);
    if (used != match[3].str().size()) throw std::invalid_argument("");
  } catch (const std::exception&) {
    throw UsageError("--filter: " + match[3].str() + ", expected a number");
  }
  const std::string relation = match[2];
  return [column, bound, relation](const std::vector<double>& row) {
    const double value = row[column];
    if (relation == "<") return value < bound;
    if (relation == "<=") return value <= bound;
    if (relation == ">") return value > bound;
    return value >= bound;
  };
}

std::vector<std::string> ShownColumns(const FamilyTable& table, const Options& options) {
  if (const auto chosen = options.Text("--columns")) return SplitAtCommas(*chosen);
  std::vector<std::string> columns = {"member", "omega_spread", "xi_max"};
  if (const auto experiment = options.Text("--experiment")) {
    for (const char* name : {"omega_hz", "xi", "N", "M", "tau_s", "loop_gain", "gain_error",
                             "phase_error_deg", "loop_phase_error_deg"}) {
      columns.push_back(*experiment + "." + name);
    }
    return columns;
  }
  for (const std::string& experiment : table.experiments) columns.push_back(experiment + ".xi");
  return columns;
}

int RunListCommand(const Options& options) {
  const Config config = LoadConfig(options.config, LoopsTaken::kAny);
  FamilyTable table = ReadFamilyCsv(options.out / kFamilyCsv);
  const std::size_t all = table.rows.size();
  if (all == 0) {
    if (!options.quiet) std::printf("the family has no members\n");
    return kNegativeAnswer;
  }
  if (const auto filter = options.Text("--filter")) {
    for (const std::string& text : SplitAtCommas(*filter)) {
      const Test passes = ParseCondition(table, text);
      std::erase_if(table.rows, [&](const auto& row) { return !passes(row); });
    }
  }
  const std::size_t passed = table.rows.size();
  if (const auto sort = options.Text("--sort")) {
    const bool descending = sort->starts_with('-');
    const std::size_t column = FindColumn(table, "--sort", descending ? sort->substr(1) : *sort);
    std::ranges::stable_sort(table.rows, [&](const auto& a, const auto& b) {
      return descending ? a[column] > b[column] : a[column] < b[column];
    });
  }
  const int limit = options.Count("--rows", 0, 100000000).value_or(kDefaultRows);
  if (limit > 0 && table.rows.size() > static_cast<std::size_t>(limit)) {
    table.rows.resize(static_cast<std::size_t>(limit));
  }

  const std::vector<std::string> shown = ShownColumns(table, options);
  std::vector<std::size_t> indices;
  for (const std::string& name : shown) {
    indices.push_back(
        FindColumn(table, options.Has("--columns") ? "--columns" : "--experiment", name));
  }
  TextTable text(shown);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells = {};
    for (const std::size_t index : indices) {
      cells.push_back(index == 0 ? Fixed(row[0], 0) : Significant(row[index], 4));
    }
    text.AddRow(std::move(cells));
  }
  std::printf("%s", text.Text().c_str());
  if (!options.quiet) {
    std::printf("%zu of %zu members shown, %zu pass the filter\n", table.rows.size(), all, passed);
  }
  return kDone;
}

}  // namespace

Command ListCommand() {
  return {"list",
          "print the members of a family as a table",
          "Reads family.csv, which howl family wrote, and prints one row a member.\n"
          "Columns: member, omega_spread, xi_max, and EXPERIMENT.PARAMETER such as exp1.xi.",
          {{"--filter", "CONDITIONS", "such as \"xi_max<0.2,exp1.omega_hz>=215\"; all must hold"},
           {"--sort", "COLUMN", "ascending; -COLUMN: descending"},
           {"--columns", "NAMES", "columns to show, joined by commas"},
           {"--experiment", "NAME", "show all parameters of one experiment"},
           {"--rows", "N", "rows to show (default: 20; 0: all)"}},
          RunListCommand,
          false};
}

}  // namespace howl
