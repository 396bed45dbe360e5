// Samples first, ..., first + length - 1 of a signal, which are not what it was.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_GAP_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_GAP_H_

#include <cstddef>

namespace howl {

struct Gap {
  std::size_t first = 0;
  std::size_t length = 0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_GAP_H_
