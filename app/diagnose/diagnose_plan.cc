#include "app/diagnose/diagnose_plan.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>

#include "app/command_line/command.h"
#include "app/diagnose/planned_records.h"
#include "app/input/diagnose_input.h"
#include "app/text/plan_text.h"
#include "app/text/text_table.h"
#include "io/results/plan_json.h"
#include "io/whole_file.h"
#include "model/effects/declared_effect.h"

namespace howl {
namespace {

std::string RecordsText(const std::vector<DiagnosisExperiment>& experiments, bool simulated) {
  const Record& first = experiments[0].record;
  const std::string count = std::to_string(experiments.size());
  return count + (experiments.size() == 1 ? " record" : " records") +
         (simulated ? " simulated from the fit (" : " (the first of ") +
         Fixed(static_cast<double>(first.pressure.size()) / first.sampling_hz, 1) + " s at " +
         Significant(first.sampling_hz, 4) + " Hz)";
}

}  // namespace

int RunPlan(const Config& config, const Options& options,
            const std::vector<std::string>& withheld) {
  for (const char* option : {"--bootstrap", "--reference"}) {
    if (options.Has(option)) {
      throw UsageError(std::string("--plan: expected without ") + option +
                       ": nothing is diagnosed");
    }
  }
  const bool simulated = !HasRecords(config);
  const std::vector<DiagnosisExperiment> experiments =
      simulated ? SimulatedExperiments(config, options) : LoadDiagnosisExperiments(config);
  PlanOptions how;
  how.model = BaseOf(config);
  how.choose_modes = !StatesModes(config);
  // A diagnosis lets delays differ where it may choose.
  if (!StatesDelays(config)) how.model.own_delays = true;
  how.threads = options.threads;
  how.withheld = withheld;
  std::ranges::copy(DeclaredEffectsOf(config), std::back_inserter(how.further));
  const Plan plan = MakePlan(experiments, how);
  const std::filesystem::path path = options.out / "plan.json";
  WriteWholeFile(path, PlanJson(plan, simulated).dump(2) + "\n");
  if (!options.quiet) {
    std::printf("%swritten: %s\n", PlanText(plan, RecordsText(experiments, simulated)).c_str(),
                path.c_str());
  }
  return kDone;
}

}  // namespace howl
