#include "estimation/family/members/enumerate.h"

#include <algorithm>
#include <cmath>

#include "estimation/family/members/chain.h"
#include "estimation/family/members/chain_front.h"
#include "estimation/family/members/sample.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/family/members/window.h"
#include "estimation/family/problem/member_chart.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

constexpr std::size_t kChunk = 256;        // members a unit of work
constexpr std::size_t kAttemptsPer = 400;  // attempts a member before a unit gives up
constexpr int kRootCells = 12;
constexpr int kMaxRoots = 4;

Range Intersection(const Range& a, const Range& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

bool IsEmpty(const Range& range) { return !(range.lo <= range.hi); }

// A draw from a range, or one of its ends.
double Pick(UnitRandom& random, const Range& range, double end) {
  if (end == 0.0) return range.lo;
  if (end == 1.0) return range.hi;
  return random.Uniform(range);
}

}  // namespace

struct MemberDrawer::Impl : MemberChart {
  FamilyProblem problem;
  WindowProblem window;
  XiChain chain;
  Range omega, N, second, tau;
  std::vector<Range> own_xi;
  Range window_support, second_support, N_support;
  bool supported = false;
  std::optional<ChainFronts> fronts;  // where draws can be previewed
  Range preview_support;              // windows outside have no member

  explicit Impl(const FamilyProblem& p)
      : MemberChart(p),
        problem(p),
        window(MakeWindowProblem(p)),
        chain(targets, p.test.xi_increasing) {
    omega = p.RangeOf(ParameterKind::kOmega);
    N = p.RangeOf(ParameterKind::kN);
    second = p.RangeOf(second_kind);
    tau = p.RangeOf(ParameterKind::kTau);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      own_xi.push_back(Intersection(xi, p.RangeOf(ParameterKind::kXi, i)));
    }
    for (const ExperimentTarget& target : targets) {
      if (target.IsEmpty()) return;
    }
    FindSupport();
    const bool any_shared = shared_omega || shared_xi || shared_N || shared_tau;
    if (supported && !two_modes && !any_shared && p.model.own.empty() &&
        std::isfinite(window.factor)) {
      // xi is drawn from a floor on, which the windows do not contain.
      WindowProblem drawn = window;
      drawn.xi = xi;
      const std::optional<Range> windows = FeasibleWindows(drawn);
      if (windows) fronts.emplace(window, chain, *windows);
      preview_support = windows.value_or(Range{});
    }
  }

  void FindSupport() {
    if (two_modes) {
      double lowest = std::numeric_limits<double>::infinity();
      double highest = 0.0;
      double scale_lo = lowest, scale_hi = 0.0;
      for (const ExperimentTarget& target : targets) {
        const std::optional<Range> first = FirstModePhase(target.phase_rad);
        const Range phase = first.value_or(target.phase_rad);
        const double y = xi.hi * std::tan(-phase.lo);
        lowest = std::min(lowest, OmegaFromDetuning(target.frequency_hz, std::max(y, 0.0)) /
                                      (first ? 1.0 : ratio));
        const double y_lo = xi.hi * std::tan(-phase.hi);
        highest = std::max(highest, OmegaFromDetuning(target.frequency_hz, std::min(y_lo, 0.0)));
        scale_lo = std::min(scale_lo, target.w_rad_s * target.gain.lo);
        scale_hi = std::max(scale_hi, target.w_rad_s * target.gain.hi);
      }
      window_support = Intersection({lowest, highest}, {omega.lo / window.factor, omega.hi});
      // With (5b) M is at most s / (1 - s) |G| / |U_r|, and |1 / U_r| at most some r^2 w.
      const double share = problem.test.second_mode_share_max;
      const double most = share < 0.5 ? share / (1.0 - share) * ratio * ratio : 10.0;
      second_support = second_kind == ParameterKind::kM
                           ? Intersection({1e-3 * scale_lo, most * scale_hi}, second)
                           : Intersection({1e-3, 1e3}, second);
      N_support = Intersection({1e-3 * scale_lo, 10.0 * scale_hi}, N);
    } else {
      const std::optional<Range> windows = FeasibleWindows(window);
      if (!windows) return;
      window_support = *windows;
      N_support = N;
    }
    if (!std::isfinite(window.factor)) window_support = {1.0, 1.0};
    if (IsEmpty(window_support)) return;
    // Narrow what is drawn first to where members were found, with a margin; twice.
    for (int round = 0; round < 2; ++round) {
      Range windows{1e300, 0.0}, seconds{1e300, 0.0}, Ns{1e300, 0.0};
      const int tries = round == 0 ? 20000 : 3000;
      UnitRandom random(0x5eed, static_cast<std::uint64_t>(round));
      Member models(targets.size());
      int found = 0;
      for (int attempt = 0; attempt < tries && found < 200; ++attempt) {
        DrawGlobals globals;
        bool complete = false;
        if (!Attempt(random, nullptr, models, globals, complete)) continue;
        ++found;
        const auto widen = [](Range& range, double value) {
          range = {std::min(range.lo, value), std::max(range.hi, value)};
        };
        widen(windows, globals.window_hz);
        widen(seconds, globals.second);
        widen(Ns, globals.N);
      }
      if (found == 0) return;
      supported = true;
      if (!two_modes && !shared_N && !shared_tau) return;
      const auto narrow = [](Range& support, const Range& seen) {
        if (!(seen.lo > 0.0)) return;
        const double margin = 1.02 * std::pow(seen.hi / seen.lo, 0.2);
        support = Intersection(support, {seen.lo / margin, seen.hi * margin});
      };
      if (two_modes) narrow(window_support, windows);
      if (shared_second) narrow(second_support, seconds);
      if (shared_N && two_modes) narrow(N_support, Ns);
    }
  }

  // arg(N U_1), where the second mode adds at most its share s to it, (5b): arg G to within asin s.
  // No value where the share bounds nothing.
  std::optional<Range> FirstModePhase(const Range& phase_rad) const {
    const double share = problem.test.second_mode_share_max;
    if (!(share < 1.0)) return std::nullopt;
    const double turn = std::asin(share);
    const Range phase = {phase_rad.lo - turn, phase_rad.hi + turn};
    const double right_angle = 0.5 * std::numbers::pi;
    if (phase.lo <= -right_angle || phase.hi >= right_angle) return std::nullopt;
    return phase;
  }

  bool DrawTau(UnitRandom& random, const Range& within, DrawGlobals& globals,
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

  // Hull of the xi for which a grid of the window has a solution: a guide for the draw alone.
  Range TwoModeXi(std::size_t i, const Range& phase, const Range& window_hz, const Range& within,
                  const DrawGlobals& globals) const {
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

  // The interval of xi of each experiment, before the chain.
  bool XiIntervals(const DrawGlobals& globals, const Range& window_hz,
                   const std::vector<Range>& phases, std::vector<Range>& xis) const {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      ExperimentTarget target = targets[i];
      target.phase_rad = phases[i];
      const std::optional<Range> first =
          two_modes ? FirstModePhase(target.phase_rad) : std::nullopt;
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

  // One mode with N shared: draws N, and narrows xi to where a gain within its range gives it.
  bool DrawN(UnitRandom& random, DrawGlobals& globals, const std::vector<Range>& phases,
             std::vector<Range>& xis) const {
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

  bool DrawXi(UnitRandom& random, const DrawFocus* focus, std::vector<Range>& xis) const {
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

  bool DrawExperiment(UnitRandom& random, std::size_t i, const Range& window_hz, const Range& phase,
                      double xi_i, const DrawGlobals& globals, const DrawFocus& focus,
                      LoopModel& model) const {
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

  // Below it the second mode would add more than second_mode_share_max: z = N U_1 + M U_r has its
  // parts in the ratio of the sines of the angles to the other part's direction, and from the
  // one-mode solution down the share only grows.
  double LeastOmega(double frequency_hz, double xi_i, double tangent, const Range& wedge) const {
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

  bool KeepsSecond(std::size_t i, const LoopModel& model) const {
    return !two_modes || KeepsSecondMode(problem.experiments[i], model, problem.test);
  }

  // tau within the loop phase tolerance; with lines, within the part of it that closes the loop at
  // every line (w tau = arg G - pi / 2 - error + 2 pi k there), false where there is none.
  bool SetTau(UnitRandom& random, std::size_t i, double theta, const DrawGlobals& globals,
              const DrawFocus& focus, LoopModel& model) const {
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

  // omega, xi and the second mode are all given: N follows from a gain, the phase from N.
  bool DrawAtOmega(UnitRandom& random, std::size_t i, double omega_hz, const DrawGlobals& globals,
                   const DrawFocus& focus, LoopModel& model) const {
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

  // In the steps of Attempt.
  std::optional<Preview> PreviewOf(UnitRandom random, const DrawFocus& focus) const {
    constexpr double kEdge = 1e-9;
    constexpr std::uint64_t kNumbersEach = 3;  // phase, gain, loop phase error
    if (!fronts || focus.pattern != 0) return std::nullopt;
    DrawGlobals globals;
    globals.window_hz = random.Uniform(IsEmpty(focus.window_hz) ? window_support : focus.window_hz);
    const double v = globals.window_hz;
    if (v < preview_support.lo * (1.0 - kEdge) || v > preview_support.hi * (1.0 + kEdge)) {
      return Preview{std::nullopt, random.State()};
    }
    if (!preview_support.Contains(v)) return std::nullopt;
    const Range window_hz = Intersection(omega, {v, v * window.factor});
    if (IsEmpty(window_hz)) return std::nullopt;
    const std::size_t i = focus.experiment;
    const auto interval = [&](std::size_t j) {
      return XiInWindow(targets[j], window_hz, own_xi[j]);
    };
    Range here = interval(i);
    const std::size_t link = chain.LinkOf(i);
    for (const std::size_t j : fronts->Below(link)) here.lo = std::max(here.lo, interval(j).lo);
    for (const std::size_t j : fronts->Above(link)) here.hi = std::min(here.hi, interval(j).hi);
    if (IsEmpty(here)) return std::nullopt;
    if (!IsEmpty(focus.xi)) here = Intersection(here, focus.xi);
    if (IsEmpty(here)) return Preview{std::nullopt, random.State()};
    const double xi_i = Pick(random, here, focus.xi_end);
    const std::size_t n = targets.size();
    random.Skip(2 + n + kNumbersEach * i);
    LoopModel model;
    if (!DrawExperiment(random, i, window_hz, targets[i].phase_rad, xi_i, globals, focus, model)) {
      return std::nullopt;
    }
    random.Skip(kNumbersEach * (n - 1 - i));
    return Preview{model, random.State()};
  }

  bool InDomain(const Member& models) const {
    for (std::size_t i = 0; i < models.size(); ++i) {
      const LoopModel& model = models[i];
      const auto contains = [&](ParameterKind kind, const Range& common, double value) {
        return problem.model.own.empty() ? common.Contains(value)
                                         : problem.RangeOf(kind, i).Contains(value);
      };
      if (!contains(ParameterKind::kOmega, omega, model.omega_hz) ||
          !contains(ParameterKind::kN, N, model.N) ||
          !contains(ParameterKind::kTau, tau, model.tau_s)) {
        return false;
      }
      if (two_modes) {
        const double value = second_kind == ParameterKind::kM ? model.M : model.M / model.N;
        if (!(value > 0.0)) return false;
        if (!shared_second && !contains(second_kind, second, value)) return false;
      }
    }
    return true;
  }

  bool Attempt(UnitRandom& random, const DrawFocus* focus, Member& models, DrawGlobals& globals,
               bool& complete) const {
    static const DrawFocus kNoFocus;
    const auto within = [](const Range& support, const Range& asked) {
      return IsEmpty(asked) ? support : asked;
    };
    const DrawFocus& where = focus ? *focus : kNoFocus;
    thread_local std::vector<Range> phases, xis;
    phases.resize(targets.size());
    xis.resize(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) phases[i] = targets[i].phase_rad;
    if (shared_tau &&
        !DrawTau(random, Intersection(tau, within(tau, where.tau_s)), globals, phases))
      return false;
    globals.window_hz = random.Uniform(within(window_support, where.window_hz));
    Range window_hz = omega;
    if (std::isfinite(window.factor)) {
      window_hz = Intersection(omega, {globals.window_hz, globals.window_hz * window.factor});
    } else if (two_modes) {
      window_hz =
          Intersection(omega, {1e-3 * targets[0].frequency_hz, 1e3 * targets[0].frequency_hz});
    }
    if (IsEmpty(window_hz)) return false;
    if (shared_second) globals.second = random.LogUniform(within(second_support, where.second));
    if (shared_N && two_modes) globals.N = random.LogUniform(within(N_support, where.N));
    if (!XiIntervals(globals, window_hz, phases, xis)) return false;
    if (shared_N && !two_modes && !DrawN(random, globals, phases, xis)) return false;
    if (!DrawXi(random, focus, xis)) return false;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      bool found = false;
      for (int tries = two_modes ? 6 : 1; tries > 0 && !found; --tries) {
        DrawFocus other;
        other.phase_end = where.OtherEnd(i, 3);
        const DrawFocus& here = focus && i == where.experiment ? where : other;
        found =
            DrawExperiment(random, i, window_hz, phases[i], xis[i].lo, globals, here, models[i]);
      }
      if (!found) return false;
    }
    if (!InDomain(models)) return false;
    complete = true;
    return IsMember(problem.experiments, models, problem.test);
  }
};

MemberDrawer::MemberDrawer(const FamilyProblem& problem) : impl_(std::make_unique<Impl>(problem)) {}
MemberDrawer::~MemberDrawer() = default;

bool MemberDrawer::HasSupport() const { return impl_->supported; }

bool MemberDrawer::Draw(UnitRandom& random, Member& models, bool& complete) const {
  complete = false;
  models.resize(impl_->targets.size());
  DrawGlobals globals;
  return impl_->Attempt(random, nullptr, models, globals, complete);
}

bool MemberDrawer::DrawFocused(UnitRandom& random, const DrawFocus& focus, Member& models,
                               DrawGlobals& globals) const {
  bool complete = false;
  models.resize(impl_->targets.size());
  return impl_->Attempt(random, &focus, models, globals, complete);
}

std::optional<Preview> MemberDrawer::PreviewFocused(UnitRandom random,
                                                    const DrawFocus& focus) const {
  return impl_->PreviewOf(random, focus);
}

namespace {

Enumeration EnumerateByChains(const FamilyProblem& problem, std::size_t count, std::uint64_t seed,
                              int threads) {
  Enumeration result;
  result.counts.requested = count;
  SampleOptions sampling{.count = count, .burn_in = 50, .seed = seed, .threads = threads};
  result.members = SampleMembers(problem, sampling).members;
  result.counts.drawn = result.counts.complete = result.counts.members = result.members.size();
  return result;
}

}  // namespace

Enumeration EnumerateMembers(const FamilyProblem& problem, std::size_t count, std::uint64_t seed,
                             int threads) {
  if (count > 0 && NeedsTransferStarts(problem)) {
    return EnumerateByChains(problem, count, seed, threads);
  }
  return EnumerateMembers(problem, MemberDrawer(problem), count, seed, threads);
}

Enumeration EnumerateMembers(const FamilyProblem& problem, const MemberDrawer& drawer,
                             std::size_t count, std::uint64_t seed, int threads) {
  if (count > 0 && NeedsTransferStarts(problem)) {
    return EnumerateByChains(problem, count, seed, threads);
  }
  Enumeration result;
  result.counts.requested = count;
  if (!drawer.HasSupport() || count == 0) return result;
  const std::size_t units = (count + kChunk - 1) / kChunk;
  std::vector<Enumeration> parts(units);
  RunUnits(units, threads, [&](std::size_t unit) {
    Enumeration& part = parts[unit];
    const std::size_t wanted = std::min(kChunk, count - unit * kChunk);
    part.members.reserve(wanted);
    UnitRandom random(seed, unit + 1);
    Member models;
    while (part.members.size() < wanted && part.counts.drawn < wanted * kAttemptsPer) {
      bool complete = false;
      ++part.counts.drawn;
      const bool member = drawer.Draw(random, models, complete);
      if (complete) ++part.counts.complete;
      if (member) part.members.push_back(models);
    }
  });
  result.members.reserve(count);
  for (Enumeration& part : parts) {
    result.counts.drawn += part.counts.drawn;
    result.counts.complete += part.counts.complete;
    std::move(part.members.begin(), part.members.end(), std::back_inserter(result.members));
  }
  result.counts.members = result.members.size();
  return result;
}

Enumeration EnumerateMembers(const std::vector<Experiment>& experiments, const ModelSpec& model,
                             const MembershipTest& test, std::size_t count, std::uint64_t seed,
                             int threads) {
  return EnumerateMembers(
      FamilyProblem{.experiments = experiments, .model = model, .test = test, .domain = {}}, count,
      seed, threads);
}

}  // namespace howl
