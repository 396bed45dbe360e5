// A command of the program: one file each in app/commands/, and a line in HOWL_COMMANDS.
#ifndef HOWL_APP_COMMAND_LINE_COMMAND_H_
#define HOWL_APP_COMMAND_LINE_COMMAND_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/options.h"

namespace howl {

// Exit statuses. A user's mistake (2) is thrown as UserError or UsageError.
inline constexpr int kDone = 0;
inline constexpr int kNegativeAnswer = 1;
inline constexpr int kBadInput = 2;

// What howl merge asks of a command that can be run in shards (app/jobs/shard.h).
struct Sharding {
  // SHA-256 of all that the units depend on beside the options and the program.
  std::string (*inputs_sha256)(const Options&);
  // Puts the units of all shards where an interrupted run of the command would have left them.
  void (*adopt)(const Options&, const std::map<std::string, std::string>& units);
  // The option with which the command runs nothing and makes its results of the units that are
  // there; empty where it needs them all.
  std::string table_option;
};

struct Command {
  std::string name;
  std::string summary;  // one line
  std::string details;  // what it reads, computes and writes
  std::vector<OptionHelp> options;
  int (*run)(const Options&);
  bool writes_results = true;  // to the output folder, whose run.json then names the run
  // The arguments after the command. "FILE..." is one file or more, which are Options::files.
  std::string operands = "CONFIG";
  std::optional<Sharding> sharding = std::nullopt;
  // Whether it writes to the output folder at all, which then nobody else may meanwhile.
  bool writes_output = writes_results;

  bool TakesSeveral() const { return operands.ends_with("..."); }
};

// The registry: one line a command, whose file in app/commands/ defines FitCommand(). The order is
// that of howl --help.
#define HOWL_COMMANDS(X) \
  X(Init)                \
  X(Check)               \
  X(Analyse)             \
  X(Fit)                 \
  X(Family)              \
  X(List)                \
  X(Predict)             \
  X(Simulate)            \
  X(Diagnose)            \
  X(Export)              \
  X(Trial)               \
  X(Campaign)            \
  X(Merge)               \
  X(Submit)              \
  X(Status)              \
  X(Regress)             \
  X(Report)

#define HOWL_COMMAND_FUNCTION(Name) Command Name##Command();
HOWL_COMMANDS(HOWL_COMMAND_FUNCTION)
#undef HOWL_COMMAND_FUNCTION

const std::vector<Command>& Commands();

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_COMMAND_H_
