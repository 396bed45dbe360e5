// Lengths of which a Fourier transform is fast.
#ifndef HOWL_MODEL_NUMERICS_SMOOTH_LENGTH_H_
#define HOWL_MODEL_NUMERICS_SMOOTH_LENGTH_H_

#include <cstddef>

namespace howl {

// Whether it has no prime factor above five.
constexpr bool IsSmooth(std::ptrdiff_t size) {
  for (const std::ptrdiff_t prime : {2, 3, 5}) {
    while (size % prime == 0) size /= prime;
  }
  return size == 1;
}

// The longest even length up to `size` that is smooth; below four `size`.
constexpr std::ptrdiff_t SmoothLength(std::ptrdiff_t size) {
  for (std::ptrdiff_t n = size - size % 2; n > 2; n -= 2) {
    if (IsSmooth(n)) return n;
  }
  return size;
}

// The shortest even length from `size` on that is smooth.
constexpr std::ptrdiff_t SmoothLengthFrom(std::ptrdiff_t size) {
  std::ptrdiff_t n = size > 2 ? size + size % 2 : 2;
  while (!IsSmooth(n)) n += 2;
  return n;
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_SMOOTH_LENGTH_H_
