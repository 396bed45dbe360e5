#include <nlohmann/json.hpp>

#include "io/config/reading/config_reading.h"
#include "io/config/schema/config_cursor.h"
#include "io/config/schema/config_schema.h"
#include "io/config/schema/config_tree.h"
#include "io/config/schema/scalar_check.h"
#include "io/config/schema/schema_check.h"
#include "io/config/schema/schema_words.h"
#include "io/config/sections/config_sections.h"
#include "io/config/yaml/config_text.h"
#include "io/config/yaml/placeholder.h"
#include "io/config/yaml/yaml_tree.h"

namespace howl {

Config LoadConfig(const std::filesystem::path& path, LoopsTaken loops) {
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
  if (config.record_loop && loops == LoopsTaken::kPapers) {
    throw UserError(
        file, config.model_line, "model",
        "states a loop that howl fit, simulate, predict and diagnose take, expected modes: 1 or 2, "
        "ratio: a number, damping: shared, residue: real, flame_input: pressure_rate, "
        "delay_spread: none, delay_paths: 1");
  }
  return config;
}

}  // namespace howl
