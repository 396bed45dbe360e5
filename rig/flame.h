// The flame without memory: heat release against the delayed rate of change of pressure,
// Phi(v) = Q sigma(k v / Q), sigma(0) = 0, sigma'(0) = 1. Saturates at about Q.
#ifndef HOWL_RIG_FLAME_H_
#define HOWL_RIG_FLAME_H_

#include <cstdint>
#include <string>
#include <vector>

namespace rig {

enum class FlameShape : std::uint8_t {
  kTanh,
  kArctan,     // (2 / pi) arctan(pi x / 2)
  kErf,        // erf(sqrt(pi) x / 2)
  kRational,   // x (27 + x^2) / (27 + 9 x^2) up to |x| = 3
  kAsymmetric  // (tanh(x + b) - tanh(b)) / (1 - tanh(b)^2), b = 0.25
};

const std::vector<std::string>& FlameShapeNames();  // in the order of the shapes

struct Flame {
  FlameShape shape = FlameShape::kTanh;
  double slope = -1.0;      // k, units of q / (units of p / s)
  double saturation = 1.0;  // Q, units of q

  double operator()(double v) const;
  // Gain of the fundamental at amplitude A of v, in units of the slope.
  double RelativeGain(double amplitude) const;
  // The amplitude at which RelativeGain is `gain`, below one.
  double AmplitudeAt(double gain) const;
};

}  // namespace rig

#endif  // HOWL_RIG_FLAME_H_
