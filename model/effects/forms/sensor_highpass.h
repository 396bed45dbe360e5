// A recorded signal is the true one through a high-pass of first order, s / (s + w_c): a sensor or
// an amplifier that is coupled through a capacitor.
#ifndef HOWL_MODEL_EFFECTS_FORMS_SENSOR_HIGHPASS_H_
#define HOWL_MODEL_EFFECTS_FORMS_SENSOR_HIGHPASS_H_

#include <memory>
#include <string>
#include <utility>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {

// Twice the cycle of the rig for which the catalogue was made: what is coupled so low that little
// of its cycle is left is no sensor.
inline constexpr double kMostCutoff_hz = 420.0;

class SensorHighPass final : public NamedEffect {
 public:
  SensorHighPass(std::string id, Channel channel)
      : NamedEffect(std::move(id),
                    channel == Channel::kPressure ? LoopBlock::kPressureInstrument
                                                  : LoopBlock::kHeatReleaseInstrument,
                    {{"cutoff_hz", "Hz", 0.0, 0.0, kMostCutoff_hz, {5.0, 20.0, 60.0}}}),
        channel_(channel) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  bool ChangesFlameInput() const override { return channel_ == Channel::kPressure; }
  Response PressureInstrument(double frequency_hz, EffectValues x) const override {
    return channel_ == Channel::kPressure ? At(frequency_hz, x) : 1.0;
  }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    return channel_ == Channel::kHeatRelease ? At(frequency_hz, x) : 1.0;
  }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    rig->instruments.push_back(std::make_shared<FirstOrderHighPass>(channel_, x[0]));
    return true;
  }

 private:
  static Response At(double frequency_hz, EffectValues x) {
    if (x[0] == 0.0) return 1.0;
    return Response(0.0, frequency_hz) / Response(x[0], frequency_hz);
  }

  Channel channel_;
};

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_FORMS_SENSOR_HIGHPASS_H_
