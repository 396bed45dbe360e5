// A point's loop as its record shows it, in units of the rig, each value with its error:
//
//   R(s) = sum_k (N_k s + B_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
//
// N as in the paper's (5a), B what a probe elsewhere or a mean flow adds to it.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_FITTED_LOOP_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_FITTED_LOOP_H_

#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "estimation/joint_records/small_signal_loop.h"

namespace howl {

struct FittedMode {
  Estimate omega_hz;
  Estimate xi;
  Estimate N;  // units of p per unit of q, times rad/s
  Estimate B;  // the same
};

// One-sided spectrum of a source of noise: of p squared or q squared a Hz, at the source.
struct FittedNoise {
  LoopNoise source = LoopNoise::kCombustion;
  std::vector<double> frequency_hz;
  std::vector<double> psd;
  std::vector<double> log_std;  // of ln psd
  // Of a background: p over q at which both show it.
  std::optional<Estimate> ratio;
};

// What a cut misses of the cycle's line at a multiple of its frequency, relative to what it
// foretells.
struct FittedLineError {
  int multiple = 1;
  Estimate real;
  Estimate imaginary;

  double Size() const { return std::hypot(real.value, imaginary.value); }
};

// Another delay at which this record by itself has a maximum (delay_maxima.h).
struct OtherDelay {
  double tau_s = 0.0;
  double nats_below = 0.0;
};

// A share of the flame that answers later (flame_path.h).
struct FittedSecondPath {
  Estimate share;
  Estimate extra_s;
};

struct FittedLoop {
  double cycle_hz = 0.0;          // about which the band lies
  std::complex<double> transfer;  // R at the cycle
  std::vector<FittedMode> modes;  // by frequency
  Estimate tau_s;
  // Standard deviation of the delays over their mean; 0: not spread.
  Estimate delay_spread;
  std::optional<FittedSecondPath> second_path;
  std::vector<FittedLineError> acoustic_lines;
  std::vector<FittedLineError> flame_lines;
  SmallSignalLoop small_signal;
  std::vector<FittedNoise> noise;
  bool converged = false;
};

FittedLoop FittedLoopOf(const RecordSpectra& record, const PointStructure& structure,
                        const PointFit& fit);

// The most likely first. Each takes a fit: seconds of work, where the loop above takes none. Of
// `law`, the point's prior by all points, the size of the model's errors alone is taken: it is the
// rig's, and a record that has any other delay has them no larger.
std::vector<OtherDelay> OtherDelaysOf(const RecordSpectra& record, const PointStructure& structure,
                                      const PointFit& fit, const PointPrior& law);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_FITTED_LOOP_H_
