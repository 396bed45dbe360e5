#include "io/results/family/family_changes.h"

#include <algorithm>
#include <array>

#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

// A name that YAML takes for a text without quotes.
bool IsPlain(const std::string& name) {
  constexpr std::array<std::string_view, 10> kWords = {"true", "false", "null", "yes", "no",
                                                       "on",   "off",   "y",    "n",   "nan"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (name.empty() || !is_letter(name.front())) return false;
  std::string lower = name;
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (std::find(kWords.begin(), kWords.end(), lower) != kWords.end()) return false;
  return std::all_of(name.begin(), name.end(), [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string Quoted(const std::string& name) { return IsPlain(name) ? name : Json(name).dump(); }

// The shortest text that reads back as the same number.
std::string NumberText(double value) { return Json(value).dump(); }

std::string_view KindName(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::kCondition:
      return "condition";
    case ChangeKind::kBound:
      return "bound";
    case ChangeKind::kDatum:
      break;
  }
  return "datum";
}

Json OptionalJson(const std::optional<double>& value) {
  return value ? NumberOrNull(*value) : Json(nullptr);
}

Json ChangeJson(const FamilyProblem& problem, const SmallestChange& change,
                std::span<const std::string> recorded) {
  const std::string line = ChangeLine(problem, change, recorded);
  const bool is_switch = change.target.IsSwitch();
  Json json = {{"name", ChangeName(problem, change.target)},
               {"kind", KindName(change.target.kind)},
               {"helps", change.searched ? Json(change.helps) : Json(nullptr)},
               {"value", is_switch ? Json(true) : NumberOrNull(change.value)},
               {"needed", OptionalJson(change.needed)},
               {"pasted", is_switch && change.pasted ? Json(false) : OptionalJson(change.pasted)},
               {"line", line.empty() ? Json(nullptr) : Json(line)}};
  if (change.helps && !is_switch) json["less_is_proved_empty"] = change.less_is_proved_empty;
  return json;
}

}  // namespace

std::string ChangeName(const FamilyProblem& problem, const ChangeTarget& target) {
  switch (target.kind) {
    case ChangeKind::kCondition:
      return std::string(ConditionName(target.condition));
    case ChangeKind::kBound:
      return std::string(ParameterName(target.parameter)) + (target.is_upper ? ".max" : ".min");
    case ChangeKind::kDatum:
      break;
  }
  return problem.experiments[target.experiment].name + "." + std::string(DatumName(target.datum));
}

std::string ChangeLine(const FamilyProblem& problem, const SmallestChange& change,
                       std::span<const std::string> recorded) {
  const ChangeTarget& target = change.target;
  if (!change.helps || !change.pasted) return "";
  const std::string value = target.IsSwitch() ? "false" : NumberText(*change.pasted);
  switch (target.kind) {
    case ChangeKind::kCondition:
      return "family: {test: {" + std::string(ConditionName(target.condition)) + ": " + value +
             "}}";
    case ChangeKind::kBound:
      return "parameters: {" + std::string(ParameterName(target.parameter)) + ": {" +
             (target.is_upper ? "max: " : "min: ") + value + "}}";
    case ChangeKind::kDatum:
      break;
  }
  const std::string& name = problem.experiments[target.experiment].name;
  if (target.datum != Datum::kReliable &&
      std::find(recorded.begin(), recorded.end(), name) != recorded.end()) {
    return "";
  }
  return "experiments: [{name: " + Quoted(name) + ", " + std::string(DatumName(target.datum)) +
         ": " + value + "}]";
}

Json ConflictJson(const FamilyProblem& problem, const Conflict& conflict,
                  std::span<const std::string> recorded) {
  Json sets = Json::array();
  for (const std::vector<Condition>& set : conflict.minimal_sets) {
    Json names = Json::array();
    for (const Condition condition : set) names.push_back(ConditionName(condition));
    sets.push_back(std::move(names));
  }
  Json relaxations = Json::array();
  Json changes = Json::array();
  for (const SmallestChange& change : conflict.changes) {
    changes.push_back(ChangeJson(problem, change, recorded));
    if (change.target.kind != ChangeKind::kCondition) continue;
    relaxations.push_back({{"condition", ConditionName(change.target.condition)},
                           {"suffices", change.helps},
                           {"value", NumberOrNull(change.value)},
                           {"needed", OptionalJson(change.needed)}});
  }
  return {{"proved", conflict.proved},
          {"minimal_sets", sets},
          {"sets_proved", conflict.sets_proved},
          {"relaxations", relaxations},
          {"changes", changes}};
}

}  // namespace howl
