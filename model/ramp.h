// A slow change of one parameter within a run (figure 7's axis, crossed while recording):
//
//   value(t) = own value * factor(t),   factor: first until start_s, last from end_s, linear
//   between
//
// The delay moves from sample to sample, the others from block to block of the simulator.
#ifndef HOWL_MODEL_RAMP_H_
#define HOWL_MODEL_RAMP_H_

#include <cstdint>
#include <memory>

#include "model/loop_effect.h"

namespace howl {

enum class RampedParameter : std::uint8_t {
  kOmega,
  kXi,
  kN,
  kM,
  kHarmonicRatio,
  kTau,
  kFlameSlope,
  kFlameSaturation
};

class ParameterRamp final : public LoopEffect {
 public:
  ParameterRamp(RampedParameter parameter, double first_factor, double last_factor, double start_s,
                double end_s)
      : parameter_(parameter),
        first_(first_factor),
        last_(last_factor),
        start_s_(start_s),
        end_s_(end_s) {}

  std::unique_ptr<LoopEffect> Clone() const override;
  void Parameters(const LoopContext& at, LoopParameters<double>* loop,
                  Flame<double>* flame) override;
  bool MovesDelay() const override { return parameter_ == RampedParameter::kTau; }
  void Delay(const LoopContext& at, std::span<double> tau_s) override;

 private:
  double Factor(double time_s) const;

  RampedParameter parameter_;
  double first_;
  double last_;
  double start_s_;
  double end_s_;
};

}  // namespace howl

#endif  // HOWL_MODEL_RAMP_H_
