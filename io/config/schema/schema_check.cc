// valijson decides whether and where the tree breaks the schema; the message about the place comes
// from io/schema_explain.
#include "io/config/schema/schema_check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "io/config/schema/config_schema.h"
#include "io/config/schema/schema_explain.h"
#include "io/user_error.h"

namespace howl {
namespace {

// A file that is no config at all may break the schema at each of its values.
constexpr std::size_t kMostMistakes = 1000;

struct Place {
  const LocatedNode* node = nullptr;
  const nlohmann::json* schema = nullptr;
  std::string key;  // as in messages: "experiments[2].gain"
};

// `context` is <root>, [experiments], [2], [gain].
Place Locate(const std::vector<std::string>& context, const LocatedNode& root,
             const nlohmann::json& schema) {
  Place place{&root, &schema, ""};
  for (std::size_t i = 1; i < context.size(); ++i) {
    const std::string step = context[i].substr(1, context[i].size() - 2);
    if (place.node->kind == LocatedNode::Kind::kList) {
      place.node = &place.node->items.at(std::stoul(step));
      place.schema = &ResolveRef(schema, place.schema->at("items"));
      place.key += "[" + step + "]";
      continue;
    }
    const LocatedMember* const member = place.node->Find(step);
    const nlohmann::json* const known = FindMemberSchema(schema, *place.schema, step);
    if (member == nullptr || known == nullptr) break;
    place.node = &member->value;
    place.schema = known;
    place.key = JoinKey(place.key, step);
  }
  return place;
}

}  // namespace

std::vector<SchemaMistake> FindSchemaMistakes(const LocatedNode& root,
                                              const nlohmann::json& schema) {
  const nlohmann::json tree = ToJson(root);
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), parsed);
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(tree);
  if (valijson::Validator().validate(parsed, target, &results)) return {};

  std::vector<SchemaMistake> mistakes;
  // One place may break several rules, and a list or mapping breaks those of what is in it.
  std::set<const LocatedNode*> seen;
  for (const valijson::ValidationResults::Error& error : results) {
    if (mistakes.size() >= kMostMistakes) break;
    const Place place = Locate(error.context, root, schema);
    if (!seen.insert(place.node).second) continue;
    for (SchemaMistake& mistake : ExplainMistakes(*place.node, place.key, *place.schema, schema)) {
      mistakes.push_back(std::move(mistake));
    }
  }
  std::ranges::stable_sort(mistakes, {}, &SchemaMistake::line);
  if (mistakes.empty()) {
    const auto& error = *results.begin();
    const Place place = Locate(error.context, root, schema);
    mistakes.push_back({place.node->line, place.key,
                        error.description + ", expected what the config's schema says"});
  }
  return mistakes;
}

void CheckSchema(const std::string& file, const LocatedNode& root, const nlohmann::json& schema) {
  const std::vector<SchemaMistake> mistakes = FindSchemaMistakes(root, schema);
  if (mistakes.empty()) return;
  throw UserError(file, mistakes.front().line, mistakes.front().key, mistakes.front().what);
}

}  // namespace howl
