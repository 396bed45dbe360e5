#include "io/config/config.h"

#include <nlohmann/json.hpp>

#include "io/config/config_cursor.h"
#include "io/config/config_schema.h"
#include "io/config/config_sections.h"
#include "io/config/config_text.h"
#include "io/config/scalar_check.h"
#include "io/config/schema_check.h"
#include "io/config/schema_words.h"
#include "io/config/yaml_tree.h"
#include "io/user_error.h"

namespace howl {
namespace {

void CheckIsMapping(const std::string& file, const LocatedNode& root) {
  if (root.kind == LocatedNode::Kind::kMapping) return;
  const std::string is = root.kind == LocatedNode::Kind::kNull   ? "the file is empty"
                         : root.kind == LocatedNode::Kind::kList ? "the file is a list"
                                                                 : "the file is a bare value";
  throw UserError(file, root.line, "experiments",
                  is + ", expected a mapping with at least `experiments:` and their list");
}

// The schema depends on it, so it is read before the schema's check; what is wrong with it as a
// value is left to that check.
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

// For the parameters that one experiment has to itself; what is wrong with a name is left to the
// schema's check.
std::vector<std::string> ReadNames(const LocatedNode& tree) {
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

}  // namespace

Config LoadConfig(const std::filesystem::path& path) {
  const std::string file = path.string();
  const LocatedNode tree = ParseYaml(file, ReadConfigText(path));
  CheckIsMapping(file, tree);
  const ConfigCursor root(file, tree);
  Config config;
  config.source = path;
  config.operating_parameter = ReadOperatingParameter(root);
  CheckSchema(file, tree, ConfigSchemaFor(config.operating_parameter, ReadNames(tree)));
  CheckScalars(file, tree);
  root.Read("title", config.title);
  ReadExperiments(root, config);
  ReadModel(root, config);
  ReadResiduals(root, config);
  ReadSolver(root, config);
  ReadFamily(root, config);
  ReadAnalysis(root, config);
  ReadSimulation(root, config);
  ReadEffects(root, config);
  config.tree = tree;
  return config;
}

}  // namespace howl
