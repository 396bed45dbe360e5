// One experiment's samples: p and q taken together at a constant rate, in closed loop.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_RECORD_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_RECORD_H_

#include <complex>
#include <functional>
#include <vector>

namespace howl {

// Of the frequency in Hz.
using ResponseInHertz = std::function<std::complex<double>(double)>;

struct Record {
  double sampling_hz = 0.0;
  std::vector<double> pressure;
  std::vector<double> heat_release;  // empty for a pressure-only record
  // Of the times, at which p or q was lost: what stands in its place tells nothing new.
  double lost_share = 0.0;
  // Where samples of p were lost and others stand in their place: draws of how far off these may
  // be, alike in all periods (draw_clipped.h).
  std::vector<std::vector<double>> pressure_errors;
  // What the signals were divided by, where the instruments were known (remove_instruments.h), and
  // with them the noise that had come in behind these; empty: nothing.
  ResponseInHertz pressure_instrument, heat_release_instrument;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_RECORD_H_
