#include "app/command_line/command.h"

namespace howl {

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = {
      InitCommand(),    CheckCommand(),    AnalyseCommand(),  FitCommand(),      FamilyCommand(),
      ListCommand(),    PredictCommand(),  SimulateCommand(), DiagnoseCommand(), ExportCommand(),
      TrialCommand(),   CampaignCommand(), MergeCommand(),    SubmitCommand(),   StatusCommand(),
      RegressCommand(), ReportCommand()};
  return commands;
}

}  // namespace howl
