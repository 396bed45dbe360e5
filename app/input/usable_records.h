// The records to which a loop is fitted (Config::record_loop): both signals, long enough, each with
// the frequency about which its band lies.
#ifndef HOWL_APP_INPUT_USABLE_RECORDS_H_
#define HOWL_APP_INPUT_USABLE_RECORDS_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "app/command_line/options.h"
#include "app/input/record_input.h"
#include "estimation/analysis/analyse.h"
#include "estimation/joint_records/loop_record.h"
#include "io/config/config.h"

namespace howl {

struct UsableRecord {
  NamedRecord record;
  // Of the cycle, or of the strongest peak where there is none.
  double cycle_hz = 0.0;
  // Of the fundamental of p; zero where the record shows no cycle.
  double cycle_amplitude = 0.0;
};

// Of the experiments that have one. Throws UserError where one is not of both signals, or not long
// enough, and where there is none.
std::vector<UsableRecord> LoadUsableRecords(const Config& config, const Options& options);

// The same of records that were read already: those of `config`, in its order.
std::vector<UsableRecord> UsableRecords(const Config& config, const Options& options,
                                        std::vector<NamedRecord> records);

// Throws UserError where they are not; `set` is their analysis.
void RequireUsable(const Config& config, const std::vector<NamedRecord>& records,
                   const AnalysisSet& set);

// Throws UserError where an experiment has no record.
void RequireRecords(const Config& config);

std::vector<LoopRecord> LoopRecordsOf(std::vector<UsableRecord> records);

// The starts of a fit, where the config states them: a record needs more of them than a table does.
std::optional<std::size_t> StatedStarts(const Config& config);

}  // namespace howl

#endif  // HOWL_APP_INPUT_USABLE_RECORDS_H_
