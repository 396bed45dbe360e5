// FILL_IN stands in a config where howl init could not know a value.
#ifndef HOWL_IO_CONFIG_YAML_PLACEHOLDER_H_
#define HOWL_IO_CONFIG_YAML_PLACEHOLDER_H_

#include <string>
#include <string_view>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

inline constexpr std::string_view kFillIn = "FILL_IN";

struct Placeholder {
  int line = 0;
  std::string key;  // "experiments[0].phi"
};

// In the order of the file.
std::vector<Placeholder> FindPlaceholders(const LocatedNode& root);

// The message about the first, or about all of them in one line: "is still to be filled in (and 12
// more places), expected a number".
std::string PlaceholderText(const std::vector<Placeholder>& all);

// Throws UserError at the first, which says how many there are.
void CheckFilledIn(const std::string& file, const LocatedNode& root);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_PLACEHOLDER_H_
