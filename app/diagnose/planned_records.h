// The records that a plan is made for: those of the config, or, before any was measured, records
// that are simulated from its fit.
#ifndef HOWL_APP_DIAGNOSE_PLANNED_RECORDS_H_
#define HOWL_APP_DIAGNOSE_PLANNED_RECORDS_H_

#include <vector>

#include "app/command_line/options.h"
#include "diagnosis/records/cut_record.h"
#include "io/config/config.h"

namespace howl {

// Whether any experiment has a record.
bool HasRecords(const Config& config);

// Simulates the config's fit as `howl simulate` does, with the length, rate and noise of its
// `simulate` section, but without its effects: a plan looks for those. Throws UserError.
std::vector<DiagnosisExperiment> SimulatedExperiments(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_PLANNED_RECORDS_H_
