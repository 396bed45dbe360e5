// The delayed derivative of pressure that drives the flame, rebuilt from a record: the regressor of
// flame_curve.h.
//
//   x(t) = Re sum_k j k w P_k(t - tau),      w = 2 pi f,   k = 1: the paper's (4)
//
// P_1 is p's fundamental, joined from its blocks (spectrum.h) so that it follows a wandering phase.
// P_k, k > 1, are the harmonics that are locked to it, P_k = m_k (P_1 / |P_1|)^k with m_k their
// coherent mean over the blocks. The paper leaves them out, because its q lacks them. Where they
// act on the flame they matter: a third harmonic of 3 % changes the slope at zero by 9 %.
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_REGRESSOR_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_REGRESSOR_H_

#include <complex>
#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

class FlameRegressor {
 public:
  // Uses the harmonics up to `max_harmonic` that exceed their own scatter and lie below 0.4 of the
  // sampling rate.
  FlameRegressor(const Record& record, const Characteristics& cycle, double tau_s,
                 int max_harmonic);

  // The same regressor with another delay, near to the first, for the same samples.
  FlameRegressor Delayed(double tau_s) const {
    FlameRegressor other = *this;
    other.tau_s_ = tau_s;
    return other;
  }

  // Samples [first, last) of the record have a regressor.
  double tau_s() const { return tau_s_; }
  int first() const { return first_; }
  int last() const { return last_; }
  int block_samples() const { return block_samples_; }
  int locked_harmonics() const { return static_cast<int>(locked_.size()); }  // beyond the first
  // The relative error of the slope at zero that the harmonics leave: the k-th, of amplitude |m_k|
  // relative to the first, changes the slope by k^2 |m_k| where it counts, and each m_k, locked or
  // not, is known to an error.
  double harmonic_slope_variance() const { return harmonic_slope_variance_; }

  // j w P_1(t - tau): the real part is (4).
  std::complex<double> Fundamental(int sample) const;
  // The part of x that the locked harmonics add, given Fundamental(sample).
  double Harmonics(const std::complex<double>& fundamental) const;

 private:
  struct LockedHarmonic {
    int order = 0;
    std::complex<double> rate;  // j k w m_k, turned to the phase of j w P_1
  };

  Blocks blocks_;
  std::vector<LockedHarmonic> locked_;
  double frequency_hz_ = 0.0;
  double sampling_hz_ = 0.0;
  double tau_s_ = 0.0;
  double harmonic_slope_variance_ = 0.0;
  int block_samples_ = 0;
  int first_ = 0;
  int last_ = 0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_FLAME_REGRESSOR_H_
