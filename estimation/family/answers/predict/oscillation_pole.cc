#include "estimation/family/answers/predict/oscillation_pole.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "model/loop/laplace.h"
#include "model/numerics/units.h"

namespace howl {

std::optional<Pole> OscillationPole(const LoopParameters<double>& loop, double flame_slope,
                                    double crossing_hz) {
  constexpr double kStep = 0.05;  // of ln k
  constexpr double kLongest = 7.0;
  constexpr int kIterations = 20;
  std::complex<double> s(0.0, kRadPerSPerHz * crossing_hz);
  const double start = -std::log(std::abs(LoopTransfer(loop, s).value));
  const double way = std::log(std::abs(flame_slope)) - start;
  if (!(std::abs(way) <= kLongest)) return std::nullopt;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(way) / kStep)));
  for (int step = 1; step <= steps; ++step) {
    const ModeTransfer here = LoopTransfer(loop, s);
    s -= way / steps * here.value / here.derivative;
    const double slope = -std::exp(start + way * step / steps);
    bool converged = false;
    for (int iteration = 0; iteration < kIterations && !converged; ++iteration) {
      const ModeTransfer at = LoopTransfer(loop, s);
      const std::complex<double> ds = (1.0 - slope * at.value) / (slope * at.derivative);
      s += ds;
      converged = std::abs(ds) <= 1e-12 * std::abs(s);
    }
    if (!converged || !(s.imag() > 0.0)) return std::nullopt;
  }
  return Pole{s.real(), s.imag() / kRadPerSPerHz};
}

}  // namespace howl
