// YAML text to a LocatedNode, refusing what is legal YAML but never meant in a config: a key given
// twice, aliases that loop or explode, endless nesting, keys that are not text, a second document.
#ifndef HOWL_IO_CONFIG_YAML_YAML_TREE_H_
#define HOWL_IO_CONFIG_YAML_YAML_TREE_H_

#include <string>

#include "io/config/yaml/located_node.h"

namespace howl {

// `file` is for messages alone. Throws UserError.
LocatedNode ParseYaml(const std::string& file, const std::string& text);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_YAML_TREE_H_
