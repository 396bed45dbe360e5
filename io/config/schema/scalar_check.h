// The rules for every scalar of a config, whatever its key: numbers lie within the range that the
// arithmetic carries (io/number_range.h), and texts are text.
#ifndef HOWL_IO_CONFIG_SCHEMA_SCALAR_CHECK_H_
#define HOWL_IO_CONFIG_SCHEMA_SCALAR_CHECK_H_

#include <string>
#include <vector>

#include "io/config/yaml/located_node.h"
#include "io/user_error.h"

namespace howl {

// All scalars and keys that break this, in the order of the file.
std::vector<UserError> FindScalarMistakes(const std::string& file, const LocatedNode& root);

// Throws UserError for the first scalar or key that breaks this.
void CheckScalars(const std::string& file, const LocatedNode& root);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_SCALAR_CHECK_H_
