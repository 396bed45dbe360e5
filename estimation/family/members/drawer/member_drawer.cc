#include "estimation/family/members/drawer/member_drawer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "estimation/family/members/drawer/member_drawer_impl.h"
#include "estimation/family/members/drawer/range_draw.h"

namespace howl {

MemberDrawer::Impl::Impl(const FamilyProblem& p)
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

void MemberDrawer::Impl::FindSupport() {
  if (two_modes) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = 0.0;
    double scale_lo = lowest, scale_hi = 0.0;
    for (const ExperimentTarget& target : targets) {
      const std::optional<Range> first = FirstModePhase(target.phase_rad);
      const Range phase = first.value_or(target.phase_rad);
      const double y = xi.hi * std::tan(-phase.lo);
      lowest = std::min(
          lowest, OmegaFromDetuning(target.frequency_hz, std::max(y, 0.0)) / (first ? 1.0 : ratio));
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

bool MemberDrawer::Impl::Attempt(UnitRandom& random, const DrawFocus* focus, Member& models,
                                 DrawGlobals& globals, bool& complete) const {
  static const DrawFocus kNoFocus;
  const auto within = [](const Range& support, const Range& asked) {
    return IsEmpty(asked) ? support : asked;
  };
  const DrawFocus& where = focus ? *focus : kNoFocus;
  thread_local std::vector<Range> phases, xis;
  phases.resize(targets.size());
  xis.resize(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) phases[i] = targets[i].phase_rad;
  if (shared_tau && !DrawTau(random, Intersection(tau, within(tau, where.tau_s)), globals, phases))
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
      found = DrawExperiment(random, i, window_hz, phases[i], xis[i].lo, globals, here, models[i]);
    }
    if (!found) return false;
  }
  if (!InDomain(models)) return false;
  complete = true;
  return IsMember(problem.experiments, models, problem.test);
}

bool MemberDrawer::Impl::InDomain(const Member& models) const {
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

}  // namespace howl
