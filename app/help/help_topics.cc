#include "app/help/help_topics.h"

#include <glog/logging.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/command_line/command.h"
#include "app/command_line/command_line.h"
#include "app/help/completion_script.h"
#include "app/help/man_page.h"
#include "estimation/residuals/registry.h"
#include "io/config/schema/config_schema.h"
#include "model/effects/catalogue.h"

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

std::string Parameter(const EffectParameter& parameter) {
  std::ostringstream text;
  text << parameter.name << " (null " << parameter.null_value << "; " << parameter.low << " .. "
       << parameter.high << ")";
  return text.str();
}

// The forms of one effect stand together: they differ in their key, or in their parameters.
std::string Effects() {
  std::string text;
  std::string_view last;
  for (const EffectPointer& effect : Catalogue()) {
    if (effect->id() != last) {
      last = effect->id();
      text += std::string(last) + ": " + std::string(LoopBlockName(effect->block())) + "\n";
    }
    const EffectForm form = effect->form();
    text += "    " + (form.key.empty() ? "" : form.key + " " + form.value + ": ");
    bool first = true;
    for (const EffectParameter& parameter : effect->parameters()) {
      text += (first ? "" : ", ") + Parameter(parameter);
      first = false;
    }
    text += "\n";
  }
  return text;
}

std::string CommandNames() {
  std::string text;
  for (const Command& command : Commands()) text += command.name + "\n";
  return text;
}

// The one word that may follow the topic's name.
std::optional<std::string> OnlyWord(const std::string& topic,
                                    const std::vector<std::string>& words) {
  if (words.size() > 1) throw UsageError(words[1] + ": not expected after howl help " + topic);
  return words.empty() ? std::nullopt : std::optional(words.front());
}

}  // namespace

const std::vector<std::string>& HelpTopics() {
  static const std::vector<std::string> topics = {"residuals", "effects", "schema",
                                                  "commands",  "man",     "completion"};
  return topics;
}

std::string HelpTopic(const std::string& name, const std::vector<std::string>& words) {
  if (name == "residuals") return Residuals();
  if (name == "effects") return Effects();
  if (name == "schema") return ConfigSchema().dump(2) + "\n";
  if (name == "commands") return CommandNames();
  if (name == "man") {
    const std::optional<std::string> command = OnlyWord(name, words);
    return command ? CommandManPage(FindCommand(*command)) : ProgramManPage();
  }
  CHECK_EQ(name, "completion");
  return CompletionScript(OnlyWord(name, words).value_or(""));
}

}  // namespace howl
