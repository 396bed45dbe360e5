#include "app/command_line/command.h"

namespace howl {

const std::vector<Command>& Commands() {
#define HOWL_COMMAND_MADE(Name) Name##Command(),
  static const std::vector<Command> commands = {HOWL_COMMANDS(HOWL_COMMAND_MADE)};
#undef HOWL_COMMAND_MADE
  return commands;
}

}  // namespace howl
