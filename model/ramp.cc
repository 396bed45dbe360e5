#include "model/ramp.h"

#include <algorithm>

namespace howl {

std::unique_ptr<LoopEffect> ParameterRamp::Clone() const {
  return std::make_unique<ParameterRamp>(*this);
}

double ParameterRamp::Factor(double time_s) const {
  const double share = std::clamp((time_s - start_s_) / (end_s_ - start_s_), 0.0, 1.0);
  return first_ + share * (last_ - first_);
}

void ParameterRamp::Parameters(const LoopContext& at, LoopParameters<double>* loop,
                               Flame<double>* flame) {
  const double factor = Factor(at.time_s + 0.5 * kLoopBlock * at.step_s);
  switch (parameter_) {
    case RampedParameter::kOmega:
      loop->acoustics.omega_hz *= factor;
      break;
    case RampedParameter::kXi:
      loop->acoustics.xi *= factor;
      break;
    case RampedParameter::kN:
      loop->acoustics.N *= factor;
      break;
    case RampedParameter::kM:
      loop->acoustics.M *= factor;
      break;
    case RampedParameter::kHarmonicRatio:
      loop->acoustics.harmonic_ratio *= factor;
      break;
    case RampedParameter::kTau:
      break;
    case RampedParameter::kFlameSlope:
      flame->slope *= factor;
      break;
    case RampedParameter::kFlameSaturation:
      flame->saturation *= factor;
      break;
  }
}

void ParameterRamp::Delay(const LoopContext& at, std::span<double> tau_s) {
  for (std::size_t i = 0; i < tau_s.size(); ++i) {
    tau_s[i] *= Factor(at.time_s + static_cast<double>(i) * at.step_s);
  }
}

}  // namespace howl
