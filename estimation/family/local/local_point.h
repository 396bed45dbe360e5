// The natural parameters at an experiment's coordinates
// (estimation/family/local/local_coordinates.h). With theta = arg G, t = tan(-theta) and w = 2 pi
// f,
//
//   w tau = 3 pi / 2 + theta - loop phase error + 2 pi delay_periods,
//
// which gives tau, or with a shared tau the error; and, with one mode, omega and N of
// estimation/analysis/loop/closed_form.h. With two, N and M follow from omega by
// estimation/fit/two_mode_solve.h: omega is a coordinate, or where the experiments share the second
// mode the root next to where the last one was.
//
// T is double, or LocalJet: the derivatives with respect to the experiment's coordinates.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_POINT_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_POINT_H_

#include <ceres/jet.h>

#include <array>
#include <cstddef>
#include <vector>

#include "estimation/family/local/local_coordinates.h"

namespace howl {

using LocalJet = ceres::Jet<double, kLocals>;

template <typename T>
struct LocalPoint {
  T ln_omega, ln_xi, ln_N, ln_M, tau_s;
  T loop_phase_rad;             // its error
  T above, below;               // y - xi t and xi t - y_r: positive where M and N are
  std::vector<T> line_rad;      // loop phase errors
  std::vector<T> ln_line_gain;  // of |L Phi'(0)|, where the test looks at it
  T second_mode_share;          // with two modes
};

// False where there is no such model. `omega_hz` starts the search for the root and is left there.
template <typename T>
bool BuildLocalPoint(const LocalCoordinates& c, std::size_t experiment,
                     const std::array<double, kLocals>& u, double& omega_hz, LocalPoint<T>& point);

extern template bool BuildLocalPoint(const LocalCoordinates&, std::size_t,
                                     const std::array<double, kLocals>&, double&,
                                     LocalPoint<double>&);
extern template bool BuildLocalPoint(const LocalCoordinates&, std::size_t,
                                     const std::array<double, kLocals>&, double&,
                                     LocalPoint<LocalJet>&);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_POINT_H_
