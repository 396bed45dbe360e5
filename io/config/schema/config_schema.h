// The config's JSON schema (draft 7): config_schema.json, which is read at build time, and a block
// for each residual of the registry (estimation/residuals/registry.h). `howl help schema` prints
// it.
#ifndef HOWL_IO_CONFIG_SCHEMA_CONFIG_SCHEMA_H_
#define HOWL_IO_CONFIG_SCHEMA_CONFIG_SCHEMA_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace howl {

const nlohmann::json& ConfigSchema();

// The schema with experiments that carry the key `operating_parameter` in place of phi.
nlohmann::json ConfigSchemaFor(const std::string& operating_parameter,
                               const std::vector<std::string>& experiments = {});

// Follows a "$ref" into the schema's definitions; any other schema is returned as it is.
const nlohmann::json& ResolveRef(const nlohmann::json& root, const nlohmann::json& schema);

// The schema of a mapping's key: its own, or that of any key; no value for an unknown key.
const nlohmann::json* FindMemberSchema(const nlohmann::json& root, const nlohmann::json& schema,
                                       const std::string& key);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_CONFIG_SCHEMA_H_
