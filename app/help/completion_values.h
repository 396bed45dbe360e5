// The values of options that a shell can offer: files, and names that the config, the family or the
// catalogue has.
#ifndef HOWL_APP_HELP_COMPLETION_VALUES_H_
#define HOWL_APP_HELP_COMPLETION_VALUES_H_

#include <filesystem>
#include <string>

#include "app/command_line/command.h"
#include "app/command_line/options.h"
#include "app/help/completion.h"

namespace howl {

struct ValueContext {
  const Command* command = nullptr;  // none before it is typed
  std::filesystem::path config;      // empty before it is typed
  std::filesystem::path out;         // its folder of results
  std::string typed;                 // of the value so far
};

// All values, whatever is typed so far; of a list "a,b" its last item is completed. What cannot be
// read has no names.
Completion ValuesOf(const OptionHelp& option, const ValueContext& context);

// The files that the command's operands are.
FileKind OperandFiles(const Command& command);

}  // namespace howl

#endif  // HOWL_APP_HELP_COMPLETION_VALUES_H_
