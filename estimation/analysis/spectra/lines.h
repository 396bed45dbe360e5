// Significant spectral lines of p and q (the paper, section 4 and figure 10): harmonics of the
// limit cycle and non-harmonic ones.
//
// A line is a local maximum of p's or q's Welch spectrum (2 nu degrees of freedom, chi-square)
// above the noise floor, a running median, by more than the quantile at 1 - alpha / bins: alpha is
// the chance of any false line in a record of noise alone. It must stand out of the skirt of a
// stronger neighbour by the same measure. Its width, the window's own taken out, tells a line from
// a resonance that noise excites; both are listed.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_LINES_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_LINES_H_

#include <span>
#include <vector>

#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/spectra/spectrum.h"
#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct SpectralLine {
  Estimate frequency_hz;
  int harmonic = 0;                               // 1: the fundamental; 0: not a multiple of it
  double p_amplitude = 0.0, q_amplitude = 0.0;    // above the floor; zero where nothing stands out
  double p_over_floor = 0.0, q_over_floor = 0.0;  // peak of the spectrum over the floor
  double p_log10_p_value = 0.0, q_log10_p_value = 0.0;  // of one bin; by chi-square
  double width_hz = 0.0;       // full width at half maximum, the window's taken out
  double resolution_hz = 0.0;  // widths below this are not told from zero
  double coherence = 0.0;      // of p and q at the peak; zero without q
  Estimate phase_deg;          // of p behind q at the peak, as G's; no number without q
  bool narrow = true;          // a line; else a resonance or noise band
};

struct LineOptions {
  double false_alarm = 0.01;      // alpha, for each channel of a record
  double max_width = 0.05;        // of a line, relative to its frequency
  double min_frequency_hz = 0.0;  // 0: a 44th of the fundamental; without one at most 5 Hz
};

// The lines, sorted by their height over the floor. fundamental_hz = 0: none is known.
std::vector<SpectralLine> FindLines(const Record& record, const CrossSpectrum& spectrum,
                                    double fundamental_hz, const LineOptions& options = {});

// Running median over 61 bins (fewer in short spectra), scaled to the mean of a spectrum with 2 nu
// degrees of freedom.
std::vector<double> NoiseFloor(std::span<const double> spectrum, double nu);

// The ratio to the floor that noise exceeds in any of `bins` bins with probability alpha.
double PeakThreshold(double nu, int bins, double alpha);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_LINES_H_
