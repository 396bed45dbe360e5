// Checks a config's tree against the config's schema.
#ifndef HOWL_IO_CONFIG_SCHEMA_SCHEMA_CHECK_H_
#define HOWL_IO_CONFIG_SCHEMA_SCHEMA_CHECK_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "io/config/schema/schema_explain.h"
#include "io/config/yaml/located_node.h"

namespace howl {

// All mistakes, in the order of the file.
std::vector<SchemaMistake> FindSchemaMistakes(const LocatedNode& root,
                                              const nlohmann::json& schema);

// Throws UserError with the mistake that comes first in the file.
void CheckSchema(const std::string& file, const LocatedNode& root, const nlohmann::json& schema);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_SCHEMA_CHECK_H_
