#include "app/diagnose/next_config.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "app/input/derived_config.h"
#include "diagnosis/loop_budget/account/stated_loop.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "io/config/reading/config_reading.h"
#include "io/config/schema/config_cursor.h"
#include "io/config/sections/config_sections.h"
#include "io/config/yaml/yaml_text.h"
#include "io/config/yaml/yaml_tree.h"
#include "io/inspect/yaml_text.h"

namespace howl {
namespace {

// The config has been read: whatever the key stands in is there, or can be made.
void SetKey(const std::string& key, const LocatedNode& value, LocatedNode* config) {
  const auto fault = SetValue(*config, key, value);
  CHECK(!fault) << key << " " << *fault;
}

LocatedNode Text(const std::string& text) { return MakeScalar(text, true, 1); }
LocatedNode Number(double value) { return MakeScalar(ShortNumber(value), false, 1); }

// `key` of a record with what was found behind what is known already. False where that is a table,
// which no formula can be multiplied with.
bool SetResponse(const std::string& record, const char* key,
                 const std::optional<ResponseSpec>& known, const LocatedNode& stated,
                 const std::string& found, LocatedNode* tree) {
  if (found.empty()) return true;
  if (known && !known->formula) return false;
  const std::string formula =
      known ? "(" + stated.Find(key)->value.text + ") * (" + found + ")" : found;
  SetKey(record + key, Text(formula), tree);
  return true;
}

// False where an instrument cannot be stated.
bool SetRecords(const Config& config, const std::vector<std::string>& names,
                const StatedLoop& found, LocatedNode* tree) {
  bool all = true;
  for (std::size_t i = 0; i < config.experiments.size(); ++i) {
    const ExperimentConfig& each = config.experiments[i];
    if (!each.record) continue;
    const std::string at = "experiments[" + std::to_string(i) + "].record.";
    const LocatedNode& stated =
        config.tree.Find("experiments")->value.items[i].Find("record")->value;
    all &= SetResponse(at, "pressure_response", each.record->pressure_response, stated,
                       found.pressure_response, tree);
    all &= SetResponse(at, "heat_release_response", each.record->heat_release_response, stated,
                       found.heat_release_response, tree);
    if (found.delay_s != 0.0) {
      SetKey(at + "delay_s", Number(each.record->delay_s + found.delay_s), tree);
    }
    const auto name = std::ranges::find(names, each.experiment.name);
    if (found.pressure_in_heat_release.empty() || name == names.end()) continue;
    all &= !each.record->pressure_response && !each.record->heat_release_response &&
           each.record->delay_s == 0.0;
    const auto e = static_cast<std::size_t>(name - names.begin());
    const double leak = each.record->pressure_in_heat_release + found.pressure_in_heat_release[e];
    SetKey(at + "pressure_in_heat_release", Number(leak), tree);
  }
  return all;
}

// A loop that is fitted to whole records takes no parameters and no residuals.
void SetModel(const std::string& model_line, LocatedNode* tree) {
  const std::string file;  // the line is right
  const LocatedNode stated = ParseYaml(file, model_line);
  const LocatedNode& model = stated.Find("model")->value;
  SetKey("model", model, tree);
  Config probe;
  ReadRecordLoop(ConfigCursor(file, model), probe);
  if (!probe.record_loop) return;
  std::erase_if(tree->members, [](const LocatedMember& member) {
    return member.key == "parameters" || member.key == "residuals";
  });
}

std::string Joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

std::string Head(const LoopDiagnosis& found) {
  const StatedLoop& stated = found.diagnosis.budget->stated;
  std::string out = "What howl diagnose found in these records (" + Joined(found.items) +
                    "), as far as a config can state it. The values count as known here; their "
                    "intervals stand in diagnosis.json.";
  if (found.diagnosis.kind == VerdictKind::kUnknown) {
    out += " The verdict is unknown: this loop need not be the rig's.";
  }
  if (!stated.not_stated.empty()) {
    out += " Not stated, for no config can: " + Joined(stated.not_stated) + ".";
  }
  return out;
}

}  // namespace

std::filesystem::path NextConfigPath(const Config& config, const std::filesystem::path& out) {
  std::filesystem::path name = config.source.stem();
  return out / (name += "_next.yaml");
}

std::optional<std::string> NextConfig(const Config& config, const std::vector<std::string>& names,
                                      const LoopDiagnosis& found) {
  const Budget& budget = *found.diagnosis.budget;
  if (!budget.stated.SaysMore() || !RestCanBeFound(budget.seen_in_samples)) return std::nullopt;
  LocatedNode tree = config.tree;
  MakePathsAbsolute(tree, config.source.parent_path());
  if (budget.stated.is_another_model) SetModel(budget.stated.model, &tree);
  const bool papers = !budget.stated.is_another_model && !config.record_loop;
  if (budget.stated.own_delays && papers) {
    SetKey("parameters.tau_s.scope", Text("experiment"), &tree);
  }
  if (!SetRecords(config, names, budget.stated, &tree)) return std::nullopt;
  return YamlComment(Head(found)) + "\n" + YamlText(tree);
}

}  // namespace howl
