// What an identified loop will do: everything that the analyses of this folder say of one loop,
// gathered for a report. Frequencies in Hz, rates in 1/s.
#ifndef HOWL_MODEL_CYCLES_PREDICTION_H_
#define HOWL_MODEL_CYCLES_PREDICTION_H_

#include <complex>
#include <vector>

#include "model/cycles/floquet.h"
#include "model/cycles/harmonic_balance.h"
#include "model/loop/crossings.h"
#include "model/loop/poles.h"

namespace howl {

struct PredictedCycle {
  LimitCycle cycle;
  FloquetMultipliers floquet;
};

struct LoopPrediction {
  std::vector<PhaseCrossing> crossings;
  LoopMargins margins;
  PoleSet poles;
  std::vector<PredictedCycle> cycles;

  bool rest_is_stable() const { return poles.poles.empty() || poles.poles[0].growth_rate < 0.0; }
  int attracting_cycles() const;
};

// Up to frequency_max, in units of omega.
LoopPrediction PredictLoop(const ClosedLoop& model,
                           double frequency_max = PoleOptions().frequency_max);

// From combustion noise n to pressure and to heat release in a loop at rest, at j 2 pi f:
// p / n = G / (1 - k L), q / n = 1 / (1 - k L), k = Phi'(0). With the noise's density S(f) the
// spectra are S |p / n|^2 and S |q / n|^2, as long as the loop is stable and the noise small.
struct NoiseTransfer {
  std::complex<double> pressure;
  std::complex<double> heat_release;
};
NoiseTransfer NoiseTransferAt(const ClosedLoop& model, double frequency_hz);

}  // namespace howl

#endif  // HOWL_MODEL_CYCLES_PREDICTION_H_
