// One experiment at its xi: phase, gain and loop phase error are drawn, the parameters follow.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "estimation/family/members/drawer/member_drawer_impl.h"
#include "estimation/family/members/drawer/range_draw.h"

namespace howl {
namespace {

constexpr int kRootCells = 12;

}  // namespace

bool MemberDrawer::Impl::DrawExperiment(UnitRandom& random, std::size_t i, const Range& window_hz,
                                        const Range& phase, double xi_i, const DrawGlobals& globals,
                                        const DrawFocus& focus, LoopModel& model) const {
  const ExperimentTarget& target = targets[i];
  const double f = target.frequency_hz;
  model.xi = xi_i;
  model.harmonic_ratio = ratio;
  model.M = 0.0;
  if (two_modes && shared_omega && shared_second) {
    return DrawAtOmega(random, i, window_hz.lo, globals, focus, model);
  }
  // Phases for which the window holds a solution at this xi.
  Range allowed = phase;
  if (window_hz.lo > 0.0) {
    allowed.lo = std::max(allowed.lo, -std::atan(Detuning(f, window_hz.lo) / xi_i));
  }
  const double reach = two_modes ? ratio : 1.0;
  if (std::isfinite(window_hz.hi)) {
    allowed.hi = std::min(allowed.hi, -std::atan(Detuning(f, reach * window_hz.hi) / xi_i));
  }
  if (IsEmpty(allowed)) {
    // The interval of xi is closed: its ends leave one phase, up to rounding.
    if (allowed.lo - allowed.hi > 1e-12) return false;
    std::swap(allowed.lo, allowed.hi);
  }
  const double theta = Pick(random, allowed, focus.phase_end);
  const double gain = Pick(random, target.gain, focus.gain_end);
  const double omega_1 = TopOmega(target, xi_i, theta);
  if (!two_modes) {
    model.omega_hz = shared_omega ? window_hz.lo : omega_1;
    model.N = shared_N ? globals.N : OneModeN(omega_1, xi_i, theta, gain);
  } else {
    const Range wedge = Intersection({omega_1 / ratio, omega_1}, window_hz);
    if (IsEmpty(wedge)) return false;
    if (shared_second) {
      std::array<double, kMaxRoots> roots{};
      const double least = LeastOmega(f, xi_i, std::tan(-theta), wedge);
      const int count =
          FindRoots<kMaxRoots>(Equation(target, xi_i, theta, gain, globals.second, globals.N),
                               least, wedge.hi, kRootCells, roots);
      if (count == 0) return false;
      model.omega_hz = roots[random.Index(static_cast<std::size_t>(count))];
    } else {
      const double least = LeastOmega(f, xi_i, std::tan(-theta), wedge);
      model.omega_hz = Pick(random, {least, wedge.hi}, focus.omega_end);
    }
    if (shared_omega) model.omega_hz = window_hz.lo;
    const ModeCoefficients coefficients = Coefficients(target, model.omega_hz, xi_i, theta, gain);
    model.N = coefficients.N;
    model.M = coefficients.M;
    if (shared_N) {
      model.N = globals.N;
      model.M *= globals.N / coefficients.N;
    }
    if (shared_second) {
      model.M = MOf(globals.second, model.N);
    }
  }
  return KeepsSecond(i, model) && SetTau(random, i, theta, globals, focus, model);
}

bool MemberDrawer::Impl::DrawAtOmega(UnitRandom& random, std::size_t i, double omega_hz,
                                     const DrawGlobals& globals, const DrawFocus& focus,
                                     LoopModel& model) const {
  const ExperimentTarget& target = targets[i];
  model.omega_hz = omega_hz;
  const auto mode = [&](double multiple) {
    return UnitModeResponse(kRadPerSPerHz * multiple * omega_hz, model.xi, target.w_rad_s);
  };
  const Complex<double> first = mode(1.0);
  const Complex<double> other = mode(ratio);
  const double gain = Pick(random, target.gain, focus.gain_end);
  const std::optional<double> n = NOfGain(first, other, gain, globals.second);
  if (!n) return false;
  model.N = shared_N ? globals.N : *n;
  model.M = MOf(globals.second, model.N);
  const double theta = Angle(model.N * first + model.M * other);
  return KeepsSecond(i, model) && SetTau(random, i, theta, globals, focus, model);
}

double MemberDrawer::Impl::LeastOmega(double frequency_hz, double xi_i, double tangent,
                                      const Range& wedge) const {
  // With y and y_r the modes' detuning, sin(atan(y / xi) - atan(t)) is (y - xi t) / sqrt(xi^2 +
  // y^2) but for a factor of t that both sides have.
  const double across = xi_i * tangent;
  const auto is_minor = [&](double omega_hz) {
    const double y = Detuning(frequency_hz, omega_hz);
    const double y_r = Detuning(frequency_hz, ratio * omega_hz);
    const double to_first = (y - across) / std::sqrt(xi_i * xi_i + y * y);
    const double to_second = (across - y_r) / std::sqrt(xi_i * xi_i + y_r * y_r);
    return to_first <= problem.test.second_mode_share_max * to_second;
  };
  double lo = wedge.lo, hi = wedge.hi;
  if (!std::isfinite(problem.test.second_mode_share_max) || is_minor(lo)) return lo;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (lo + hi);
    (is_minor(middle) ? hi : lo) = middle;
  }
  return hi;
}

bool MemberDrawer::Impl::KeepsSecond(std::size_t i, const LoopModel& model) const {
  return !two_modes || KeepsSecondMode(problem.experiments[i], model, problem.test);
}

bool MemberDrawer::Impl::SetTau(UnitRandom& random, std::size_t i, double theta,
                                const DrawGlobals& globals, const DrawFocus& focus,
                                LoopModel& model) const {
  if (shared_tau) {
    model.tau_s = globals.tau_s;
    return true;
  }
  const ExperimentTarget& target = targets[i];
  if (!two_modes || problem.experiments[i].lines.empty()) {
    model.tau_s =
        Tau(target, theta, Pick(random, target.loop_phase_error_rad, focus.loop_phase_end));
    return true;
  }
  std::vector<Range> allowed{{Tau(target, theta, target.loop_phase_error_rad.hi),
                              Tau(target, theta, target.loop_phase_error_rad.lo)}};
  const double tolerance = problem.test.second_crossing_tolerance_deg * kRadPerDeg * (1.0 - 1e-9);
  if (two_modes && tolerance < std::numbers::pi) {
    for (const ObservedLine& line : problem.experiments[i].lines) {
      const double w = kRadPerSPerHz * line.frequency_hz;
      const double turned = Angle(AcousticResponse(model.Loop().acoustics, line.frequency_hz)) -
                            0.5 * std::numbers::pi;
      std::vector<Range> narrowed;
      for (const Range& part : allowed) {
        const double turn = 2.0 * std::numbers::pi;
        const auto first = std::lround(std::ceil((part.lo * w - turned - tolerance) / turn));
        const auto last = std::lround(std::floor((part.hi * w - turned + tolerance) / turn));
        for (long k = first; k <= last; ++k) {
          const double whole = static_cast<double>(k) * turn;
          const Range here = Intersection(
              part, {(turned - tolerance + whole) / w, (turned + tolerance + whole) / w});
          if (!IsEmpty(here)) narrowed.push_back(here);
        }
      }
      allowed = std::move(narrowed);
    }
  }
  if (allowed.empty()) return false;
  // An end of 0 is the least loop phase error, and so the largest tau.
  if (focus.loop_phase_end == 0.0) {
    model.tau_s = allowed.back().hi;
  } else if (focus.loop_phase_end == 1.0) {
    model.tau_s = allowed.front().lo;
  } else {
    model.tau_s = random.Uniform(allowed[random.Index(allowed.size())]);
  }
  return true;
}

}  // namespace howl
