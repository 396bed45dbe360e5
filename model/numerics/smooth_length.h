// Lengths of which a Fourier transform is fast.
#ifndef HOWL_MODEL_NUMERICS_SMOOTH_LENGTH_H_
#define HOWL_MODEL_NUMERICS_SMOOTH_LENGTH_H_

#include <cstddef>

namespace howl {

// The longest even length up to `size` that has no prime factor above five; below four `size`.
constexpr std::ptrdiff_t SmoothLength(std::ptrdiff_t size) {
  for (std::ptrdiff_t n = size - size % 2; n > 2; n -= 2) {
    std::ptrdiff_t rest = n;
    for (const std::ptrdiff_t prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return n;
  }
  return size;
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_SMOOTH_LENGTH_H_
