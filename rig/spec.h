// What the user asks for: a YAML file.
//
//   experiments:                     characteristics that the rig is to have
//     - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}
//   effects: [{id: q_sensor_lowpass, severity: medium}]   or with parameters: {cutoff_hz: 300}
//   seed: 1
//   duration_s: 3.2
//   sampling_hz: 5000
//   settle_s: 1.0
//   scatter: true                    draw rigs like this one; false: this one
//   flame: any                       or a shape's name
//   refine: 1                        grid steps over the usual number
//   operating_parameter: phi         its name in the config that is written
//   noise: {combustion_relative: 0.06, sensor_relative: 0.004}
#ifndef HOWL_RIG_SPEC_H_
#define HOWL_RIG_SPEC_H_

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rig/effects.h"
#include "rig/flame.h"

namespace rig {

// One line: file:line: key: what is wrong, what was expected.
class SpecError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Characteristics {
  std::string name;
  double phi = 0.0;
  double frequency_hz = 200.0;
  std::optional<double> phase_deg;  // q to p
  double gain = 10.0;               // p over q at the cycle
};

struct EffectRequest {
  std::string id;
  double severity = 0.55;
  std::optional<Parameters> parameters;  // drawn where absent
};

struct Spec {
  std::vector<Characteristics> experiments;
  std::vector<EffectRequest> effects;
  std::uint64_t seed = 1;
  double duration_s = 3.2;
  double sampling_hz = 5000.0;
  double settle_s = 1.0;
  bool scatter = true;
  std::optional<FlameShape> flame;
  int refine = 1;
  std::string operating_parameter = "phi";
  // rms over the flame's saturation and over the cycle's amplitude; drawn where absent.
  std::optional<double> combustion_noise;
  std::optional<double> sensor_noise;
};

Spec LoadSpec(const std::string& path);

}  // namespace rig

#endif  // HOWL_RIG_SPEC_H_
