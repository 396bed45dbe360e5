// Phase and frequency of one spectral line from its blocks (spectrum.h).
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_LINE_PHASE_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_LINE_PHASE_H_

#include <complex>
#include <span>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

// The blocks' phase, continuous from block to block. `reliable` is false where a step is too large
// to be unwrapped with confidence: then the phase means nothing.
struct PhaseSeries {
  std::vector<double> phase_rad;
  bool reliable = true;
};
PhaseSeries UnwrapPhase(std::span<const std::complex<double>> blocks);

struct LineFrequency {
  Estimate offset_hz;       // from the frequency of demodulation
  Estimate drift_hz_per_s;  // not available (NaN) where the phase is not reliable
  double diffusion_rad2_per_s = 0.0;
};

// Slope of the phase by FitTrend, its error widened by a significant drift; or where the phase
// cannot be unwrapped the power-weighted mean frequency arg(sum z_{b+1} conj(z_b)) / (2 pi hop).
LineFrequency EstimateLineFrequency(std::span<const std::complex<double>> blocks,
                                    const PhaseSeries& phase, double hop_s);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_LINE_PHASE_H_
