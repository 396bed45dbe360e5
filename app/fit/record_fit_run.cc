#include "app/fit/record_fit_run.h"

#include <cstdio>

#include "app/command_line/command.h"
#include "app/input/record_solution.h"
#include "app/text/record_fit_text.h"
#include "io/whole_file.h"

namespace howl {

int RunRecordFit(const Config& config, const Options& options) {
  const RecordSolution solution = SolveRecords(config, options, SolvedFor::kFit);
  const std::filesystem::path path = options.out / "solution.json";
  WriteWholeFile(path, RecordSolutionJson(solution).dump(2) + "\n");
  if (!options.quiet) {
    std::printf("%s", RecordFitText(solution, config.operating_parameter).c_str());
    std::printf("written: %s\n", path.c_str());
  }
  return solution.Converged() ? kDone : kNegativeAnswer;
}

}  // namespace howl
