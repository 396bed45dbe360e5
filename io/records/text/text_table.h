// CSV (comma, semicolon or tab) and white-space text, plain or gzip.
#ifndef HOWL_IO_RECORDS_TEXT_TEXT_TABLE_H_
#define HOWL_IO_RECORDS_TEXT_TEXT_TABLE_H_

#include <filesystem>
#include <memory>

#include "io/records/columns/table_source.h"

namespace howl {

std::unique_ptr<TableSource> OpenTextTable(const std::filesystem::path& file,
                                           const TextDialect& dialect);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_TEXT_TABLE_H_
