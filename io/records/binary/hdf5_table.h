// HDF5 by its C library: data sets by path.
#ifndef HOWL_IO_RECORDS_BINARY_HDF5_TABLE_H_
#define HOWL_IO_RECORDS_BINARY_HDF5_TABLE_H_

#include <filesystem>
#include <memory>

#include "io/records/columns/table_source.h"

namespace howl {

// kMatlab: a file of MATLAB's version 7.3, where the data set rec/p is the field rec.p of a struct,
// and what cells refer to (#refs#) is no variable.
enum class Hdf5Names { kPaths, kMatlab };

std::unique_ptr<TableSource> OpenHdf5Table(const std::filesystem::path& file,
                                           Hdf5Names names = Hdf5Names::kPaths);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_HDF5_TABLE_H_
