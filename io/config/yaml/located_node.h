// A YAML document as a tree whose every node knows its line. Scalars keep the text as written.
#ifndef HOWL_IO_CONFIG_YAML_LOCATED_NODE_H_
#define HOWL_IO_CONFIG_YAML_LOCATED_NODE_H_

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

struct LocatedMember;

struct LocatedNode {
  enum class Kind { kNull, kBoolean, kInteger, kNumber, kText, kList, kMapping };

  Kind kind = Kind::kNull;
  int line = 1;         // from 1
  std::string text;     // of a scalar
  bool quoted = false;  // a scalar in quotes or in a block
  bool boolean = false;
  double number = 0.0;  // of kInteger and kNumber; may be NaN or infinite
  std::vector<LocatedNode> items;
  std::vector<LocatedMember> members;

  const LocatedMember* Find(std::string_view key) const;
  std::size_t CountNodes() const;
  std::size_t CountText() const;  // bytes of all scalars and keys
};

struct LocatedMember {
  std::string key;
  int key_line = 1;
  LocatedNode value;
};

// A plain (unquoted) scalar by the rules of YAML 1.2's core schema, with yes, no, on and off as
// booleans as well; anything in quotes is text.
LocatedNode MakeScalar(const std::string& text, bool quoted, int line);

// For the schema's check. A number that is not finite becomes text, which no number may be.
nlohmann::json ToJson(const LocatedNode& node);

// "experiments" and "gain" give "experiments.gain"; an empty parent gives the key alone.
std::string JoinKey(const std::string& parent, const std::string& key);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_LOCATED_NODE_H_
