#include "app/help/help_topics.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "estimation/residuals/registry.h"
#include "io/config/schema/config_schema.h"

namespace howl {
namespace {

std::string Default(const ResidualNumber& number) {
  if (number.key.empty()) return "";
  std::ostringstream text;
  text << ", " << number.key << " " << number.value;
  return text.str();
}

std::string Residuals() {
  std::string text;
  for (const ResidualKind kind : kResidualKinds) {
    const ResidualDefinition& residual = DefinitionOf(kind);
    text += std::string(ResidualName(kind)) + ": " + std::string(residual.text) + "\n    " +
            std::string(residual.equation) + Default(residual.center) + Default(residual.std) +
            "\n";
  }
  return text;
}

}  // namespace

std::optional<std::string> HelpTopic(const std::string& name) {
  if (name == "residuals") return Residuals();
  if (name == "schema") return ConfigSchema().dump(2) + "\n";
  return std::nullopt;
}

}  // namespace howl
