// The part of a cycle's envelope that goes with a slow oscillation of the same record, such as one
// of the air supply at 5 to 20 Hz. With theta(t) the phase of the slow one and A_b the cycle's
// amplitude in block b, least squares of
//
//   A_b^2 = m_0 + sum_k (a_k cos k theta_b + b_k sin k theta_b) + rest,   k = 1 .. 3
//
// gives M_b, the periodic part. Its variance over its squared mean, free of what the same
// regression finds in a rest that has nothing to do with theta, is the modulation's share F_M. A
// cycle that a slow oscillation modulates stays a cycle, whatever F_M.
//
// The same regression of the phase's steps from block to block, each weighted by its power, gives
// the part of the phase that swings with theta. It is taken out before the frequency is estimated:
// where amplitude and phase swing together, the mean frequency that power weighs is not the
// cycle's.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_SLOW_MODULATION_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_SLOW_MODULATION_H_

#include <span>
#include <vector>

#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

struct SlowOscillation {
  double frequency_hz = 0.0;
  std::vector<double> samples;  // mean-free, of the channel that shows it best
};

// Whether blocks of this length follow a modulation at the slow frequency: Hann's window leaves
// nearly two thirds of it at three quarters of a period.
inline bool Follows(double block_s, const SlowOscillation& slow) {
  return slow.frequency_hz * block_s <= 0.75;
}

// F_M of the blocks' power; zero where the blocks do not follow it.
double PeriodicFluctuation(const Blocks& cycle, const SlowOscillation& slow, double sampling_hz);

// The cycle's blocks with the samples turned back by what their phase swings with the slow one; the
// blocks as they are where they do not follow it.
Blocks WithoutPhaseSwing(std::span<const double> samples, double sampling_hz, double frequency_hz,
                         const Blocks& cycle, const SlowOscillation& slow);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_SLOW_MODULATION_H_
