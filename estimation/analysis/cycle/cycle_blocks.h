// What the complex amplitudes of a record's blocks say of a cycle: ratio of p to q, envelope,
// phase. characteristics.h has the equations.
#ifndef HOWL_ESTIMATION_ANALYSIS_CYCLE_CYCLE_BLOCKS_H_
#define HOWL_ESTIMATION_ANALYSIS_CYCLE_CYCLE_BLOCKS_H_

#include <complex>
#include <span>
#include <utility>
#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

using BlockAmplitudes = std::vector<std::complex<double>>;

double MeanSquare(const BlockAmplitudes& z);

// The incoherent share of the floor next to the peak: the median incoherent power of p over its
// median power, over the bins of the floor's running median outside the peak's main lobe. With nu
// averages a coherence of zero comes out as 1 / nu, which is corrected for.
double IncoherentShare(const CrossSpectrum& spectrum, double frequency_hz);

// The phase of the cycle from p's fundamental, improved by every other component that is locked to
// it: component h of a channel has h times the fundamental's phase plus a constant.
void ImprovePhase(std::span<const std::pair<int, BlockAmplitudes>> others,
                  std::vector<double>& phase);

// Gain, phase and coherence of p over q.
void EstimateRatio(const BlockAmplitudes& p, const BlockAmplitudes& q, Characteristics* result);

// Envelope statistics, with the noise floor's share of the blocks' power taken out:
// E|s+n|^4 = E|s|^4 + 4 E|s|^2 v + 2 v^2 for circular noise of power v.
void EstimateEnvelope(const BlockAmplitudes& p, double hop_s, Characteristics* result);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_CYCLE_CYCLE_BLOCKS_H_
