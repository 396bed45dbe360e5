// The table of commands of howl_fit (cmake/first_answer.cmake), in the place of that of the
// program.
#include "app/command_line/command.h"

namespace howl {

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = {FitCommand()};
  return commands;
}

}  // namespace howl
