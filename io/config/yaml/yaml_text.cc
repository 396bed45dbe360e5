#include "io/config/yaml/yaml_text.h"

#include <yaml-cpp/yaml.h>

namespace howl {
namespace {

constexpr int kBlockDepth = 2;

void EmitBlocks(const LocatedNode& node, int depth, YAML::Emitter& out) {
  if (depth == kBlockDepth && node.kind == LocatedNode::Kind::kMapping) {
    out << YAML::BeginMap;
    for (const LocatedMember& member : node.members) {
      out << YAML::Key << member.key << YAML::Value << YAML::Flow;
      EmitYaml(member.value, out);
    }
    out << YAML::EndMap;
  } else if (depth < kBlockDepth && node.kind == LocatedNode::Kind::kMapping) {
    out << YAML::BeginMap;
    for (const LocatedMember& member : node.members) {
      out << YAML::Key << member.key << YAML::Value;
      EmitBlocks(member.value, depth + 1, out);
    }
    out << YAML::EndMap;
  } else if (depth < kBlockDepth && node.kind == LocatedNode::Kind::kList) {
    out << YAML::BeginSeq;
    for (const LocatedNode& item : node.items) EmitBlocks(item, depth + 1, out);
    out << YAML::EndSeq;
  } else {
    EmitYaml(node, out);
  }
}

}  // namespace

void EmitYaml(const LocatedNode& node, YAML::Emitter& out) {
  switch (node.kind) {
    case LocatedNode::Kind::kList:
      out << YAML::Flow << YAML::BeginSeq;
      for (const LocatedNode& item : node.items) EmitYaml(item, out);
      out << YAML::EndSeq;
      break;
    case LocatedNode::Kind::kMapping:
      out << YAML::Flow << YAML::BeginMap;
      for (const LocatedMember& member : node.members) {
        out << YAML::Key << member.key << YAML::Value;
        EmitYaml(member.value, out);
      }
      out << YAML::EndMap;
      break;
    case LocatedNode::Kind::kNull:
      out << YAML::Null;
      break;
    default:
      if (node.quoted) out << YAML::DoubleQuoted;
      out << node.text;
  }
}

std::string YamlText(const LocatedNode& document) {
  YAML::Emitter out;
  EmitBlocks(document, 0, out);
  return std::string(out.c_str()) + "\n";
}

}  // namespace howl
