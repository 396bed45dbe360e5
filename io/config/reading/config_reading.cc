#include "io/config/reading/config_reading.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/config/schema/config_schema.h"
#include "io/config/schema/config_tree.h"
#include "io/config/schema/scalar_check.h"
#include "io/config/schema/schema_check.h"
#include "io/config/sections/config_sections.h"
#include "io/config/yaml/config_text.h"
#include "io/config/yaml/placeholder.h"
#include "io/config/yaml/yaml_tree.h"

namespace howl {
namespace {

constexpr std::string_view kExperiments = "experiments[";

// Of "experiments[3].gain": 3. A user's own key may begin like one: "experiments[x]".
std::optional<std::size_t> ExperimentOf(const std::string& key) {
  if (!key.starts_with(kExperiments)) return std::nullopt;
  std::size_t index = 0;
  const char* const last = key.data() + key.size();
  const auto [end, error] = std::from_chars(key.data() + kExperiments.size(), last, index);
  if (error != std::errc() || end == last || *end != ']') return std::nullopt;
  return index;
}

std::string SectionOf(const std::string& key) { return key.substr(0, key.find_first_of(".[")); }

class Reading {
 public:
  explicit Reading(const std::filesystem::path& path) : file_(path.string()) {
    config_.source = path;
  }

  ConfigReading Read() {
    try {
      tree_ = ParseYaml(file_, ReadConfigText(config_.source));
      CheckIsMapping(file_, tree_);
      config_.operating_parameter = ReadOperatingParameter(ConfigCursor(file_, tree_));
    } catch (const UserError& error) {
      reading_.mistakes.push_back(error);
      return std::move(reading_);
    }
    config_.tree = tree_;
    TakePlaceholders();
    CheckTree();
    if (const LocatedMember* experiments = tree_.Find("experiments")) {
      reading_.experiments = experiments->value.items.size();
      ReadSections();
    }
    std::ranges::stable_sort(reading_.mistakes, {},
                             [&](const UserError& error) { return error.line(); });
    return std::move(reading_);
  }

 private:
  // All of them are one mistake, and are then read as numbers, so that other mistakes show as well.
  void TakePlaceholders() {
    const std::vector<Placeholder> all = FindPlaceholders(tree_);
    if (all.empty()) return;
    reading_.mistakes.emplace_back(file_, all.front().line, all.front().key, PlaceholderText(all));
    double next = 1.0;
    ReplacePlaceholders(tree_, next);
    for (const Placeholder& each : all) {
      if (each.key.ends_with("." + config_.operating_parameter)) reading_.points_are_known = false;
      // Without its rate a record cannot be judged.
      if (!each.key.ends_with("sampling_hz")) continue;
      if (const auto index = ExperimentOf(each.key)) experiments_.told.insert(*index);
    }
  }

  static void ReplacePlaceholders(LocatedNode& node, double& next) {
    if (node.kind == LocatedNode::Kind::kText && node.text == kFillIn) {
      node.kind = LocatedNode::Kind::kNumber;
      node.number = next++;
    }
    for (LocatedNode& item : node.items) ReplacePlaceholders(item, next);
    for (LocatedMember& member : node.members) ReplacePlaceholders(member.value, next);
  }

  void CheckTree() {
    const nlohmann::json schema =
        ConfigSchemaFor(config_.operating_parameter, ReadExperimentNames(tree_));
    std::vector<UserError> mistakes = FindScalarMistakes(file_, tree_);
    for (const SchemaMistake& mistake : FindSchemaMistakes(tree_, schema)) {
      mistakes.emplace_back(file_, mistake.line, mistake.key, mistake.what);
    }
    std::set<std::string> sections;
    for (const UserError& mistake : mistakes) {
      if (const auto index = ExperimentOf(mistake.key())) {
        experiments_.told.insert(*index);
      } else {
        sections.insert(SectionOf(mistake.key()));
      }
      reading_.mistakes.push_back(mistake);
    }
    std::erase_if(tree_.members, [&](const LocatedMember& member) {
      return sections.contains(SectionOf(member.key));
    });
  }

  void ReadSections() {
    const ConfigCursor root(file_, tree_);
    ReadExperiments(root, config_, &experiments_);
    reading_.mistakes.insert(reading_.mistakes.end(), experiments_.found.begin(),
                             experiments_.found.end());
    root.Read("title", config_.title);
    for (const auto read : {ReadModel, ReadResiduals, ReadSolver, ReadFamily, ReadAnalysis,
                            ReadSimulation, ReadEffects}) {
      try {
        read(root, config_);
      } catch (const UserError& error) {
        reading_.mistakes.push_back(error);
      }
    }
    std::vector<ExperimentConfig> good;
    for (std::size_t i = 0; i < config_.experiments.size(); ++i) {
      if (!experiments_.told.contains(i)) good.push_back(std::move(config_.experiments[i]));
    }
    config_.experiments = std::move(good);
    reading_.config = std::move(config_);
  }

  std::string file_;
  LocatedNode tree_;
  Config config_;
  ExperimentMistakes experiments_;
  ConfigReading reading_;
};

}  // namespace

ConfigReading ReadConfigOn(const std::filesystem::path& path) { return Reading(path).Read(); }

}  // namespace howl
