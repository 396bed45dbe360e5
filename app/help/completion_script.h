// What a shell reads to complete howl's words. Each script asks `howl help complete`
// (completion.h), so that it needs no change when commands and options do.
#ifndef HOWL_APP_HELP_COMPLETION_SCRIPT_H_
#define HOWL_APP_HELP_COMPLETION_SCRIPT_H_

#include <string>

namespace howl {

// For bash, zsh or fish. Throws UsageError for another shell.
std::string CompletionScript(const std::string& shell);

}  // namespace howl

#endif  // HOWL_APP_HELP_COMPLETION_SCRIPT_H_
