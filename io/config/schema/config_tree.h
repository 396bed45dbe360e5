// Reads what has to be known of a config's tree before the schema can check it.
#ifndef HOWL_IO_CONFIG_SCHEMA_CONFIG_TREE_H_
#define HOWL_IO_CONFIG_SCHEMA_CONFIG_TREE_H_

#include <string>
#include <vector>

#include "io/config/schema/config_cursor.h"
#include "io/config/yaml/located_node.h"

namespace howl {

// Throws UserError for an empty file, a list, a bare value.
void CheckIsMapping(const std::string& file, const LocatedNode& root);

// The schema depends on it, so it is read before the schema's check; what is wrong with it as a
// value is left to that check. Throws UserError for a key that has another meaning.
std::string ReadOperatingParameter(const ConfigCursor& root);

// For the parameters that one experiment has to itself; what is wrong with a name is left to the
// schema's check.
std::vector<std::string> ReadExperimentNames(const LocatedNode& tree);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_CONFIG_TREE_H_
