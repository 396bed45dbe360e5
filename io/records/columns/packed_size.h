// A small file may ask for any amount of memory and time: packed zeros, or a data set of which
// nothing is stored. What unpacks to more than any record of samples does is refused before it is
// unpacked.
#ifndef HOWL_IO_RECORDS_COLUMNS_PACKED_SIZE_H_
#define HOWL_IO_RECORDS_COLUMNS_PACKED_SIZE_H_

namespace howl {

// Measured records shrink to a half or a tenth, integers of a quiet channel to a fiftieth; deflate
// shrinks a single byte that repeats itself to a thousandth.
inline constexpr double kMostExpansion = 200.0;
// Below this size in bytes nothing is refused.
inline constexpr double kHarmlessBytes = 64.0 * 1024.0 * 1024.0;

inline constexpr const char* kBombWords =
    "unpacks to more than 200 times its size, expected a record of samples";

inline bool IsBomb(double packed_bytes, double unpacked_bytes) {
  return unpacked_bytes > kHarmlessBytes && unpacked_bytes > kMostExpansion * packed_bytes;
}

}  // namespace howl

#endif  // HOWL_IO_RECORDS_COLUMNS_PACKED_SIZE_H_
