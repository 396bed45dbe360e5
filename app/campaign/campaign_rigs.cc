#include "app/campaign/campaign_rigs.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/input/derived_config.h"
#include "io/config/yaml/config_text.h"
#include "io/config/yaml/yaml_text.h"
#include "io/config/yaml/yaml_tree.h"
#include "io/report/csv_table.h"
#include "io/user_error.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSeedKey = "seed";
constexpr const char* kRigColumn = "rig";
constexpr std::size_t kMostRigs = 1'000'000;
// All of the rigs' configs are held at once.
constexpr std::size_t kMostText = std::size_t{512} << 20;

// A value of a key, and where it was written.
struct Setting {
  std::string key;
  LocatedNode value;
  fs::path file;
  int line = 0;
};

// A rig before its config is made.
struct Sketch {
  std::string name;
  fs::path base;
  std::vector<Setting> settings;
};

std::vector<Sketch> FleetSketches(const CampaignSpec& spec, CampaignRigs& all) {
  CsvTable table;
  try {
    table = ReadCsvTable(*spec.fleet);
  } catch (const std::runtime_error& error) {
    throw UserError(spec.source.string(), spec.fleet_line, "fleet",
                    spec.fleet->string() + ": " + error.what());
  }
  if (!table.Find(kRigColumn)) {
    throw UserError(spec.fleet->string(), 1, kRigColumn,
                    "is no column, expected one with the rigs' names");
  }
  for (const std::string& column : table.columns) {
    if (column != kRigColumn) all.columns.push_back(column);
  }
  std::vector<Sketch> sketches;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const int line = static_cast<int>(row) + 2;
    Sketch sketch{table.Text(row, kRigColumn), spec.configs.front(), {}};
    for (const std::string& column : table.columns) {
      if (column == kRigColumn) continue;
      const std::string cell = table.Text(row, column);
      LocatedNode value = cell.empty() ? LocatedNode() : MakeScalar(cell, false, line);
      if (IsPathKey(column, cell) && !cell.empty()) {
        value.text = AbsolutePath(spec.fleet->parent_path(), value.text);
      }
      sketch.settings.push_back({column, value, *spec.fleet, line});
    }
    sketches.push_back(std::move(sketch));
  }
  return sketches;
}

std::vector<Sketch> FirstSketches(const CampaignSpec& spec, CampaignRigs& all) {
  if (spec.fleet) return FleetSketches(spec, all);
  std::vector<Sketch> sketches;
  for (const fs::path& config : spec.configs) {
    sketches.push_back({config.stem().string(), config, {}});
  }
  return sketches;
}

std::size_t PointsOfGrid(const std::vector<Sketch>& sketches, const CampaignSpec& spec) {
  std::size_t points = 1;
  for (const GridAxis& axis : spec.grid) {
    points *= axis.values.size();
    if (points * sketches.size() > kMostRigs) {
      throw UserError(spec.source.string(), axis.line, "grid." + axis.key,
                      "makes more than a million rigs, expected fewer");
    }
  }
  return points;
}

// Visits all combinations of the axes' values, the last axis running fastest. They are made one by
// one: a value may be a long list.
template <typename Visit>
void Multiply(const std::vector<Sketch>& sketches, const CampaignSpec& spec, const Visit& visit) {
  const std::size_t points = PointsOfGrid(sketches, spec);
  const int digits = static_cast<int>(std::to_string(points).size());
  for (const Sketch& sketch : sketches) {
    for (std::size_t point = 0; point < points; ++point) {
      Sketch one = sketch;
      char number[32];
      std::snprintf(number, sizeof number, "-%0*zu", digits, point + 1);
      one.name += number;
      std::size_t left = points;
      std::size_t at = point;
      for (const GridAxis& axis : spec.grid) {
        left /= axis.values.size();
        one.settings.push_back({axis.key, axis.values[at / left], spec.source, axis.line});
        at %= left;
      }
      visit(one);
    }
  }
}

std::uint64_t SeedOf(const Setting& setting) {
  std::uint64_t seed = 0;
  const std::string& text = setting.value.text;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UserError(setting.file.string(), setting.line, kSeedKey,
                    "is \"" + text + "\", expected a whole number");
  }
  return seed;
}

// A list is written as in the config.
std::string ValueText(const LocatedNode& value) {
  if (value.items.empty() && value.members.empty()) return value.text;
  std::string text = YamlText(value);
  std::ranges::replace(text, '\n', ' ');
  text.pop_back();
  return text;
}

struct Template {
  std::string text;
  LocatedNode tree;
};

// One may serve many rigs.
class Templates {
 public:
  const Template& Get(const fs::path& path) {
    const auto [place, is_new] = all_.try_emplace(path);
    if (is_new) {
      place->second.text = ReadConfigText(path);
      place->second.tree = ParseYaml(path.string(), place->second.text);
    }
    return place->second;
  }

 private:
  std::map<fs::path, Template> all_;
};

CampaignRig MakeRig(const Sketch& sketch, std::uint64_t seed, const fs::path& out,
                    Templates& templates) {
  const Template& base = templates.Get(sketch.base);
  CampaignRig rig{.name = sketch.name,
                  .config = sketch.base,
                  .config_text = base.text,
                  .is_derived = false,
                  .input_files = {},
                  .settings = {},
                  .seed = seed};
  LocatedNode tree = base.tree;
  MakePathsAbsolute(tree, sketch.base.parent_path());
  for (const Setting& setting : sketch.settings) {
    rig.settings.push_back(ValueText(setting.value));
    if (setting.key == kSeedKey) {
      rig.seed = SeedOf(setting);
      continue;
    }
    // An empty cell of a fleet leaves the template's value.
    if (setting.value.kind == LocatedNode::Kind::kNull) continue;
    rig.is_derived = true;
    if (const auto fault = SetValue(tree, setting.key, setting.value)) {
      throw UserError(setting.file.string(), setting.line, setting.key, *fault);
    }
  }
  rig.input_files = InputFiles(tree);
  if (rig.is_derived) {
    rig.config = RigFolder(out, rig.name) / "config.yaml";
    rig.config_text = YamlText(tree);
  }
  return rig;
}

std::size_t TextOf(const CampaignRig& rig) {
  std::size_t size = rig.config_text.size();
  for (const std::string& setting : rig.settings) size += setting.size();
  return size;
}

void CheckNames(const CampaignSpec& spec, const CampaignRigs& all) {
  constexpr const char* kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+";
  std::set<std::string> names;
  for (const CampaignRig& rig : all.rigs) {
    const bool is_name = !rig.name.empty() && rig.name[0] != '.' &&
                         rig.name.find_first_not_of(kLetters) == std::string::npos;
    const fs::path& file = spec.fleet ? *spec.fleet : spec.source;
    if (!is_name) {
      throw UserError(
          file.string(), 0, kRigColumn,
          "\"" + rig.name + "\" is no name of a rig, expected letters, digits and -_.+");
    }
    if (!names.insert(rig.name).second) {
      throw UserError(file.string(), 0, kRigColumn,
                      "\"" + rig.name + "\" is the name of two rigs, expected one each");
    }
  }
}

}  // namespace

CampaignRigs MakeRigs(const CampaignSpec& spec, std::uint64_t seed, const fs::path& out) {
  CampaignRigs all;
  const std::vector<Sketch> sketches = FirstSketches(spec, all);
  for (const GridAxis& axis : spec.grid) all.columns.push_back(axis.key);
  Templates templates;
  std::size_t text = 0;
  const auto add = [&](const Sketch& sketch) {
    all.rigs.push_back(MakeRig(sketch, seed, out, templates));
    text += TextOf(all.rigs.back());
    if (text > kMostText) {
      throw UserError(spec.source.string(), 0, "",
                      "the configs of its rigs take more than 512 MB, expected fewer or smaller");
    }
  };
  if (spec.grid.empty()) {
    std::ranges::for_each(sketches, add);
  } else {
    Multiply(sketches, spec, add);
  }
  CheckNames(spec, all);
  return all;
}

fs::path RigFolder(const fs::path& out, const std::string& name) { return out / "rigs" / name; }

}  // namespace howl
