// Turns the YAML parser's events into a LocatedNode.
#ifndef HOWL_IO_CONFIG_YAML_TREE_BUILDER_H_
#define HOWL_IO_CONFIG_YAML_TREE_BUILDER_H_

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

class TreeBuilder : public YAML::EventHandler {
 public:
  static constexpr std::size_t kMaxDepth = 16;           // the schema needs 6
  static constexpr std::size_t kMaxNodes = 200'000;      // with every alias written out
  static constexpr std::size_t kMaxScalarBytes = 4'096;  // bounds what regular expressions see
  // Many aliases of one long text are few values, and gigabytes.
  static constexpr std::size_t kMaxAliasBytes = std::size_t{4} << 20;
  static constexpr std::size_t kMaxKeys = 2'000;  // of one mapping, which is searched key by key

  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}

  // The position at which the last scalar in quotes (or in a block) started; null without one.
  YAML::Mark LastQuoted() const { return last_quoted_; }
  LocatedNode TakeRoot() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override;

 private:
  // A list or mapping that is still open.
  struct Frame {
    LocatedNode node;
    YAML::anchor_t anchor = 0;
    std::optional<std::string> key;  // of a mapping: the key whose value comes next
    int key_line = 0;
    std::unordered_map<std::string, int> key_lines;
  };
  struct Anchored {
    LocatedNode node;
    std::size_t count = 0;
    std::size_t bytes = 0;
  };

  bool ExpectsKey() const;
  std::string Path() const;  // of the node that comes next
  [[noreturn]] void Fail(int line, const std::string& key, const std::string& what) const;
  void Open(LocatedNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor);
  void Close();
  void Add(LocatedNode node, YAML::anchor_t anchor, std::size_t count);
  void AddKey(const LocatedNode& node);
  void Anchor(YAML::anchor_t anchor, const LocatedNode& node, std::size_t count);
  void CheckKeys(std::size_t count, int line) const;
  void Merge(Frame& frame) const;

  std::string file_;
  std::vector<Frame> open_;
  std::map<YAML::anchor_t, Anchored> anchored_;
  std::size_t num_nodes_ = 0;
  std::size_t alias_bytes_ = 0;
  YAML::Mark last_quoted_ = YAML::Mark::null_mark();
  LocatedNode root_;
};

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_TREE_BUILDER_H_
