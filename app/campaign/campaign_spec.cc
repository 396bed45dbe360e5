#include "app/campaign/campaign_spec.h"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/config/schema/config_cursor.h"
#include "io/config/schema/schema_check.h"
#include "io/config/yaml/config_text.h"
#include "io/config/yaml/yaml_tree.h"
#include "io/user_error.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr double kMostValues = 1e6;  // of an axis; of all axes, as many combinations
constexpr const char* kManyRigs = "makes more than a million rigs, expected fewer";

// The rules of one key alone; those between keys follow below.
constexpr const char* kSchema = R"({
  "type": "object",
  "additionalProperties": false,
  "properties": {
    "title": {"type": "string", "description": "of the tables"},
    "commands": {"type": "array", "minItems": 1, "description": "for each rig, in this order",
      "items": {"type": "string", "enum": ["simulate", "analyse", "fit", "family", "diagnose"]}},
    "options": {"type": "object", "additionalProperties": false, "description": "by command",
      "properties": {"simulate": {"type": "string"}, "analyse": {"type": "string"},
        "fit": {"type": "string"}, "family": {"type": "string"}, "diagnose": {"type": "string"}}},
    "configs": {"type": "array", "minItems": 1, "items": {"type": "string"},
      "description": "files or patterns"},
    "config": {"type": "string", "description": "the one that is changed for each rig"},
    "fleet": {"type": "string", "description": "a table with a row for each rig"},
    "keep": {"type": "string", "enum": ["folders", "rows"],
      "description": "of each rig, its folder or its row alone"},
    "grid": {"type": "object", "description": "values by key, all combinations"}
  }
})";

// The files of a pattern, in the order of their names.
std::vector<fs::path> Matches(const ConfigCursor& item, const fs::path& folder) {
  const std::string pattern = (folder / item.Node().text).lexically_normal().string();
  glob_t found{};
  std::vector<fs::path> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  globfree(&found);
  if (files.empty()) {
    item.Fail("there is no file \"" + pattern +
              "\", expected configs, relative to the campaign's folder");
  }
  return files;
}

// `most`: that the axes before it leave. A few words state a million values for each axis, so that
// they are counted before they are made.
std::vector<LocatedNode> RangeValues(const ConfigCursor& range, double most) {
  double from = 0.0;
  double to = 0.0;
  double step = 1.0;
  for (const LocatedMember& member : range.Node().members) {
    const bool is_number = member.value.kind == LocatedNode::Kind::kInteger ||
                           member.value.kind == LocatedNode::Kind::kNumber;
    if (!is_number || (member.key != "from" && member.key != "to" && member.key != "step")) {
      range.Fail("\"" + member.key + "\" is no number of from, to or step, expected those three");
    }
  }
  if (!range.Find("from") || !range.Find("to")) range.Fail("expected from and to");
  range.Read("from", from);
  range.Read("to", to);
  range.Read("step", step);
  const double count = std::floor((to - from) / step * (1.0 + 1e-12)) + 1.0;
  if (!(count >= 1.0) || count > kMostValues) {
    range.Fail("has no values, or more than a million, expected from, to and step to agree");
  }
  if (count > most) range.Fail(kManyRigs);
  std::vector<LocatedNode> values;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", from + k * step);
    values.push_back(MakeScalar(text, false, range.Line()));
  }
  return values;
}

GridAxis ReadAxis(const std::string& file, const LocatedMember& member, double most) {
  const ConfigCursor cursor(file, member.value, "grid." + member.key);
  GridAxis axis{member.key, member.key_line, {}};
  switch (member.value.kind) {
    case LocatedNode::Kind::kList:
      axis.values = member.value.items;
      break;
    case LocatedNode::Kind::kMapping:
      axis.values = RangeValues(cursor, most);
      break;
    default:
      break;
  }
  if (axis.values.empty()) cursor.Fail("expected a list of values, or {from, to, step}");
  if (static_cast<double>(axis.values.size()) > most) cursor.Fail(kManyRigs);
  return axis;
}

std::vector<std::string> Words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

void ReadCommands(const ConfigCursor& root, CampaignSpec& spec) {
  spec.commands = {"fit", "family"};
  if (const auto commands = root.Find("commands")) {
    spec.commands.clear();
    for (const ConfigCursor& item : commands->Items()) {
      if (std::ranges::find(spec.commands, item.Node().text) != spec.commands.end()) {
        item.Fail("\"" + item.Node().text + "\" stands twice, expected each command once");
      }
      spec.commands.push_back(item.Node().text);
    }
  }
  if (const auto options = root.Find("options")) {
    for (const LocatedMember& member : options->Node().members) {
      if (std::ranges::find(spec.commands, member.key) == spec.commands.end()) {
        options->FailAt(member.key, "is not among the commands, expected it there too");
      }
      spec.options[member.key] = Words(member.value.text);
    }
  }
}

void ReadRigs(const ConfigCursor& root, const fs::path& folder, CampaignSpec& spec) {
  const auto configs = root.Find("configs");
  const auto config = root.Find("config");
  if (configs.has_value() == config.has_value()) {
    root.FailAt(configs ? "config" : "configs",
                configs ? "stands beside configs, expected one of the two"
                        : "is missing, expected configs, a list of files, or config, one of them");
  }
  if (config) spec.configs = {(folder / config->Node().text).lexically_normal()};
  for (const ConfigCursor& item : configs ? configs->Items() : std::vector<ConfigCursor>()) {
    std::ranges::copy(Matches(item, folder), std::back_inserter(spec.configs));
  }
  if (const auto fleet = root.Find("fleet")) {
    if (configs) fleet->Fail("needs one config, expected config in the place of configs");
    spec.fleet = (folder / fleet->Node().text).lexically_normal();
    spec.fleet_line = fleet->Line();
  }
  if (const auto grid = root.Find("grid")) {
    double rigs = 1.0;
    for (const LocatedMember& member : grid->Node().members) {
      spec.grid.push_back(ReadAxis(root.File(), member, kMostValues / rigs));
      rigs *= static_cast<double>(spec.grid.back().values.size());
    }
  }
}

}  // namespace

const std::vector<std::string>& CampaignCommands() {
  static const std::vector<std::string> commands = {"simulate", "analyse", "fit", "family",
                                                    "diagnose"};
  return commands;
}

CampaignSpec LoadCampaign(const fs::path& path) {
  CampaignSpec spec;
  spec.source = path;
  spec.text = ReadConfigText(path);
  const std::string file = path.string();
  const LocatedNode tree = ParseYaml(file, spec.text);
  if (tree.kind != LocatedNode::Kind::kMapping) {
    throw UserError(file, tree.line, "", "is no campaign, expected commands and configs");
  }
  CheckSchema(file, tree, nlohmann::json::parse(kSchema));
  const ConfigCursor root(file, tree);
  root.Read("title", spec.title);
  std::string keep = "folders";
  root.Read("keep", keep);
  spec.keeps_folders = keep == "folders";
  ReadCommands(root, spec);
  ReadRigs(root, path.parent_path(), spec);
  return spec;
}

}  // namespace howl
