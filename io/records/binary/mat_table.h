// MATLAB .mat, versions 5 to 7.3, by matio.
#ifndef HOWL_IO_RECORDS_BINARY_MAT_TABLE_H_
#define HOWL_IO_RECORDS_BINARY_MAT_TABLE_H_

#include <filesystem>
#include <memory>

#include "io/records/columns/table_source.h"

namespace howl {

std::unique_ptr<TableSource> OpenMatTable(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_MAT_TABLE_H_
