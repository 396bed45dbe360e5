// A command of the program: one file each, listed in commands.cc.
#ifndef HOWL_APP_COMMAND_H_
#define HOWL_APP_COMMAND_H_

#include <string>
#include <vector>

#include "app/options.h"

namespace howl {

// Exit statuses. A user's mistake (2) is thrown as UserError or UsageError.
inline constexpr int kDone = 0;
inline constexpr int kNegativeAnswer = 1;
inline constexpr int kBadInput = 2;

struct Command {
  std::string name;
  std::string summary;  // one line
  std::string details;  // what it reads, computes and writes
  std::vector<OptionHelp> options;
  int (*run)(const Options&);
  bool writes_results = true;  // to the output folder, whose run.json then names the run
  // The arguments after the command. "FILE..." is one file or more, which are Options::files.
  std::string operands = "CONFIG";

  bool TakesSeveral() const { return operands.ends_with("..."); }
};

const std::vector<Command>& Commands();

Command AnalyseCommand();
Command CheckCommand();
Command DiagnoseCommand();
Command FitCommand();
Command FamilyCommand();
Command InitCommand();
Command ListCommand();
Command PredictCommand();
Command RegressCommand();
Command ReportCommand();
Command SimulateCommand();
Command TrialCommand();

}  // namespace howl

#endif  // HOWL_APP_COMMAND_H_
