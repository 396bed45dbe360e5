// HDF5 by its C library: data sets by path.
#ifndef HOWL_IO_RECORDS_BINARY_HDF5_TABLE_H_
#define HOWL_IO_RECORDS_BINARY_HDF5_TABLE_H_

#include <filesystem>
#include <memory>

#include "io/records/columns/table_source.h"

namespace howl {

std::unique_ptr<TableSource> OpenHdf5Table(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_HDF5_TABLE_H_
