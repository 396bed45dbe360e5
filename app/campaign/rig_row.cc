#include "app/campaign/rig_row.h"

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Row = nlohmann::ordered_json;

// The value at a path of keys; null where there is none.
nlohmann::json At(const nlohmann::json& json, const std::vector<const char*>& keys) {
  const nlohmann::json* node = &json;
  for (const char* const key : keys) {
    if (!node->is_object() || !node->contains(key)) return nullptr;
    node = &node->at(key);
  }
  return *node;
}

// A quantity of an experiment's; points are found again by their names, so that a fit's value and a
// family's bounds share a row.
Row& Point(Row& row, const nlohmann::json& experiment, const std::string& quantity) {
  const std::string name = TextAt(experiment, "name");
  for (Row& point : row["points"]) {
    if (point["experiment"] == name && point["quantity"] == quantity) return point;
  }
  row["points"].push_back(
      {{"experiment", name}, {"phi", At(experiment, {"phi"})}, {"quantity", quantity}});
  return row["points"].back();
}

void HarvestAnalysis(const nlohmann::json& results, Row& row) {
  std::size_t cycles = 0;
  for (const nlohmann::json& experiment : At(results, {"experiments"})) {
    cycles += At(experiment, {"cycle", "state"}) == "limit_cycle" ? 1 : 0;
    const std::pair<const char*, std::vector<const char*>> quantities[] = {
        {"frequency_hz", {"cycle", "frequency"}},
        {"phase_deg", {"cycle", "phase"}},
        {"gain", {"cycle", "gain"}},
        {"flame_slope", {"flame", "slope"}},
        {"loop_gain_measured", {"loop_gain"}}};
    for (const auto& [quantity, keys] : quantities) {
      const nlohmann::json estimate = At(experiment, keys);
      if (!estimate.is_object() || At(estimate, {"value"}).is_null()) continue;
      Row& point = Point(row, experiment, quantity);
      point["value"] = At(estimate, {"value"});
      point["std"] = At(estimate, {"std"});
    }
  }
  row["values"]["experiments"] = At(results, {"experiments"}).size();
  row["values"]["limit_cycles"] = cycles;
}

void HarvestFit(const nlohmann::json& results, Row& row) {
  row["values"]["fit_converged"] = At(results, {"converged"});
  row["values"]["fit_cost"] = At(results, {"cost"});
  row["values"]["fit_health_findings"] = At(results, {"health"}).size();
  for (const nlohmann::json& experiment : At(results, {"experiments"})) {
    for (const char* const quantity : {"omega_hz", "xi", "N", "M", "tau_s", "loop_gain"}) {
      Point(row, experiment, quantity)["value"] = At(experiment, {quantity});
    }
  }
}

void HarvestFamily(const nlohmann::json& results, Row& row) {
  row["values"]["members"] = At(results, {"counts", "members"});
  std::optional<bool> closed;  // an empty family has no bounds
  for (const nlohmann::json& experiment : At(results, {"experiments"})) {
    const std::string name = TextAt(experiment, "name");
    const nlohmann::json bounds = At(results, {"bounds", name.c_str()});
    if (!bounds.is_object()) continue;
    for (const auto& [quantity, bound] : bounds.items()) {
      Row& point = Point(row, experiment, quantity);
      const nlohmann::json outer = At(bound, {"outer"});
      const nlohmann::json inner = At(bound, {"inner"});
      closed = closed.value_or(true) && At(bound, {"closed"}) == true;
      if (outer.is_array() && outer.size() == 2) {
        point["outer_lo"] = outer[0];
        point["outer_hi"] = outer[1];
      }
      if (inner.is_array() && inner.size() == 2) {
        point["inner_lo"] = inner[0];
        point["inner_hi"] = inner[1];
      }
    }
  }
  if (closed) row["values"]["bounds_closed"] = *closed;
}

void HarvestDiagnosis(const nlohmann::json& results, Row& row) {
  const nlohmann::json verdict = At(results, {"verdict"});
  Row& values = row["values"];
  values["verdict"] = At(verdict, {"kind"});
  values["effect"] = At(verdict, {"effect"});
  std::string first;
  double largest = -1.0;
  const nlohmann::json probabilities = At(verdict, {"probability"});
  for (const auto& [answer, probability] : probabilities.items()) {
    if (!probability.is_number() || probability.get<double>() <= largest) continue;
    largest = probability.get<double>();
    first = answer;
  }
  if (largest >= 0.0) {
    values["most_probable"] = first;
    values["probability"] = largest;
  }
  const nlohmann::json where = At(results, {"where"});
  if (where.is_array() && !where.empty()) values["block"] = At(where[0], {"block"});
  values["gap_before"] = At(results, {"gap", "before"});
  values["gap_after"] = At(results, {"gap", "after"});
  values["gap_floor"] = At(results, {"gap", "floor"});
}

void HarvestSimulation(const nlohmann::json&, Row&) {}

struct Harvest {
  std::string file;
  std::vector<std::string> columns;
  void (*read)(const nlohmann::json& results, Row& row);
};

const Harvest& HarvestOf(const std::string& command) {
  static const std::map<std::string, Harvest> harvests = {
      {"simulate", {"simulation.json", {}, HarvestSimulation}},
      {"analyse", {"analysis.json", {"experiments", "limit_cycles"}, HarvestAnalysis}},
      {"fit", {"solution.json", {"fit_converged", "fit_cost", "fit_health_findings"}, HarvestFit}},
      {"family", {"family.json", {"members", "bounds_closed"}, HarvestFamily}},
      {"diagnose",
       {"diagnosis.json",
        {"verdict", "effect", "most_probable", "probability", "block", "gap_before", "gap_after",
         "gap_floor"},
        HarvestDiagnosis}}};
  return harvests.at(command);
}

}  // namespace

const std::vector<std::string>& ResultColumns(const std::string& command) {
  return HarvestOf(command).columns;
}

std::string ResultFile(const std::string& command) { return HarvestOf(command).file; }

void HarvestResults(const std::string& command, const std::filesystem::path& folder, Row& row) {
  const Harvest& harvest = HarvestOf(command);
  const std::filesystem::path path = folder / harvest.file;
  const std::optional<std::string> text = ReadWholeFile(path);
  const nlohmann::json results = ParseJsonOrNone<nlohmann::json>(text.value_or(""));
  if (!results.is_object()) {
    throw UserError(path.string(), 0, "",
                    "is missing or damaged, expected howl " + command + " to have written it");
  }
  harvest.read(results, row);
}

const std::vector<std::string>& PointColumns() {
  static const std::vector<std::string> columns = {"experiment", "phi",      "quantity",
                                                   "value",      "std",      "outer_lo",
                                                   "inner_lo",   "inner_hi", "outer_hi"};
  return columns;
}

}  // namespace howl
