// Cell arrays and structures of MATLAB 5 files. matio makes a place for each of the cells and
// fields that the dimensions ask for before it looks whether they are there: some bytes of a
// damaged file ask for gigabytes.
#ifndef HOWL_IO_RECORDS_BINARY_MAT5_NESTED_H_
#define HOWL_IO_RECORDS_BINARY_MAT5_NESTED_H_

#include <string>

#include "io/records/binary/mat5_element.h"

namespace howl {

// Whether a variable, without its own tag, begins as every variable does.
bool HasHead(Mat5Bytes variable, const Mat5Words& words);
// Whether its class holds other variables.
bool HoldsOthers(Mat5Bytes variable, const Mat5Words& words);

// The fault of a variable that needs more than it has; empty if there is none.
std::string FindNestedFault(Mat5Bytes variable, const Mat5Words& words);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_MAT5_NESTED_H_
