// The lines of a record that may be oscillations of their own (oscillations.h).
#ifndef HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_STRONG_LINES_H_
#define HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_STRONG_LINES_H_

#include <optional>
#include <span>
#include <vector>

#include "estimation/analysis/spectra/lines.h"
#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/spectra/slow_modulation.h"
#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

struct OscillationLine {
  double frequency_hz = 0.0;
  double tolerance_hz = 0.0;  // within which another frequency counts as the same
  double p_share = 0.0, q_share = 0.0;
  double Share() const { return p_share > q_share ? p_share : q_share; }
};

// The mean square of samples about their mean.
double Variance(std::span<const double> samples);

// Lines with at least least_share of p or q, the strongest first. Bins are no finer than the
// slowest oscillation needs, so that a line whose phase wanders stands out in a long record too.
std::vector<OscillationLine> StrongLines(const Record& record, const CrossSpectrum& spectrum,
                                         double least_share);

// Whether the line is a multiple of one of `stronger`, or a sum or difference of two of them and
// their multiples.
bool IsCombination(const OscillationLine& line, std::span<const OscillationLine> stronger);

// The strongest line far below the cycle, with the channel that shows it best.
std::optional<SlowOscillation> SlowBeside(const Record& record,
                                          std::span<const OscillationLine> lines, double cycle_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_STRONG_LINES_H_
