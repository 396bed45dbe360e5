// Finds all faults of a record's file, where LoadRecord stops at the first.
#ifndef HOWL_IO_RECORDS_RECORD_FAULTS_H_
#define HOWL_IO_RECORDS_RECORD_FAULTS_H_

#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/spectra/record.h"
#include "io/record_spec.h"
#include "io/user_error.h"

namespace howl {

struct RecordReading {
  std::optional<Record> record;   // as LoadRecord gives it; absent where there is a fault
  std::vector<UserError> faults;  // LoadRecord's own first
};

// Each column is read by itself, so that a fault in one does not hide those of the others; of
// samples that are no numbers it is said how many there are and where.
RecordReading ReadRecordOn(const RecordSpec& spec, const std::string& config_file, int config_line);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_RECORD_FAULTS_H_
