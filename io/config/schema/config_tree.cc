#include "io/config/schema/config_tree.h"

#include <nlohmann/json.hpp>

#include "io/config/schema/config_schema.h"
#include "io/user_error.h"

namespace howl {

void CheckIsMapping(const std::string& file, const LocatedNode& root) {
  if (root.kind == LocatedNode::Kind::kMapping) return;
  const std::string is = root.kind == LocatedNode::Kind::kNull   ? "the file is empty"
                         : root.kind == LocatedNode::Kind::kList ? "the file is a list"
                                                                 : "the file is a bare value";
  throw UserError(file, root.line, "experiments",
                  is + ", expected a mapping with at least `experiments:` and their list");
}

std::string ReadOperatingParameter(const ConfigCursor& root) {
  const LocatedMember* const member = root.Node().Find("operating_parameter");
  if (member == nullptr || member->value.kind != LocatedNode::Kind::kText) return "phi";
  const std::string& name = member->value.text;
  const nlohmann::json& experiment = ConfigSchema()["definitions"]["experiment"];
  if (name != "phi" && experiment["properties"].contains(name)) {
    root.FailAt("operating_parameter", "\"" + name +
                                           "\" already means something else in experiments, "
                                           "expected another name");
  }
  return name;
}

std::vector<std::string> ReadExperimentNames(const LocatedNode& tree) {
  std::vector<std::string> names;
  const LocatedMember* const experiments = tree.Find("experiments");
  if (experiments == nullptr) return names;
  for (const LocatedNode& item : experiments->value.items) {
    const LocatedMember* const name = item.Find("name");
    if (name != nullptr && name->value.kind == LocatedNode::Kind::kText) {
      names.push_back(name->value.text);
    }
  }
  return names;
}

}  // namespace howl
