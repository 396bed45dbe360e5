#include "estimation/family/local/local_point.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "estimation/analysis/loop/closed_form.h"
#include "model/loop/loop.h"
#include "model/loop/second_mode.h"

namespace howl {

namespace {

template <typename T>
T SinhLog(const T& ratio) {  // sinh(ln ratio)
  return 0.5 * (ratio - 1.0 / ratio);
}

double Value(double x) { return x; }
double Value(const LocalJet& x) { return x.a; }

template <typename T>
std::array<T, kLocals> Variables(const std::array<double, kLocals>& u) {
  std::array<T, kLocals> v;
  for (int k = 0; k < kLocals; ++k) {
    if constexpr (std::is_same_v<T, double>) {
      v[static_cast<std::size_t>(k)] = u[static_cast<std::size_t>(k)];
    } else {
      v[static_cast<std::size_t>(k)] = T(u[static_cast<std::size_t>(k)], k);
    }
  }
  return v;
}

// The constants of an experiment that follow from the wanted response and the damping.
template <typename T>
struct Response {
  T xi;
  T across;   // xi t
  T stretch;  // w |G| cos(theta)
  T top;      // the one-mode solution
};

// The equation of two_mode_solve.h for the shared second mode, divided by its scale.
struct Balance {
  bool relative;
  double ratio, f;

  template <typename T>
  T operator()(const T& omega, const Response<T>& response, const T& second) const {
    const T& x = response.xi;
    const T& c = response.across;
    const T y = SinhLog(f / omega);
    const T y_r = SinhLog(f / (ratio * omega));
    if (relative) {
      return ratio * (y - c) * (x * x + y_r * y_r) - second * (c - y_r) * (x * x + y * y);
    }
    return 2.0 * ratio * (omega / f) * (y - c) * (x * x + y_r * y_r) -
           second / response.stretch * x * (y - y_r);
  }
};

// Newton's method between the one-mode solution and its r-th part; `slope` is that of the last
// step.
bool FindRoot(const Balance& balance, const Response<double>& response, double second,
              double& omega_hz, double& slope) {
  using One = ceres::Jet<double, 1>;
  const double highest = response.top;
  const double ratio = balance.ratio;
  const Response<One> fixed{One(response.xi), One(response.across), One(response.stretch),
                            One(response.top)};
  double at = std::clamp(omega_hz, highest / ratio * (1 + 1e-12), highest * (1 - 1e-12));
  bool found = false;
  for (int iteration = 0; iteration < 40 && !found; ++iteration) {
    const One error = balance(One(at, 0), fixed, One(second));
    slope = error.v[0];
    double next = at - error.a / slope;
    if (!std::isfinite(next)) return false;
    if (next >= highest) next = 0.5 * (at + highest);
    if (next <= highest / ratio) next = 0.5 * (at + highest / ratio);
    found =
        std::abs(next - at) <= 2e-15 * at || (iteration > 6 && std::abs(next - at) <= 1e-13 * at);
    at = next;
  }
  if (!found) return false;
  omega_hz = at;
  return true;
}

// The root, with its derivatives by the implicit function theorem.
template <typename T>
bool OmegaOfSharedSecond(const Balance& balance, const Response<T>& response, const T& second,
                         double& omega_hz, T& omega) {
  const Response<double> value{Value(response.xi), Value(response.across), Value(response.stretch),
                               Value(response.top)};
  double slope = 0.0;
  if (!FindRoot(balance, value, Value(second), omega_hz, slope)) return false;
  omega = T(omega_hz);
  if constexpr (!std::is_same_v<T, double>) {
    const T error = balance(T(omega_hz), response, second);
    omega.v = -error.v / slope;
  }
  return true;
}

// `ln_second`: the coordinate, ln omega where the second mode is not shared.
template <typename T>
bool TwoModes(const LocalCoordinates& c, double f, const Response<T>& response, const T& ln_second,
              double& omega_hz, LocalPoint<T>& point) {
  using std::exp;
  using std::log;
  T omega;
  if (!c.shared_second) {
    omega = exp(ln_second);
  } else if (!OmegaOfSharedSecond(Balance{c.relative, c.ratio, f}, response, T(exp(ln_second)),
                                  omega_hz, omega)) {
    return false;
  }
  const T& xi = response.xi;
  const T y = SinhLog(f / omega);
  const T y_r = SinhLog(f / (c.ratio * omega));
  point.above = y - response.across;
  point.below = response.across - y_r;
  if (!(point.above > 0.0) || !(point.below > 0.0)) return false;
  const T factor = 2.0 * (omega / f) * response.stretch / (xi * (y - y_r));
  point.ln_omega = log(omega);
  point.ln_N = log(factor * point.below * (xi * xi + y * y));
  if (c.shared_second) {
    point.ln_M = c.relative ? ln_second + point.ln_N : ln_second;
  } else {
    point.ln_M = log(factor * c.ratio * point.above * (xi * xi + y_r * y_r));
  }
  return true;
}

// The quantities of the second mode that the test uses.
template <typename T>
void SecondModeAsked(const LocalCoordinates& c, std::size_t experiment, LocalPoint<T>& point) {
  using std::exp;
  using std::log;
  const Experiment& e = c.problem.experiments[experiment];
  const MembershipTest& test = c.problem.test;
  const LoopParameters<T> loop{
      {exp(point.ln_omega), exp(point.ln_xi), exp(point.ln_N), exp(point.ln_M), T(c.ratio)},
      point.tau_s};
  point.second_mode_share = SecondModeShare(loop.acoustics, T(e.frequency_hz));
  point.line_rad.clear();
  point.ln_line_gain.clear();
  for (const ObservedLine& line : e.lines) {
    const T f(line.frequency_hz);
    if (test.second_crossing_tolerance_deg < 180.0) {
      point.line_rad.push_back(LoopPhaseError(loop, f));
    }
    if (TestsLineGain(e, test)) {
      point.ln_line_gain.push_back(log(LoopGain(loop, f, T(e.SteepestSlope()))));
    }
  }
}

}  // namespace

template <typename T>
bool BuildLocalPoint(const LocalCoordinates& c, std::size_t experiment,
                     const std::array<double, kLocals>& u, double& omega_hz, LocalPoint<T>& point) {
  using std::cos;
  using std::exp;
  using std::log;
  using std::sqrt;
  using std::tan;
  const LocalScale& scale = c.scales[experiment];
  const std::array<T, kLocals> v = Variables<T>(u);
  const double f = c.targets[experiment].frequency_hz;
  const double w = c.targets[experiment].w_rad_s;
  const T xi = exp(v[kLocalXi]);
  const T theta = scale.phase_0 + scale.phase * v[kLocalPhase];
  const T gain = scale.gain_0 + scale.gain * v[kLocalGain];
  const T t = tan(-theta);
  const T across = xi * t;
  const T root = sqrt(across * across + 1.0);
  const T top = f * (root - across);
  point.ln_xi = v[kLocalXi];
  const T turns = LoopTurns(theta, c.problem.domain.delay_periods);
  if (c.shared_tau) {
    point.tau_s = c.tau_0_s + c.tau_scale_s * v[kLocalDelay];
    point.loop_phase_rad = turns - w * point.tau_s;
  } else {
    point.loop_phase_rad = scale.loop_phase * v[kLocalDelay];
    point.tau_s = (turns - point.loop_phase_rad) / w;
  }
  const T stretch = w * gain * cos(theta);
  if (!c.two_modes) {
    point.ln_omega = log(top);
    point.ln_N = log(2.0 * stretch * xi * (root - across) / (cos(theta) * cos(theta)));
    point.ln_M = T(0.0);
    return true;
  }
  if (!TwoModes(c, f, Response<T>{xi, across, stretch, top}, v[kLocalSecond], omega_hz, point)) {
    return false;
  }
  SecondModeAsked(c, experiment, point);
  return true;
}

template bool BuildLocalPoint(const LocalCoordinates&, std::size_t,
                              const std::array<double, kLocals>&, double&, LocalPoint<double>&);
template bool BuildLocalPoint(const LocalCoordinates&, std::size_t,
                              const std::array<double, kLocals>&, double&, LocalPoint<LocalJet>&);

}  // namespace howl
