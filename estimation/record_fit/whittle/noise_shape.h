// The spectra of sources, ln S_j = ln w + sum over k of c_k b_k, where the b_k are smooth but of
// hum, and w is the factor by which a spectrum differs from a smooth one. Hum stands at multiples
// of the mains' frequency alone, as many from the band's lower end on as its coefficients after the
// first, as the taper spreads each:
//
//   w(f) = sum over n of 1 / max(1, (4 d_n^2 - 1)^2),   d_n: bins from n times the mains' frequency
//
// or for a tone over n = 1 alone: the bound of a line's power under a sine taper (Thomson 1982;
// Riedel & Sidorenko 1995). Of hum b_0 = 1, and b_k = 1 nearest to its k-th multiple: no law says
// how the powers of multiples go together (of a rectifier's, the odd ones stand alone). One that
// meets a line of the cycle beats with it, and stands there as anywhere.
//
// A gain that fluctuates about its mean, and forgets exponentially, moves what each of the cycle's
// lines Q_h holds to its sides (as does one that jumps between two values at random times):
//
//   w(f) = sum over h of |k_h Q_h|^2 g / (g^2 + (f - h f_c)^2),   g = f_c / (2 pi memory),
//
// with 1 as its mean over the band. Of a gain behind the flame's curve k is one, of a gain of what
// drives it the curve's exponent (curve_exponents.h). Noise and hum that come in behind an
// instrument which was taken out of the record have 1 / |H|^2 of it as well. Of all other sources w
// is one.
//
// Errors of samples in the place of lost ones of p add to p's sensor at each bin what is known of
// them, and hang on no coefficient: d ln S / d c_k is b_k times the coefficients' share of S there.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_SHAPE_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_SHAPE_H_

#include <Eigen/Core>

#include "estimation/record_fit/spectra/record_spectra.h"
#include "estimation/record_fit/whittle/noise_sources.h"

namespace howl {

// w at the record's bins.
Eigen::VectorXd NoiseShape(const NoiseTerm& term, const RecordSpectra& record);

// b_k at the record's bins, one column each.
Eigen::MatrixXd LogSpectrumColumns(const NoiseTerm& term, const RecordSpectra& record);

// What a gain that moves by one moves q by, over q.
double AnswerToGain(const NoiseTerm& gain, const RecordSpectra& record);

// The power of those errors at the record's bins, where they add to this source; empty where they
// add nothing.
Eigen::VectorXd LostPower(const NoiseTerm& term, const RecordSpectra& record);

// S_j at the record's bins, without that.
Eigen::VectorXd NoiseSpectrum(const NoiseTerm& term, const RecordSpectra& record,
                              const Eigen::VectorXd& coefficients);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_SHAPE_H_
