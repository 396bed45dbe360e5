// A table of an instrument's response: columns frequency_hz, magnitude and phase_deg, in any format
// of records.h.
#ifndef HOWL_IO_RECORDS_RESPONSE_TABLE_H_
#define HOWL_IO_RECORDS_RESPONSE_TABLE_H_

#include <filesystem>

#include "estimation/analysis/instruments/instrument_response.h"

namespace howl {

// Throws UserError, with the table's file and line, for a table that has fewer than two rows, a
// number that is not finite, frequencies that are negative or do not increase, or a magnitude that
// is not above zero.
InstrumentResponse ReadResponseTable(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_RESPONSE_TABLE_H_
