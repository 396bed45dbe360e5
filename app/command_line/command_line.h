// The command line's flags are gflags: --name=value or --name value, with one dash or two, - or _
// within names, --noquiet; from a file (--flagfile), from the environment (--fromenv,
// --tryfromenv); the later one holds.
//
// At a mistake gflags' own parser ends the program with status 1 and several lines. Therefore the
// words are parsed here, each flag is checked, and gflags' registry then reads its value. A
// command's flags are registered once the command is known: those of others are mistakes, and two
// commands may have flags of one name.
#ifndef HOWL_APP_COMMAND_LINE_COMMAND_LINE_H_
#define HOWL_APP_COMMAND_LINE_COMMAND_LINE_H_

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/options.h"

namespace howl {

// The flags that every command has.
const std::vector<OptionHelp>& CommonOptions();

// The command of this name; throws UsageError, which names the nearest one.
const Command& FindCommand(const std::string& name);

// At most one object in a process, because gflags has one registry. All functions throw UsageError,
// or UserError for a mistake in a flag file.
class CommandLine {
 public:
  // `words` follow the program's name.
  explicit CommandLine(std::vector<std::string> words);

  // The next word that is no flag; the flags before it are set. Nothing at the end.
  std::optional<std::string> NextWord();
  // Registers the command's own flags.
  void SetCommand(const Command& command);

  bool WantsHelp() const;
  bool WantsVersion() const;
  // To be called after the last word.
  Options Finish(const std::vector<std::string>& operands) const;

 private:
  struct Place;
  using FollowingWord = std::function<std::optional<std::string>()>;

  const OptionHelp* Find(const std::string& flag) const;
  [[noreturn]] void FailUnknown(const Place& place, const std::string& flag) const;
  void Read(const Place& place, const std::string& word, const FollowingWord& following);
  void Set(const Place& place, const OptionHelp& flag, const std::string& value);
  void ReadFile(const Place& place, const std::string& path);
  void ReadEnvironment(const Place& place, const std::string& names, bool may_be_absent);

  std::vector<std::string> words_;
  std::size_t next_ = 0;
  int open_files_ = 0;
  const Command* command_ = nullptr;
  std::set<std::string> undefok_;
};

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_COMMAND_LINE_H_
