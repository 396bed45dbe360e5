// The table of a file, whatever its format.
#ifndef HOWL_IO_RECORDS_OPEN_TABLE_H_
#define HOWL_IO_RECORDS_OPEN_TABLE_H_

#include <filesystem>
#include <memory>

#include "io/record_spec.h"
#include "io/records/columns/table_source.h"

namespace howl {

// Recognises the format by the file's content. Throws UserError when it cannot be read, and where a
// dialect is given for what is no text.
std::unique_ptr<TableSource> OpenTable(const std::filesystem::path& file,
                                       const TextDialect& dialect = {});

}  // namespace howl

#endif  // HOWL_IO_RECORDS_OPEN_TABLE_H_
