// Checks MATLAB 5 files for consistency. matio reads as many numbers as a variable's dimensions ask
// for, whatever the variable has, so that missing ones are zero or come from its neighbour.
//
// A file is a header of 128 bytes and elements, each a tag of type and length (two 32-bit words)
// and its bytes; a variable (type 14, or inside zlib data, type 15) has as elements, padded to
// eight bytes, its class, dimensions, name and numbers. An element of up to four bytes may stand
// within its tag. (MATLAB, "MAT-File Format", version 5.)
#ifndef HOWL_IO_RECORDS_BINARY_MAT5_CHECK_H_
#define HOWL_IO_RECORDS_BINARY_MAT5_CHECK_H_

#include <filesystem>

namespace howl {

// Throws UserError where the file ends before its elements do, or where a numeric variable has not
// as many numbers as its dimensions say.
void CheckMat5(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_MAT5_CHECK_H_
