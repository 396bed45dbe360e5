// One experiment's samples: p and q taken together at a constant rate, in closed loop.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_RECORD_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_RECORD_H_

#include <vector>

namespace howl {

struct Record {
  double sampling_hz = 0.0;
  std::vector<double> pressure;
  std::vector<double> heat_release;  // empty for a pressure-only record
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_RECORD_H_
