// A place in a config that has passed the schema's check: reads values into structs, and says where
// it is when a rule beyond the schema is broken.
#ifndef HOWL_IO_CONFIG_SCHEMA_CONFIG_CURSOR_H_
#define HOWL_IO_CONFIG_SCHEMA_CONFIG_CURSOR_H_

#include <optional>
#include <string>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

class ConfigCursor {
 public:
  // The file's name and the tree must outlive the cursor.
  ConfigCursor(const std::string& file, const LocatedNode& node, std::string key = "")
      : file_(&file), node_(&node), key_(std::move(key)) {}

  const LocatedNode& Node() const { return *node_; }
  const std::string& File() const { return *file_; }
  int Line() const { return node_->line; }

  std::optional<ConfigCursor> Find(const std::string& key) const;
  std::vector<ConfigCursor> Items() const;

  // Absent keys leave `value` as it is.
  void Read(const std::string& key, double& value) const;
  void Read(const std::string& key, int& value) const;
  void Read(const std::string& key, bool& value) const;
  void Read(const std::string& key, std::string& value) const;
  template <typename T>
  void Read(const std::string& key, std::optional<T>& value) const {
    if (!Find(key)) return;
    T present{};
    Read(key, present);
    value = present;
  }

  // `what` is wrong with the value here, or with the key (absent, perhaps) of the mapping here.
  [[noreturn]] void Fail(const std::string& what) const;
  [[noreturn]] void FailAt(const std::string& key, const std::string& what) const;

 private:
  const std::string* file_;
  const LocatedNode* node_;
  std::string key_;
};

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_CONFIG_CURSOR_H_
