#include "io/config/yaml/tree_builder.h"

#include <algorithm>

#include "io/user_error.h"

namespace howl {
namespace {

constexpr const char* kMergeKey = "<<";  // of YAML 1.1: the keys of another mapping, as defaults

int LineOf(const YAML::Mark& mark) { return mark.line + 1; }

}  // namespace

void TreeBuilder::OnDocumentStart(const YAML::Mark& mark) { root_.line = LineOf(mark); }

void TreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  if (ExpectsKey()) {
    Fail(LineOf(mark), Path(), "a key is empty or null, expected the name of a key");
  }
  LocatedNode node;
  // An absent value is noticed at the next token, which may be lines below.
  node.line = !open_.empty() && open_.back().key ? open_.back().key_line : LineOf(mark);
  Add(std::move(node), anchor, 1);
}

void TreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const auto found = anchored_.find(anchor);
  if (found == anchored_.end()) {
    Fail(LineOf(mark), Path(),
         "an alias (*name) stands inside the value that it names, expected one without a loop");
  }
  if (num_nodes_ + found->second.count > kMaxNodes) {
    Fail(LineOf(mark), Path(),
         "aliases make more than " + std::to_string(kMaxNodes) +
             " values of this file, expected fewer");
  }
  alias_bytes_ += found->second.bytes;
  if (alias_bytes_ > kMaxAliasBytes) {
    Fail(LineOf(mark), Path(),
         "aliases make more than " + std::to_string(kMaxAliasBytes >> 20) +
             " MB of text of this file, expected less");
  }
  Add(found->second.node, 0, found->second.count);
}

void TreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& value) {
  if (value.size() > kMaxScalarBytes) {
    Fail(LineOf(mark), Path(),
         "a text of " + std::to_string(value.size()) + " characters, expected at most " +
             std::to_string(kMaxScalarBytes));
  }
  if (tag != "?") last_quoted_ = mark;
  const bool quoted = tag == "!" || tag == "tag:yaml.org,2002:str";
  if (!quoted && tag != "?" && !tag.empty() && !tag.starts_with("tag:yaml.org,2002:")) {
    Fail(LineOf(mark), Path(), "the tag " + tag + " has no meaning here, expected a plain value");
  }
  Add(MakeScalar(value, quoted, LineOf(mark)), anchor, 1);
}

void TreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                  YAML::anchor_t anchor, YAML::EmitterStyle::value) {
  Open(LocatedNode::Kind::kList, mark, tag, anchor);
}

void TreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                             YAML::EmitterStyle::value) {
  Open(LocatedNode::Kind::kMapping, mark, tag, anchor);
}

void TreeBuilder::OnMapEnd() {
  Merge(open_.back());
  Close();
}

bool TreeBuilder::ExpectsKey() const {
  return !open_.empty() && open_.back().node.kind == LocatedNode::Kind::kMapping &&
         !open_.back().key;
}

std::string TreeBuilder::Path() const {
  std::string path;
  for (const Frame& frame : open_) {
    if (frame.node.kind == LocatedNode::Kind::kList) {
      path += "[" + std::to_string(frame.node.items.size()) + "]";
    } else if (frame.key) {
      path = JoinKey(path, *frame.key);
    }
  }
  return path;
}

void TreeBuilder::Fail(int line, const std::string& key, const std::string& what) const {
  throw UserError(file_, line, key, what);
}

void TreeBuilder::Open(LocatedNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                       YAML::anchor_t anchor) {
  const char* const word = kind == LocatedNode::Kind::kList ? "list" : "mapping";
  if (ExpectsKey()) {
    Fail(LineOf(mark), Path(), std::string("a ") + word + " is used as a key, expected a name");
  }
  if (open_.size() == kMaxDepth) {
    Fail(LineOf(mark), Path(),
         "lists and mappings are nested more than " + std::to_string(kMaxDepth) +
             " deep, expected a config as the schema has it");
  }
  if (tag != "?" && tag != "!" && !tag.empty() && !tag.starts_with("tag:yaml.org,2002:")) {
    Fail(LineOf(mark), Path(), "the tag " + tag + " has no meaning here, expected a plain " + word);
  }
  Frame frame;
  frame.node.kind = kind;
  frame.node.line = LineOf(mark);
  frame.anchor = anchor;
  open_.push_back(std::move(frame));
}

void TreeBuilder::Close() {
  Frame frame = std::move(open_.back());
  open_.pop_back();
  const std::size_t count = frame.anchor != 0 ? frame.node.CountNodes() : 1;
  Anchor(frame.anchor, frame.node, count);
  Add(std::move(frame.node), 0, 1);
}

void TreeBuilder::Anchor(YAML::anchor_t anchor, const LocatedNode& node, std::size_t count) {
  if (anchor != 0) anchored_[anchor] = {node, count, node.CountText()};
}

void TreeBuilder::CheckKeys(std::size_t count, int line) const {
  if (count <= kMaxKeys) return;
  Fail(line, Path(),
       "a mapping of more than " + std::to_string(kMaxKeys) + " keys, expected fewer");
}

void TreeBuilder::Add(LocatedNode node, YAML::anchor_t anchor, std::size_t count) {
  num_nodes_ += count;
  if (num_nodes_ > kMaxNodes) {
    Fail(node.line, Path(),
         "the file has more than " + std::to_string(kMaxNodes) + " values, expected fewer");
  }
  Anchor(anchor, node, count);
  if (open_.empty()) {
    root_ = std::move(node);
  } else if (open_.back().node.kind == LocatedNode::Kind::kList) {
    open_.back().node.items.push_back(std::move(node));
  } else if (!open_.back().key) {
    AddKey(node);
  } else {
    Frame& frame = open_.back();
    frame.node.members.push_back({std::move(*frame.key), frame.key_line, std::move(node)});
    frame.key.reset();
  }
}

void TreeBuilder::AddKey(const LocatedNode& node) {
  if (node.kind == LocatedNode::Kind::kList || node.kind == LocatedNode::Kind::kMapping) {
    Fail(node.line, Path(), "an alias of a list or mapping is used as a key, expected a name");
  }
  Frame& frame = open_.back();
  const auto [earlier, is_new] = frame.key_lines.try_emplace(node.text, node.line);
  if (!is_new) {
    Fail(node.line, JoinKey(Path(), node.text),
         "given twice (first on line " + std::to_string(earlier->second) + "), expected once");
  }
  CheckKeys(frame.key_lines.size(), node.line);
  frame.key = node.text;
  frame.key_line = node.line;
}

void TreeBuilder::Merge(Frame& frame) const {
  LocatedNode& mapping = frame.node;
  const auto merge =
      std::find_if(mapping.members.begin(), mapping.members.end(),
                   [](const LocatedMember& member) { return member.key == kMergeKey; });
  if (merge == mapping.members.end()) return;
  const LocatedMember merged = std::move(*merge);
  mapping.members.erase(merge);
  frame.key_lines.erase(kMergeKey);
  std::vector<LocatedNode> sources = merged.value.items;
  if (sources.empty()) sources = {merged.value};
  for (const LocatedNode& source : sources) {
    if (source.kind != LocatedNode::Kind::kMapping) {
      Fail(merged.key_line, JoinKey(Path(), kMergeKey),
           "what is merged is not a mapping, expected an alias of one (*name)");
    }
    for (const LocatedMember& member : source.members) {
      if (!frame.key_lines.try_emplace(member.key, member.key_line).second) continue;
      CheckKeys(frame.key_lines.size(), merged.key_line);
      mapping.members.push_back(member);
    }
  }
}

}  // namespace howl
