#include "app/command.h"

namespace howl {

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = {
      AnalyseCommand(), DiagnoseCommand(), FitCommand(),     FamilyCommand(), ListCommand(),
      PredictCommand(), SimulateCommand(), RegressCommand(), ReportCommand(), TrialCommand()};
  return commands;
}

}  // namespace howl
