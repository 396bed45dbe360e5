#include "io/config/yaml/placeholder.h"

#include "io/user_error.h"

namespace howl {
namespace {

void Collect(const LocatedNode& node, const std::string& key, std::vector<Placeholder>& all) {
  if (node.kind == LocatedNode::Kind::kText && node.text == kFillIn)
    all.push_back({node.line, key});
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    Collect(node.items[i], key + "[" + std::to_string(i) + "]", all);
  }
  for (const LocatedMember& member : node.members) {
    Collect(member.value, JoinKey(key, member.key), all);
  }
}

}  // namespace

std::vector<Placeholder> FindPlaceholders(const LocatedNode& root) {
  std::vector<Placeholder> all;
  Collect(root, "", all);
  return all;
}

std::string PlaceholderText(const std::vector<Placeholder>& all) {
  const std::size_t others = all.size() - 1;
  const std::string more =
      others == 0 ? ""
                  : " (as " + std::to_string(others) + (others == 1 ? " more is)" : " more are)");
  const bool is_rate = all.front().key.ends_with("sampling_hz");
  return std::string(kFillIn) + " is still to be replaced" + more + ", expected a number: " +
         (is_rate ? "the sampling rate in Hz"
                  : "the operating parameter, which was changed from experiment to experiment");
}

void CheckFilledIn(const std::string& file, const LocatedNode& root) {
  const std::vector<Placeholder> all = FindPlaceholders(root);
  if (!all.empty()) throw UserError(file, all.front().line, all.front().key, PlaceholderText(all));
}

}  // namespace howl
