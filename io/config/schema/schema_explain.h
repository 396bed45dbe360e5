// A broken rule of the schema in words: what is wrong, what was expected.
#ifndef HOWL_IO_CONFIG_SCHEMA_SCHEMA_EXPLAIN_H_
#define HOWL_IO_CONFIG_SCHEMA_SCHEMA_EXPLAIN_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

struct SchemaMistake {
  int line = 0;
  std::string key;
  std::string what;
};

// What `schema` (a part of `root_schema`) has against the node itself, its unknown and missing keys
// included, its members' and items' own values not.
std::vector<SchemaMistake> ExplainMistakes(const LocatedNode& node, const std::string& key,
                                           const nlohmann::json& schema,
                                           const nlohmann::json& root_schema);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_SCHEMA_EXPLAIN_H_
