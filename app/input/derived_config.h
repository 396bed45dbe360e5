// A config that is another one with some values changed.
#ifndef HOWL_APP_INPUT_DERIVED_CONFIG_H_
#define HOWL_APP_INPUT_DERIVED_CONFIG_H_

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

// Sets the value of a key such as model.modes, experiments[0].record.file or
// experiments.exp1.record.file, where a word after a list is the name of one of its items. Mappings
// that are not there are made. Returns what is wrong with the key, if anything is.
std::optional<std::string> SetValue(LocatedNode& root, const std::string& key,
                                    const LocatedNode& value);

// Whether the key's value is a path, and so relative to the file in which it stands.
bool IsPathKey(const std::string& key, const std::string& value);

// The path as it reads from any folder. One that begins with a variable of the environment is left.
std::string AbsolutePath(const std::filesystem::path& folder, const std::string& path);

// All paths of the config as they read from any folder; `folder` is the config's.
void MakePathsAbsolute(LocatedNode& config, const std::filesystem::path& folder);

// The files that the config names, its paths being absolute; without those whose variable of the
// environment is not set.
std::vector<std::filesystem::path> InputFiles(LocatedNode& config);

}  // namespace howl

#endif  // HOWL_APP_INPUT_DERIVED_CONFIG_H_
