// The elements of a MATLAB 5 file: a tag of type and length, and its bytes (mat5_check.h).
#ifndef HOWL_IO_RECORDS_BINARY_MAT5_ELEMENT_H_
#define HOWL_IO_RECORDS_BINARY_MAT5_ELEMENT_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace howl {

using Mat5Bytes = std::span<const unsigned char>;

struct Mat5Words {
  bool swapped = false;
  std::uint32_t At(Mat5Bytes bytes, std::size_t at) const {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word = word << 8 | bytes[at + (swapped ? i : 3 - i)];
    return word;
  }
};

struct Mat5Element {
  std::uint32_t type = 0;
  std::size_t length = 0;
  std::size_t begin = 0;  // of its bytes
  std::size_t next = 0;   // element
};

inline constexpr std::size_t kMat5Tag = 8;
inline constexpr std::uint32_t kMat5Matrix = 14;

// No value where the bytes end before the tag does.
inline std::optional<Mat5Element> Mat5ElementAt(Mat5Bytes bytes, std::size_t at,
                                                const Mat5Words& words) {
  if (at + kMat5Tag > bytes.size()) return std::nullopt;
  const std::uint32_t first = words.At(bytes, at);
  if (first >> 16 != 0) return Mat5Element{first & 0xffff, first >> 16, at + 4, at + kMat5Tag};
  const std::size_t length = words.At(bytes, at + 4);
  return Mat5Element{first, length, at + kMat5Tag, at + kMat5Tag + (length + 7) / 8 * 8};
}

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_MAT5_ELEMENT_H_
