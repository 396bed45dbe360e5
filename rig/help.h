// What howl_rig says of itself: --help prints text, --man a manual page in the macros of man(7),
// both from the same words. The page's date is that of SOURCE_DATE_EPOCH, seconds since 1970, where
// the environment has it, else today's.
#ifndef HOWL_RIG_HELP_H_
#define HOWL_RIG_HELP_H_

#include <string>

namespace rig {

std::string HelpText();
std::string ManPage();

}  // namespace rig

#endif  // HOWL_RIG_HELP_H_
