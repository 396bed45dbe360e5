#include "io/config/config.h"

#include <nlohmann/json.hpp>

#include "io/config/config_cursor.h"
#include "io/config/config_schema.h"
#include "io/config/config_sections.h"
#include "io/config/config_text.h"
#include "io/config/config_tree.h"
#include "io/config/placeholder.h"
#include "io/config/scalar_check.h"
#include "io/config/schema_check.h"
#include "io/config/schema_words.h"
#include "io/config/yaml_tree.h"

namespace howl {
Config LoadConfig(const std::filesystem::path& path) {
  const std::string file = path.string();
  const LocatedNode tree = ParseYaml(file, ReadConfigText(path));
  CheckIsMapping(file, tree);
  const ConfigCursor root(file, tree);
  Config config;
  config.source = path;
  config.operating_parameter = ReadOperatingParameter(root);
  CheckFilledIn(file, tree);
  CheckSchema(file, tree, ConfigSchemaFor(config.operating_parameter, ReadExperimentNames(tree)));
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
