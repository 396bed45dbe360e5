// What `howl --help` and `howl help COMMAND` print. The manual pages (man_page.h) are made of the
// same commands, options and exit statuses.
#ifndef HOWL_APP_HELP_HELP_TEXT_H_
#define HOWL_APP_HELP_HELP_TEXT_H_

#include <string>
#include <string_view>
#include <vector>

#include "app/command_line/command.h"

namespace howl {

inline constexpr std::string_view kPurpose =
    "grey-box identification of self-excited feedback loops";

struct ExitStatus {
  int status;
  std::string_view text;
};

inline constexpr ExitStatus kExitStatuses[] = {
    {0, "done"},
    {1, "the answer is negative"},
    {2, "bad input"},
    {130, "interrupted"},
};

std::string ProgramHelp();
std::string CommandHelp(const Command& command);

}  // namespace howl

#endif  // HOWL_APP_HELP_HELP_TEXT_H_
