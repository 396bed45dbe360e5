// A tree as YAML again.
#ifndef HOWL_IO_CONFIG_YAML_YAML_TEXT_H_
#define HOWL_IO_CONFIG_YAML_YAML_TEXT_H_

#include <string>

#include "io/config/yaml/located_node.h"

namespace YAML {
class Emitter;
}

namespace howl {

// With the formats that are set in the emitter. Scalars keep their text, and their quotes.
void EmitYaml(const LocatedNode& node, YAML::Emitter& out);

// A document; what lies deeper than the experiments' keys is written in one line.
std::string YamlText(const LocatedNode& document);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_YAML_TEXT_H_
