#include "app/help/completion_script.h"

#include "app/command_line/options.h"

namespace howl {
namespace {

#include "completion_scripts.inc"  // kBash, kZsh, kFish: the files of app/help/completion/

}  // namespace

std::string CompletionScript(const std::string& shell) {
  if (shell == "bash") return kBash;
  if (shell == "zsh") return kZsh;
  if (shell == "fish") return kFish;
  throw UsageError("completion: " + (shell.empty() ? "no shell given" : shell) +
                   ", expected bash, zsh or fish");
}

}  // namespace howl
