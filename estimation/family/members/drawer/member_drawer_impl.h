// The inner workings of MemberDrawer: member_drawer.cc has an attempt and where members may be at
// all, member_drawer_xi.cc the intervals of xi and the draw from them, member_drawer_point.cc one
// experiment's draw at its xi, member_drawer_preview.cc the preview.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_MEMBER_DRAWER_IMPL_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_MEMBER_DRAWER_IMPL_H_

#include <optional>
#include <vector>

#include "estimation/family/members/drawer/chain.h"
#include "estimation/family/members/drawer/chain_front.h"
#include "estimation/family/members/drawer/member_drawer.h"
#include "estimation/family/members/drawer/window.h"
#include "estimation/family/problem/member_chart.h"

namespace howl {

struct MemberDrawer::Impl : MemberChart {
  static constexpr int kMaxRoots = 4;  // of the two-mode equation

  explicit Impl(const FamilyProblem& p);

  void FindSupport();
  bool InDomain(const Member& models) const;
  bool Attempt(UnitRandom& random, const DrawFocus* focus, Member& models, DrawGlobals& globals,
               bool& complete) const;

  // arg(N U_1), where the second mode adds at most its share s to it, (5b): arg G to within asin s.
  // No value where the share bounds nothing.
  std::optional<Range> FirstModePhase(const Range& phase_rad) const;
  bool DrawTau(UnitRandom& random, const Range& within, DrawGlobals& globals,
               std::vector<Range>& phases) const;
  // Hull of the xi for which a grid of the window has a solution: a guide for the draw alone.
  Range TwoModeXi(std::size_t i, const Range& phase, const Range& window_hz, const Range& within,
                  const DrawGlobals& globals) const;
  // The interval of xi of each experiment, before the chain.
  bool XiIntervals(const DrawGlobals& globals, const Range& window_hz,
                   const std::vector<Range>& phases, std::vector<Range>& xis) const;
  // One mode with N shared: draws N, and narrows xi to where a gain within its range gives it.
  bool DrawN(UnitRandom& random, DrawGlobals& globals, const std::vector<Range>& phases,
             std::vector<Range>& xis) const;
  bool DrawXi(UnitRandom& random, const DrawFocus* focus, std::vector<Range>& xis) const;

  bool DrawExperiment(UnitRandom& random, std::size_t i, const Range& window_hz, const Range& phase,
                      double xi_i, const DrawGlobals& globals, const DrawFocus& focus,
                      LoopModel& model) const;
  // Below it the second mode would add more than second_mode_share_max: z = N U_1 + M U_r has its
  // parts in the ratio of the sines of the angles to the other part's direction, and from the
  // one-mode solution down the share only grows.
  double LeastOmega(double frequency_hz, double xi_i, double tangent, const Range& wedge) const;
  bool KeepsSecond(std::size_t i, const LoopModel& model) const;
  // tau within the loop phase tolerance; with lines, within the part of it that closes the loop at
  // every line (w tau = arg G - pi / 2 - error + 2 pi k there), false where there is none.
  bool SetTau(UnitRandom& random, std::size_t i, double theta, const DrawGlobals& globals,
              const DrawFocus& focus, LoopModel& model) const;
  // omega, xi and the second mode are all given: N follows from a gain, the phase from N.
  bool DrawAtOmega(UnitRandom& random, std::size_t i, double omega_hz, const DrawGlobals& globals,
                   const DrawFocus& focus, LoopModel& model) const;

  // In the steps of Attempt.
  std::optional<Preview> PreviewOf(UnitRandom random, const DrawFocus& focus) const;

  FamilyProblem problem;
  WindowProblem window;
  XiChain chain;
  Range omega, N, second, tau;
  std::vector<Range> own_xi;
  Range window_support, second_support, N_support;
  bool supported = false;
  std::optional<ChainFronts> fronts;  // where draws can be previewed
  Range preview_support;              // windows outside have no member
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_MEMBER_DRAWER_IMPL_H_
