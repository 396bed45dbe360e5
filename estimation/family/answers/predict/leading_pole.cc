#include "estimation/family/answers/predict/leading_pole.h"

#include <cmath>
#include <complex>

#include "estimation/family/answers/predict/oscillation_pole.h"
#include "model/loop/crossings.h"
#include "model/loop/laplace.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

// The root that starts at a mode's own pole, s = -xi w + j w sqrt(1 - xi^2), as the slope grows
// from nothing to k: there 1 / L = k is well-behaved, and Newton takes it from step to step. No
// value where it fails, or ends on the real axis.
std::optional<Pole> AcousticPole(const LoopParameters<double>& loop, double mode_hz,
                                 double flame_slope) {
  constexpr double kFirst = 1e-3;  // of k
  constexpr int kSlopes = 30;
  constexpr int kIterations = 30;
  const double w = kRadPerSPerHz * mode_hz;
  const double xi = loop.acoustics.xi;
  if (!(xi < 1.0)) return std::nullopt;
  const std::complex<double> rest(-xi * w, w * std::sqrt(1.0 - xi * xi));
  // Next to it L is its residue over the distance.
  const std::complex<double> near = rest + std::complex<double>(1e-6 * w, 0.0);
  const std::complex<double> residue = LoopTransfer(loop, near).value * (near - rest);
  std::complex<double> s = rest + kFirst * flame_slope * residue;
  for (int step = 0; step <= kSlopes; ++step) {
    const double slope = flame_slope * std::pow(kFirst, 1.0 - static_cast<double>(step) / kSlopes);
    bool converged = false;
    for (int iteration = 0; iteration < kIterations && !converged; ++iteration) {
      const ModeTransfer at = LoopTransfer(loop, s);
      // Of 1 / L - k, which is nearly linear in s around the mode's pole.
      const std::complex<double> ds = at.value * (1.0 - slope * at.value) / at.derivative;
      s += ds;
      converged = std::abs(ds) <= 1e-12 * std::abs(s);
    }
    if (!converged || !(s.imag() > 0.0)) return std::nullopt;
  }
  return Pole{s.real(), s.imag() / kRadPerSPerHz};
}

}  // namespace

std::optional<Pole> LeadingPole(const LoopParameters<double>& loop, double flame_slope) {
  constexpr double kReach = 3.0;  // of the last mode's natural frequency
  const Acoustics<double>& acoustics = loop.acoustics;
  const bool two_modes = acoustics.M > 0.0;
  const double last_hz = acoustics.omega_hz * (two_modes ? acoustics.harmonic_ratio : 1.0);
  std::optional<Pole> leading;
  const auto consider = [&](const std::optional<Pole>& pole) {
    if (pole && (!leading || pole->growth_rate > leading->growth_rate)) leading = pole;
  };
  for (const PhaseCrossing& crossing : PhaseCrossings(loop, flame_slope, kReach * last_hz)) {
    consider(OscillationPole(loop, flame_slope, crossing.frequency_hz));
  }
  if (leading && leading->growth_rate > 0.0) return leading;
  consider(AcousticPole(loop, acoustics.omega_hz, flame_slope));
  if (two_modes) consider(AcousticPole(loop, last_hz, flame_slope));
  return leading;
}

}  // namespace howl
