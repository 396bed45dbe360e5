// One experiment's member in the full form (5a). With x = omega / f, w = 2 pi f, theta = arg z,
// t = tan(-theta), y = sinh(-ln x), y_r = sinh(-ln(r x)), splitting z = N U_1 + M U_r along and
// across the direction of z gives
//
//   M = 2 r x w |z| cos(theta) (y - xi t) (xi^2 + y_r^2) / (xi (y - y_r))
//   N = 2   x w |z| cos(theta) (xi t - y_r) (xi^2 + y^2) / (xi (y - y_r))
//
// so that (omega, xi, theta, |z|) give M and N without a search, and N, M >= 0 exactly where
// y_r <= xi t <= y: omega lies between the one-mode solution and its r-th part. With M (or M / N)
// given instead, omega is a root of the first equation (or of the ratio of the two). There may be
// several: next to the one-mode solution the first mode carries the fundamental, next to its r-th
// part the second mode does. Units: Hz, rad, N and M as in model/loop/acoustics.h.
#ifndef HOWL_ESTIMATION_FIT_TWO_MODE_SOLVE_H_
#define HOWL_ESTIMATION_FIT_TWO_MODE_SOLVE_H_

#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <array>
#include <cmath>

#include "estimation/analysis/loop/closed_form.h"
#include "model/loop/loop.h"

namespace howl {

struct ModeCoefficients {
  double N = 0.0;
  double M = 0.0;
};

inline ModeCoefficients CoefficientsFromResponse(double frequency_hz, double omega_hz, double xi,
                                                 double harmonic_ratio, double phase_rad,
                                                 double gain) {
  const double x = omega_hz / frequency_hz;
  const double y = Detuning(frequency_hz, omega_hz);
  const double y_r = Detuning(frequency_hz, harmonic_ratio * omega_hz);
  const double across = xi * std::tan(-phase_rad);
  const double scale =
      2.0 * x * kRadPerSPerHz * frequency_hz * gain * std::cos(phase_rad) / (xi * (y - y_r));
  return {scale * (across - y_r) * (xi * xi + y * y),
          scale * harmonic_ratio * (y - across) * (xi * xi + y_r * y_r)};
}

// The quantity that is held while (omega, N) are solved for: M itself, or M / N.
enum class HeldSecond { kM, kMOverN };

// The equation whose roots in omega are the solutions, free of poles.
struct TwoModeEquation {
  double frequency_hz;
  double xi;
  double harmonic_ratio;
  double tangent;  // t
  double scale;    // w |z| cos(theta)
  HeldSecond held;
  double second;  // M or M / N

  double operator()(double omega_hz) const {
    const double y = Detuning(frequency_hz, omega_hz);
    const double y_r = Detuning(frequency_hz, harmonic_ratio * omega_hz);
    const double across = xi * tangent;
    if (held == HeldSecond::kMOverN) {
      return harmonic_ratio * (y - across) * (xi * xi + y_r * y_r) -
             second * (across - y_r) * (xi * xi + y * y);
    }
    const double x = omega_hz / frequency_hz;
    return 2.0 * harmonic_ratio * x * scale * (y - across) * (xi * xi + y_r * y_r) -
           second * xi * (y - y_r);
  }
};

inline TwoModeEquation MakeTwoModeEquation(double frequency_hz, double xi, double harmonic_ratio,
                                           double phase_rad, double gain, HeldSecond held,
                                           double second) {
  return {frequency_hz,
          xi,
          harmonic_ratio,
          std::tan(-phase_rad),
          kRadPerSPerHz * frequency_hz * gain * std::cos(phase_rad),
          held,
          second};
}

// Roots of a continuous function on [lo, hi] that a grid of kCells separates, smallest first.
// Illinois' variant of the false position: the bracket is never lost.
template <int kMaxRoots, typename Function>
int FindRoots(const Function& function, double lo, double hi, int cells,
              std::array<double, kMaxRoots>& roots) {
  int count = 0;
  const double ratio = std::pow(hi / lo, 1.0 / cells);
  double left = lo;
  double f_left = function(left);
  for (int cell = 0; cell < cells && count < kMaxRoots; ++cell) {
    const double right = cell + 1 == cells ? hi : left * ratio;
    const double f_right = function(right);
    if ((f_left <= 0.0) != (f_right <= 0.0)) {
      double a = left, b = right, fa = f_left, fb = f_right;
      for (int iteration = 0; iteration < 60 && b - a > 4e-16 * b; ++iteration) {
        double c = (a * fb - b * fa) / (fb - fa);
        if (!(c > a && c < b)) c = 0.5 * (a + b);
        const double fc = function(c);
        if (fc == 0.0) {
          a = b = c;
        } else if ((fc <= 0.0) == (fa <= 0.0)) {
          a = c;
          fa = fc;
          fb *= 0.5;
        } else {
          b = c;
          fb = fc;
          fa *= 0.5;
        }
      }
      roots[static_cast<std::size_t>(count++)] = 0.5 * (a + b);
    }
    left = right;
    f_left = f_right;
  }
  return count;
}

// Residual of (5a) for TinySolver: gain and phase of G against the wanted response, in (ln omega,
// ln N).
struct TwoModeResidual {
  Complex<double> wanted;
  double frequency_hz, xi, harmonic_ratio, second;
  HeldSecond held;

  template <typename T>
  bool operator()(const T* const unknowns, T* residuals) const {
    using std::exp;
    const T N = exp(unknowns[1]);
    const Acoustics<T> acoustics{exp(unknowns[0]), T(xi), N,
                                 held == HeldSecond::kM ? T(second) : T(second) * N,
                                 T(harmonic_ratio)};
    const Complex<T> ratio =
        AcousticResponse(acoustics, T(frequency_hz)) / Complex<T>{T(wanted.re), T(wanted.im)};
    residuals[0] = ratio.re - T(1.0);
    residuals[1] = ratio.im;
    return true;
  }
};

// The member on the branch next to the one-mode solution; false where the search does not converge
// (there may be no such member). Starts from the closed form, tau from the loop phase exactly.
inline bool SolveTwoMode(const Experiment& experiment, double xi, double harmonic_ratio,
                         HeldSecond held, double second, const FitErrors& errors,
                         LoopModel& model) {
  model = ClosedFormMember(experiment, xi, errors);
  model.harmonic_ratio = harmonic_ratio;
  const double phase_rad = (experiment.phase_deg + errors.phase_error_deg) * kRadPerDeg;
  const double gain = experiment.gain * (1.0 + errors.gain_error);
  const TwoModeResidual residual{
      gain * UnitPhasor(phase_rad), experiment.frequency_hz, xi, harmonic_ratio, second, held};
  using Function = ceres::TinySolverAutoDiffFunction<TwoModeResidual, 2, 2>;
  const Function function(residual);
  ceres::TinySolver<Function> solver;
  solver.options.gradient_tolerance = 1e-15;
  solver.options.parameter_tolerance = 1e-16;
  solver.options.function_tolerance = 0.0;
  solver.options.cost_threshold = 1e-26;
  Eigen::Vector2d unknowns(std::log(model.omega_hz), std::log(model.N));
  const auto& summary = solver.Solve(function, &unknowns);
  if (!(summary.final_cost < 1e-18)) return false;
  model.omega_hz = std::exp(unknowns[0]);
  model.N = std::exp(unknowns[1]);
  model.M = held == HeldSecond::kM ? second : second * model.N;
  return true;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_TWO_MODE_SOLVE_H_
