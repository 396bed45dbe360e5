#include "model/cycles/prediction.h"

#include <algorithm>

namespace howl {

int LoopPrediction::attracting_cycles() const {
  return static_cast<int>(std::count_if(cycles.begin(), cycles.end(),
                                        [](const PredictedCycle& c) { return c.floquet.stable; }));
}

LoopPrediction PredictLoop(const ClosedLoop& model, double frequency_max) {
  const double slope = FlameSlope(model.flame, 0.0);
  LoopPrediction prediction;
  const double frequency_max_hz = frequency_max * model.loop.acoustics.omega_hz;
  prediction.crossings = PhaseCrossings(model.loop, slope, frequency_max_hz);
  prediction.margins = Margins(model.loop, slope, frequency_max_hz);
  PoleOptions options;
  options.frequency_max = frequency_max;
  prediction.poles = ClosedLoopPoles(model.loop, slope, options);
  for (LimitCycle& cycle : LimitCycles(model, frequency_max_hz)) {
    FloquetMultipliers floquet = CycleStability(model, cycle);
    prediction.cycles.push_back({std::move(cycle), std::move(floquet)});
  }
  return prediction;
}

NoiseTransfer NoiseTransferAt(const ClosedLoop& model, double frequency_hz) {
  const std::complex<double> s(0.0, kRadPerSPerHz * frequency_hz);
  const std::complex<double> closed =
      1.0 / (1.0 - FlameSlope(model.flame, 0.0) * LoopTransfer(model.loop, s).value);
  return {RateTransfer(model.loop.acoustics, s) / s * closed, closed};
}

}  // namespace howl
