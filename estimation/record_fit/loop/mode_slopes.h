// What each parameter of a mode moves (loop_point.h). Inner workings.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SLOPES_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SLOPES_H_

#include <Eigen/Core>
#include <complex>

#include "estimation/record_fit/loop/loop_point.h"
#include "model/numerics/complex_products.h"

namespace howl {

// Calls `take` with the index of each parameter that moves mode k, dR and dT by it at s, T being
// what the record's ends leave.
template <typename Take>
void ForEachSlope(const PointStructure& structure, const LoopPoint& point, Eigen::Index k,
                  std::complex<double> s, const Take& take) {
  using Value = std::complex<double>;
  const LoopMode& mode = point.modes[static_cast<std::size_t>(k)];
  const Eigen::Index dampings = structure.Frequencies();
  const Eigen::Index residues = dampings + structure.Dampings();
  const Eigen::Index transients = structure.Transfer();
  const double omega = mode.omega;
  const Value damped = 2.0 * mode.xi * omega * s;
  const Value over = Reciprocal(Times(s, s) + damped + omega * omega);
  const Value r_over = Times(Times(mode.a * s + mode.b * omega, over), over);
  const Value t_over = Times(Times(mode.g * s + mode.h * omega, over), over);
  const Value by_omega = damped + 2.0 * omega * omega;
  take(structure.Frequency(k), mode.b * omega * over - Times(r_over, by_omega),
       mode.h * omega * over - Times(t_over, by_omega));
  take(dampings + structure.Damping(k), -Times(r_over, damped), -Times(t_over, damped));
  const Value by_rate = Times(s, over);
  const Value by_level = omega * over;
  take(residues + k, by_rate, Value(0.0));
  if (structure.complex_residues) take(residues + structure.modes + k, by_level, Value(0.0));
  take(transients + k, Value(0.0), by_rate);
  take(transients + structure.modes + k, Value(0.0), by_level);
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_MODE_SLOPES_H_
