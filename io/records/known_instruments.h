// Removes from a record the responses of its instruments that the config states.
#ifndef HOWL_IO_RECORDS_KNOWN_INSTRUMENTS_H_
#define HOWL_IO_RECORDS_KNOWN_INSTRUMENTS_H_

#include <string>

#include "estimation/analysis/spectra/record.h"
#include "io/record_spec.h"

namespace howl {

// The formula, or the table, whose file is read. Throws UserError for a bad table.
InstrumentResponse ResponseOf(const ResponseSpec& known);

// Uses remove_instruments.h; no bit changes where the spec states none. Throws UserError for a bad
// table, with its file and line, and with the config's for a response without a finite value, one
// that is zero at every frequency or leaves a signal out of range, and a delay_s beyond a fiftieth
// of the record.
void TakeOutInstruments(const RecordSpec& spec, const std::string& config_file, Record& record);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_KNOWN_INSTRUMENTS_H_
