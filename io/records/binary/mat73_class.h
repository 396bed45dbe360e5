// Files of MATLAB's version 7.3 are HDF5, with each variable's class in its attribute MATLAB_class:
// a text of fixed length that ends with a zero. matio understands little else, and stops at it or
// takes the variable for empty; programs other than MATLAB write the text without its zero, with
// variable length, or not at all.
#ifndef HOWL_IO_RECORDS_BINARY_MAT73_CLASS_H_
#define HOWL_IO_RECORDS_BINARY_MAT73_CLASS_H_

#include <filesystem>

namespace howl {

// Every variable of the HDF5 file has its MATLAB_class as MATLAB writes it. The caller holds the
// Hdf5Lock.
bool HasMatlabsOwnClasses(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_MAT73_CLASS_H_
