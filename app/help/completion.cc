#include "app/help/completion.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "app/command_line/command.h"
#include "app/command_line/command_line.h"
#include "app/help/completion_values.h"
#include "app/help/help_topics.h"

namespace howl {
namespace {

// What the words before the last one say.
struct Typed {
  const Command* command = nullptr;
  std::vector<std::string> operands;
  std::set<std::string> options;
  std::filesystem::path out;
  const OptionHelp* waiting = nullptr;  // the option whose value is being typed
};

const Command* CommandOf(const std::string& name) {
  const auto found =
      std::ranges::find_if(Commands(), [&](const Command& each) { return each.name == name; });
  return found == Commands().end() ? nullptr : &*found;
}

std::vector<OptionHelp> OptionsOf(const Command* command) {
  std::vector<OptionHelp> options;
  if (command != nullptr) options = command->options;
  options.insert(options.end(), CommonOptions().begin(), CommonOptions().end());
  return options;
}

const OptionHelp* FindOption(const Command* command, const std::string& name) {
  const auto in = [&](const std::vector<OptionHelp>& options) -> const OptionHelp* {
    const auto found =
        std::ranges::find_if(options, [&](const OptionHelp& each) { return each.name == name; });
    return found == options.end() ? nullptr : &*found;
  };
  const OptionHelp* const own = command == nullptr ? nullptr : in(command->options);
  return own != nullptr ? own : in(CommonOptions());
}

// An option of the words before the last one; `next` is the word after it.
void TakeOption(const std::string& word, const std::string* next, Typed* typed) {
  const std::size_t equals = word.find('=');
  const OptionHelp* const option = FindOption(typed->command, word.substr(0, equals));
  if (option == nullptr) return;
  if (!option->value.ends_with("...")) typed->options.insert(option->name);
  if (option->name != "--out") return;
  if (equals != std::string::npos) typed->out = word.substr(equals + 1);
  if (equals == std::string::npos && next != nullptr) typed->out = *next;
}

Typed Read(const std::vector<std::string>& words) {
  Typed typed;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.starts_with('-') && word != "-") {
      const bool is_last = i + 1 == words.size();
      TakeOption(word, is_last ? nullptr : &words[i + 1], &typed);
      const OptionHelp* const option = FindOption(typed.command, word);
      if (option == nullptr || option->value.empty()) continue;
      if (is_last) typed.waiting = option;
      ++i;
    } else if (typed.command == nullptr && typed.operands.empty() && CommandOf(word) != nullptr) {
      typed.command = CommandOf(word);
    } else {
      typed.operands.push_back(word);
    }
  }
  return typed;
}

Completion OptionNames(const Typed& typed) {
  Completion names;
  for (const OptionHelp& option : OptionsOf(typed.command)) {
    if (typed.options.contains(option.name)) continue;
    std::string text = option.text;
    std::ranges::replace(text, '\n', ' ');  // an offer is a line
    names.words.push_back({option.name, std::move(text)});
  }
  return names;
}

Completion CompletedCommands() {
  Completion names;
  for (const Command& command : Commands()) {
    names.words.push_back({command.name, command.summary});
  }
  return names;
}

// After howl help.
Completion AfterHelp(const std::vector<std::string>& words) {
  Completion names;
  if (words.size() == 1) {
    names = CompletedCommands();
    for (const std::string& topic : HelpTopics()) names.words.push_back({topic, ""});
  } else if (words.size() == 2 && words[1] == "man") {
    names = CompletedCommands();
  } else if (words.size() == 2 && words[1] == "completion") {
    for (const char* const shell : {"bash", "zsh", "fish"}) names.words.push_back({shell, ""});
  }
  return names;
}

Completion Operands(const Typed& typed) {
  if (typed.command == nullptr && typed.operands.empty()) {
    Completion first = CompletedCommands();
    first.words.push_back({"help", "explain a command"});
    return first;
  }
  if (typed.command == nullptr) {
    return typed.operands[0] == "help" ? AfterHelp(typed.operands) : Completion{};
  }
  if (!typed.operands.empty() && !typed.command->TakesSeveral()) return OptionNames(typed);
  return {{}, OperandFiles(*typed.command)};
}

// Of a config whose folder of results is not named, the one that the commands take.
ValueContext ContextOf(const Typed& typed, std::string value) {
  ValueContext context{typed.command, {}, typed.out, std::move(value)};
  if (!typed.operands.empty()) context.config = typed.operands.front();
  if (context.out.empty()) context.out = std::filesystem::path("out") / context.config.stem();
  return context;
}

}  // namespace

bool IsCompletion(const std::vector<std::string>& words) {
  return words.size() >= 2 && words[0] == "help" && words[1] == "complete";
}

Completion Complete(const std::vector<std::string>& words) {
  if (words.empty()) return Complete({""});
  const Typed typed = Read({words.begin(), words.end() - 1});
  std::string last = words.back();
  Completion found;
  if (typed.waiting != nullptr) {
    found = ValuesOf(*typed.waiting, ContextOf(typed, last));
  } else if (const std::size_t equals = last.find('=');
             last.starts_with('-') && equals != std::string::npos) {
    const OptionHelp* const option = FindOption(typed.command, last.substr(0, equals));
    last = last.substr(equals + 1);
    if (option != nullptr) found = ValuesOf(*option, ContextOf(typed, last));
  } else {
    found = last.starts_with('-') ? OptionNames(typed) : Operands(typed);
  }
  std::erase_if(found.words, [&](const OfferedWord& each) { return !each.text.starts_with(last); });
  return found;
}

std::string CompletionText(const Completion& completion) {
  std::string text;
  for (const OfferedWord& each : completion.words) {
    text += each.text + "\t" + each.description + "\n";
  }
  switch (completion.files) {
    case FileKind::kNone:
      return text;
    case FileKind::kAny:
      return text + ":files\n";
    case FileKind::kFolders:
      return text + ":folders\n";
    case FileKind::kConfigs:
      return text + ":configs\n";
  }
  return text;
}

}  // namespace howl
