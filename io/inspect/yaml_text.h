// Texts in the form that a YAML file needs.
#ifndef HOWL_IO_INSPECT_YAML_TEXT_H_
#define HOWL_IO_INSPECT_YAML_TEXT_H_

#include <cstddef>
#include <string>

namespace howl {

// The text, in quotes where a reader would take it for something else.
std::string YamlScalar(const std::string& text);

// A comment of as many lines as it needs, each of `columns` characters at most where words allow;
// those after the first are indented further.
std::string YamlComment(const std::string& text, std::size_t indent = 0, std::size_t columns = 100);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_YAML_TEXT_H_
