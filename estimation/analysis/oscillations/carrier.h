// The carrier of a cycle that a slow oscillation modulates. One whose phase is swung far has
// sidebands f +- k f_slow above its carrier; the mean frequency over the spectrum of all of them is
// the carrier's, where amplitude and phase do not swing together, and near to it where they do.
#ifndef HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_CARRIER_H_
#define HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_CARRIER_H_

#include <optional>
#include <span>

#include "estimation/analysis/oscillations/strong_lines.h"
#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/spectra/slow_modulation.h"
#include "estimation/analysis/spectra/spectral_peak.h"
#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

// The slow oscillation among the lines that modulates the cycle at the peak, which then moves to
// its carrier; none where there are no sidebands.
std::optional<SlowOscillation> ModulationOf(const Record& record, const CrossSpectrum& spectrum,
                                            std::span<const OscillationLine> lines,
                                            SpectralPeak* peak);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_CARRIER_H_
