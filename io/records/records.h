// Records from files: CSV, white-space text (both plain or gzip), MATLAB .mat (5 to 7.3) and HDF5,
// recognised by content. Text may have a header (also as a comment), comments (# or %), a
// byte-order mark, CRLF, trailing separators. Columns go by name, by number from 1 and, in .mat and
// .h5 files, by NAME:K for channel K of a matrix.
#ifndef HOWL_IO_RECORDS_RECORDS_H_
#define HOWL_IO_RECORDS_RECORDS_H_

#include <cstddef>
#include <filesystem>
#include <string>

#include "estimation/analysis/spectra/record.h"
#include "io/record_spec.h"

namespace howl {

// Two rates that differ by less are one: the clock of the times and that of the converter.
inline constexpr double kSamplingRateTolerance = 1e-3;
inline constexpr std::size_t kFewestSamples = 32;  // of which a spectrum can be made

// The part [start_s, start_s + duration_s) of the record, scaled. Throws UserError: a mistake in
// the data names the data's file and line (`data.csv:9000: p: nan, expected a finite number`), one
// in what was asked for names the config's. Samples and times outside of the part are not judged.
// What is known of the instruments is taken out last (remove_instruments.h), so that the record is
// then shorter than the part.
Record LoadRecord(const RecordSpec& spec, const std::string& config_file, int config_line);

// Columns p and q (p alone for a pressure-only record), each number the shortest text that reads
// back as the same double. The file appears whole or not at all. Throws UserError.
void WriteRecordCsv(const std::filesystem::path& path, const Record& record);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_RECORDS_H_
