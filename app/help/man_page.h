// Manual pages, in the macros of man(7), from the same commands and options as `howl --help`. Their
// date is that of SOURCE_DATE_EPOCH, seconds since 1970 (https://reproducible-builds.org), where
// the environment has it, else today's.
#ifndef HOWL_APP_HELP_MAN_PAGE_H_
#define HOWL_APP_HELP_MAN_PAGE_H_

#include <string>

#include "app/command_line/command.h"

namespace howl {

// howl(1).
std::string ProgramManPage();
// howl-NAME(1).
std::string CommandManPage(const Command& command);

}  // namespace howl

#endif  // HOWL_APP_HELP_MAN_PAGE_H_
