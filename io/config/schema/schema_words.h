// The schema's rules and a config's values as words of a message.
#ifndef HOWL_IO_CONFIG_SCHEMA_SCHEMA_WORDS_H_
#define HOWL_IO_CONFIG_SCHEMA_SCHEMA_WORDS_H_

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

// Whether `schema` allows the JSON type, by "type" alone.
bool Accepts(const nlohmann::json& schema, const std::string& type);

// "a number above 0 (limit-cycle frequency in Hz)".
std::string DescribeExpected(const nlohmann::json& schema);

// A value as a message repeats it: short, text in quotes.
std::string DescribeValue(const LocatedNode& node);

// "one of a, b, c", followed by the one that `word` is nearest to.
std::string DescribeChoice(const std::string& word, const std::vector<std::string>& choices);

// "a, b, c".
std::string Join(const std::vector<std::string>& words);

// The keys of a mapping's schema, required ones first.
std::vector<std::string> KeysOf(const nlohmann::json& schema);

// The section in which the schema has `key`, if it is one only: "family" for "members".
std::optional<std::string> OnlyPlaceOf(const std::string& key, const nlohmann::json& root_schema);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_SCHEMA_WORDS_H_
