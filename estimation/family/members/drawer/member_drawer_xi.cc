// The intervals of xi that window, tolerances and shared parameters leave, and the draw from them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "estimation/family/members/drawer/member_drawer_impl.h"
#include "estimation/family/members/drawer/range_draw.h"

namespace howl {

std::optional<Range> MemberDrawer::Impl::FirstModePhase(const Range& phase_rad) const {
  const double share = problem.test.second_mode_share_max;
  if (!(share < 1.0)) return std::nullopt;
  const double turn = std::asin(share);
  const Range phase = {phase_rad.lo - turn, phase_rad.hi + turn};
  const double right_angle = 0.5 * std::numbers::pi;
  if (phase.lo <= -right_angle || phase.hi >= right_angle) return std::nullopt;
  return phase;
}

bool MemberDrawer::Impl::DrawTau(UnitRandom& random, const Range& within, DrawGlobals& globals,
                                 std::vector<Range>& phases) const {
  Range allowed = within;
  for (const ExperimentTarget& target : targets) {
    allowed =
        Intersection(allowed, {Tau(target, target.phase_rad.lo, target.loop_phase_error_rad.hi),
                               Tau(target, target.phase_rad.hi, target.loop_phase_error_rad.lo)});
  }
  if (IsEmpty(allowed)) return false;
  globals.tau_s = random.Uniform(allowed);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double centre = -LoopPhaseError(targets[i], 0.0, globals.tau_s);
    phases[i] = Intersection(phases[i], {centre + targets[i].loop_phase_error_rad.lo,
                                         centre + targets[i].loop_phase_error_rad.hi});
    if (IsEmpty(phases[i])) return false;
  }
  return true;
}

Range MemberDrawer::Impl::TwoModeXi(std::size_t i, const Range& phase, const Range& window_hz,
                                    const Range& within, const DrawGlobals& globals) const {
  constexpr int kOmegaPoints = 8;
  Range hull{1e300, -1e300};
  for (const double theta : {phase.lo, phase.hi}) {
    for (int k = 0; k <= kOmegaPoints; ++k) {
      const double omega_hz =
          window_hz.lo * std::pow(window_hz.hi / window_hz.lo, double(k) / kOmegaPoints);
      TwoModeEquation equation =
          Equation(targets[i], 0.0, theta, 0.5 * (targets[i].gain.lo + targets[i].gain.hi),
                   globals.second, globals.N);
      const auto at = [&](double value) {
        equation.xi = value;
        return equation(omega_hz);
      };
      std::array<double, kMaxRoots> roots{};
      const int count =
          FindRoots<kMaxRoots>(at, std::max(within.lo, 1e-3 * within.hi), within.hi, 8, roots);
      for (int root = 0; root < count; ++root) {
        const double value = roots[static_cast<std::size_t>(root)];
        hull = {std::min(hull.lo, value), std::max(hull.hi, value)};
      }
    }
  }
  return Intersection(hull, within);
}

bool MemberDrawer::Impl::XiIntervals(const DrawGlobals& globals, const Range& window_hz,
                                     const std::vector<Range>& phases,
                                     std::vector<Range>& xis) const {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    ExperimentTarget target = targets[i];
    target.phase_rad = phases[i];
    const std::optional<Range> first = two_modes ? FirstModePhase(target.phase_rad) : std::nullopt;
    if (!two_modes) {
      xis[i] = XiInWindow(target, window_hz, own_xi[i]);
    } else if (first) {
      // The first mode is all but alone, so the condition of one mode holds with a tolerance that
      // is wider by the other mode's share.
      target.phase_rad = *first;
      xis[i] = XiInWindow(target, window_hz, own_xi[i]);
    } else {
      // y_r <= xi t <= y somewhere in the window: two one-mode conditions.
      const double unbounded = std::numeric_limits<double>::infinity();
      xis[i] = XiInWindow(target, {window_hz.lo, unbounded}, own_xi[i]);
      xis[i] = XiInWindow(target, {0.0, ratio * window_hz.hi}, xis[i]);
      if (IsEmpty(xis[i])) return false;
      if (shared_second) xis[i] = TwoModeXi(i, phases[i], window_hz, xis[i], globals);
    }
    if (IsEmpty(xis[i])) return false;
  }
  return true;
}

bool MemberDrawer::Impl::DrawN(UnitRandom& random, DrawGlobals& globals,
                               const std::vector<Range>& phases, std::vector<Range>& xis) const {
  if (two_modes) {
    return true;
  }
  Range allowed = N_support;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Range here{1e300, 0.0};
    for (const double theta : {phases[i].lo, phases[i].hi}) {
      const auto at = [&](double gain, double value) {
        const double n = OneModeN(TopOmega(targets[i], value, theta), value, theta, gain);
        here = {std::min(here.lo, n), std::max(here.hi, n)};
      };
      at(targets[i].gain.lo, xis[i].lo);
      at(targets[i].gain.hi, xis[i].hi);
    }
    allowed = Intersection(allowed, here);
  }
  if (IsEmpty(allowed)) return false;
  globals.N = random.LogUniform(allowed);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Range here{1e300, 0.0};
    for (const double theta : {phases[i].lo, phases[i].hi}) {
      for (const double gain : {targets[i].gain.lo, targets[i].gain.hi}) {
        // xi exp(-asinh(xi t)) = c
        const double c = globals.N * std::cos(theta) / (2.0 * targets[i].w_rad_s * gain);
        const double d = 1.0 - 2.0 * c * std::tan(-theta);
        const double value = d > 0.0 ? c / std::sqrt(d) : 1e300;
        here = {std::min(here.lo, value), std::max(here.hi, value)};
      }
    }
    xis[i] = Intersection(xis[i], here);
    if (IsEmpty(xis[i])) return false;
  }
  return true;
}

bool MemberDrawer::Impl::DrawXi(UnitRandom& random, const DrawFocus* focus,
                                std::vector<Range>& xis) const {
  const std::size_t n = targets.size();
  if (shared_xi) {
    Range common = xis[0];
    for (const Range& range : xis) common = Intersection(common, range);
    if (IsEmpty(common)) return false;
    const double value = Pick(random, common, focus ? focus->xi_end : 0.5);
    for (Range& range : xis) range = {value, value};
    return true;
  }
  if (!chain.Propagate(xis)) return false;
  thread_local FixedInChain fixed;
  fixed.Reset(chain);
  const auto fix = [&](std::size_t i, double value) {
    xis[i] = {value, value};
    fixed.Fix(i, value);
  };
  if (focus) {
    const std::size_t i = focus->experiment;
    const Range asked = IsEmpty(focus->xi) ? xis[i] : Intersection(xis[i], focus->xi);
    if (IsEmpty(asked)) return false;
    fix(i, Pick(random, asked, focus->xi_end));
  }
  // Random order: every experiment is as often the one that is drawn from its full interval.
  const std::size_t start = random.Index(n);
  const bool up = random.Uniform() < 0.5;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = up ? (start + k) % n : (start + n - k) % n;
    const double end = focus && i != focus->experiment ? focus->OtherEnd(i, 0) : 0.5;
    fix(i, Pick(random, fixed.Narrowed(i, xis[i]), end));
  }
  return true;
}

}  // namespace howl
