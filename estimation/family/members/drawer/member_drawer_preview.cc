// What a draw would be for one experiment, without the others' models.
#include <algorithm>

#include "estimation/family/members/drawer/member_drawer_impl.h"
#include "estimation/family/members/drawer/range_draw.h"

namespace howl {

std::optional<Preview> MemberDrawer::Impl::PreviewOf(UnitRandom random,
                                                     const DrawFocus& focus) const {
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
  const auto interval = [&](std::size_t j) { return XiInWindow(targets[j], window_hz, own_xi[j]); };
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

}  // namespace howl
