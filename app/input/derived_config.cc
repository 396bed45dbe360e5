#include "app/input/derived_config.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "io/config/schema/config_cursor.h"
#include "io/config/sections/config_sections.h"
#include "io/config/sections/table_name.h"
#include "io/user_error.h"

namespace howl {
namespace {

using Kind = LocatedNode::Kind;

// Of record: and of one of its responses; a formula of a response is no path.
constexpr std::string_view kResponses[] = {"pressure_response", "heat_release_response"};

struct Step {
  std::string name;
  std::optional<std::size_t> index;  // [0] behind the name
};

std::optional<std::vector<Step>> Parse(const std::string& key) {
  std::vector<Step> steps;
  std::size_t from = 0;
  while (from <= key.size()) {
    const std::size_t dot = std::min(key.find('.', from), key.size());
    Step step{key.substr(from, dot - from), std::nullopt};
    if (const std::size_t bracket = step.name.find('['); bracket != std::string::npos) {
      std::size_t index = 0;
      const char* const end = step.name.data() + step.name.size() - 1;
      const auto [at, error] = std::from_chars(step.name.data() + bracket + 1, end, index);
      if (error != std::errc() || at != end || *end != ']') return std::nullopt;
      step.index = index;
      step.name.resize(bracket);
    }
    if (step.name.empty()) return std::nullopt;
    steps.push_back(std::move(step));
    from = dot + 1;
  }
  return steps;
}

LocatedNode* Member(LocatedNode& mapping, const std::string& key) {
  const auto found = std::ranges::find(mapping.members, key, &LocatedMember::key);
  return found == mapping.members.end() ? nullptr : &found->value;
}

LocatedNode* ItemNamed(LocatedNode& list, const std::string& name) {
  for (LocatedNode& item : list.items) {
    const LocatedMember* const own = item.Find("name");
    if (own != nullptr && own->value.text == name) return &item;
  }
  return nullptr;
}

LocatedNode* ItemAt(LocatedNode* list, std::size_t index) {
  const bool is_there = list != nullptr && list->kind == Kind::kList && index < list->items.size();
  return is_there ? &list->items[index] : nullptr;
}

// The node that a step leads to; null where there is none and none can be made.
LocatedNode* Follow(LocatedNode& node, const Step& step) {
  LocatedNode* next = nullptr;
  if (node.kind == Kind::kList) {
    next = ItemNamed(node, step.name);
  } else {
    if (node.kind == Kind::kNull) node.kind = Kind::kMapping;
    if (node.kind != Kind::kMapping) return nullptr;
    next = Member(node, step.name);
    if (next == nullptr && !step.index) {
      node.members.push_back({.key = step.name, .key_line = node.line, .value = {}});
      next = &node.members.back().value;
    }
  }
  return step.index ? ItemAt(next, *step.index) : next;
}

// The values of the config that are paths.
std::vector<LocatedNode*> Paths(LocatedNode& config) {
  std::vector<LocatedNode*> paths;
  LocatedNode* const experiments = Member(config, "experiments");
  if (experiments == nullptr) return paths;
  for (LocatedNode& experiment : experiments->items) {
    LocatedNode* const record = Member(experiment, "record");
    if (record == nullptr) continue;
    for (LocatedMember& member : record->members) {
      if (IsPathKey(member.key, member.value.text)) paths.push_back(&member.value);
    }
  }
  return paths;
}

}  // namespace

std::optional<std::string> SetValue(LocatedNode& root, const std::string& key,
                                    const LocatedNode& value) {
  const std::optional<std::vector<Step>> steps = Parse(key);
  if (!steps) return "is no key, expected one such as model.modes or experiments[0].phi";
  LocatedNode* node = &root;
  for (const Step& step : *steps) {
    node = Follow(*node, step);
    if (node == nullptr) {
      return "leads nowhere from \"" + step.name +
             "\" on, expected a key of the config, or the name of an item of a list";
    }
  }
  *node = value;
  return std::nullopt;
}

bool IsPathKey(const std::string& key, const std::string& value) {
  if (key == "file" || key.ends_with(".record.file")) return true;
  for (const std::string_view response : kResponses) {
    if (key == response || key.ends_with("." + std::string(response))) return IsTableName(value);
  }
  return false;
}

std::string AbsolutePath(const std::filesystem::path& folder, const std::string& path) {
  if (path.starts_with("${")) return path;
  return std::filesystem::absolute(folder / path).lexically_normal().string();
}

void MakePathsAbsolute(LocatedNode& config, const std::filesystem::path& folder) {
  for (LocatedNode* const path : Paths(config)) {
    path->text = AbsolutePath(folder, path->text);
    path->quoted = true;
  }
}

std::vector<std::filesystem::path> InputFiles(LocatedNode& config) {
  static const std::string kNoFile;
  std::vector<std::filesystem::path> files;
  for (const LocatedNode* const path : Paths(config)) {
    try {
      files.emplace_back(ExpandEnvironment(ConfigCursor(kNoFile, *path)));
    } catch (const UserError&) {
      // The command that reads the file will say what is wrong.
    }
  }
  return files;
}

}  // namespace howl
