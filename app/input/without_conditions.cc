#include "app/input/without_conditions.h"

#include <algorithm>
#include <sstream>
#include <string>

#include "estimation/family/answers/conflict/limits.h"
#include "estimation/family/problem/membership.h"

namespace howl {
namespace {

Condition ParseCondition(const std::string& name) {
  std::string expected;
  for (const Condition condition : kConditions) {
    if (name == ConditionName(condition)) return condition;
    expected += (expected.empty() ? "" : ", ") + std::string(ConditionName(condition));
  }
  throw UsageError("--without: " + name + ", expected one of " + expected);
}

}  // namespace

OptionHelp WithoutOption() {
  return {"--without", "CONDITION...",
          "leave a condition of the test out, such as loop_gain_min: as null in the config"};
}

Config WithoutConditions(Config config, const Options& options) {
  const std::optional<std::string> names = options.Text("--without");
  if (!names) return config;
  std::istringstream list(*names);
  for (std::string name; std::getline(list, name, ',');) {
    SwitchOff(config.family.test, ParseCondition(name));
  }
  return config;
}

}  // namespace howl
