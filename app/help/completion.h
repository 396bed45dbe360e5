// What a shell offers for the word that is being typed. `howl help complete WORD...` prints it for
// the scripts of completion_script.h: WORD... are the words after the program's name, the last one
// being typed (it may be empty). Whatever they are, the exit status is 0 and nothing goes to
// standard error.
#ifndef HOWL_APP_HELP_COMPLETION_H_
#define HOWL_APP_HELP_COMPLETION_H_

#include <cstdint>
#include <string>
#include <vector>

namespace howl {

// The files that may stand there as well; the shell lists them.
enum class FileKind : std::uint8_t { kNone, kAny, kFolders, kConfigs };

struct OfferedWord {
  std::string text;
  std::string description;  // may be empty
};

struct Completion {
  // Those that begin with what is typed. Of "--name=value" the value alone.
  std::vector<OfferedWord> words;
  FileKind files = FileKind::kNone;
};

// Whether the words after the program's name begin with "help complete".
bool IsCompletion(const std::vector<std::string>& words);

Completion Complete(const std::vector<std::string>& words);

// One line a candidate, "text<tab>description", then :files, :folders or :configs (folders and
// files *.yaml, *.yml).
std::string CompletionText(const Completion& completion);

}  // namespace howl

#endif  // HOWL_APP_HELP_COMPLETION_H_
