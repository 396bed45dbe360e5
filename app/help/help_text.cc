#include "app/help/help_text.h"

#include <algorithm>

#include "app/command_line/command_line.h"
#include "model/version.h"

namespace howl {
namespace {

std::string Padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

std::string OptionsText(const std::vector<OptionHelp>& options) {
  constexpr std::size_t kWidth = 22;
  std::string text;
  for (const OptionHelp& option : options) {
    const std::string left = option.name + (option.value.empty() ? "" : " " + option.value);
    text += "  " + Padded(left, kWidth) + " " + option.text + "\n";
  }
  return text;
}

std::string ExitStatusText() {
  std::string text;
  for (const ExitStatus& each : kExitStatuses) {
    text += (text.empty() ? "" : "; ") + std::to_string(each.status) + " " + std::string(each.text);
  }
  return "Exit status: " + text + ".\n";
}

}  // namespace

std::string ProgramHelp() {
  constexpr std::size_t kWidth = 10;
  std::string text = "howl " + std::string(Version()) + ": " + std::string(kPurpose) +
                     "\n\nhowl COMMAND CONFIG [options]\n\nCommands:\n";
  for (const Command& command : Commands()) {
    text += "  " + Padded(command.name, kWidth) + " " + command.summary + "\n";
  }
  text += "\nOptions of every command:\n" + OptionsText(CommonOptions());
  return text +
         "\nhowl help COMMAND (or howl COMMAND --help) explains one command, howl help residuals "
         "what a\nfit can ask for, howl help effects what a diagnosis can name; howl help schema "
         "prints the\nconfig's JSON schema, howl help man [COMMAND] a manual page, howl help "
         "completion bash\n(zsh, fish) what lets that shell complete words.\n" +
         ExitStatusText();
}

std::string CommandHelp(const Command& command) {
  std::string text = "howl " + command.name + " " + command.operands +
                     " [options]: " + command.summary + "\n\n" + command.details + "\n";
  if (!command.options.empty()) text += "\nOptions:\n" + OptionsText(command.options);
  return text + "\nOptions of every command:\n" + OptionsText(CommonOptions());
}

}  // namespace howl
