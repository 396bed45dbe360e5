#include "io/config/schema/config_cursor.h"

#include <glog/logging.h>

#include "io/user_error.h"

namespace howl {

std::optional<ConfigCursor> ConfigCursor::Find(const std::string& key) const {
  const LocatedMember* const member = node_->Find(key);
  if (member == nullptr) return std::nullopt;
  return ConfigCursor(*file_, member->value, JoinKey(key_, key));
}

std::vector<ConfigCursor> ConfigCursor::Items() const {
  std::vector<ConfigCursor> items;
  items.reserve(node_->items.size());
  for (std::size_t i = 0; i < node_->items.size(); ++i) {
    items.emplace_back(*file_, node_->items[i], key_ + "[" + std::to_string(i) + "]");
  }
  return items;
}

void ConfigCursor::Read(const std::string& key, double& value) const {
  const LocatedMember* const member = node_->Find(key);
  if (member == nullptr) return;
  CHECK(member->value.kind == LocatedNode::Kind::kInteger ||
        member->value.kind == LocatedNode::Kind::kNumber)
      << key;
  value = member->value.number;
}

void ConfigCursor::Read(const std::string& key, int& value) const {
  const LocatedMember* const member = node_->Find(key);
  if (member == nullptr) return;
  CHECK(member->value.kind == LocatedNode::Kind::kInteger) << key;
  value = static_cast<int>(member->value.number);  // the schema bounds every whole number
}

void ConfigCursor::Read(const std::string& key, bool& value) const {
  const LocatedMember* const member = node_->Find(key);
  if (member == nullptr) return;
  CHECK(member->value.kind == LocatedNode::Kind::kBoolean) << key;
  value = member->value.boolean;
}

void ConfigCursor::Read(const std::string& key, std::string& value) const {
  const LocatedMember* const member = node_->Find(key);
  if (member != nullptr) value = member->value.text;
}

void ConfigCursor::Fail(const std::string& what) const {
  throw UserError(*file_, node_->line, key_, what);
}

void ConfigCursor::FailAt(const std::string& key, const std::string& what) const {
  const LocatedMember* const member = node_->Find(key);
  throw UserError(*file_, member != nullptr ? member->key_line : node_->line, JoinKey(key_, key),
                  what);
}

}  // namespace howl
