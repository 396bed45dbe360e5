// Which lines of a record are taken out before one of its oscillations is characterised.
#ifndef HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_NOTCHES_BESIDE_H_
#define HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_NOTCHES_BESIDE_H_

#include <span>
#include <vector>

#include "estimation/analysis/oscillations/notch.h"
#include "estimation/analysis/oscillations/strong_lines.h"

namespace howl {

// In which the blocks of an oscillation beside others come to the coherence of its phase.
inline constexpr int kBlockPassesBesideOthers = 8;

// Notches for all lines but the cycle itself, its multiples and the sidebands of its modulation by
// slow_hz; 0: there is none.
std::vector<Notch> NotchesBeside(std::span<const OscillationLine> lines, double cycle_hz,
                                 double slow_hz, double duration_s);

// Notches for the lines outside a range, each as wide as leaves the range's middle alone.
std::vector<Notch> NotchesOutside(std::span<const OscillationLine> lines, double low_hz,
                                  double high_hz, double duration_s);

// The length of blocks in which every notched oscillation lies beyond the main lobe, in seconds.
double BlockApart(std::span<const Notch> notches, double cycle_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_NOTCHES_BESIDE_H_
