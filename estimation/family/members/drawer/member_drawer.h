// Draws one candidate member at a time, anywhere in the family.
//
// Each member is built rather than guessed: the window that omega_spread_max allows is placed
// first, then the shared parameters, then xi in random order within the interval that window,
// phase tolerance and the chain of xi leave to it (exact for one mode), then phase, gain and loop
// phase error within their tolerances. The closed form (one mode) or the root of the two-mode
// equation gives the parameters, and the falsification test has the last word. The density is
// broad, not uniform: see estimation/family/members/sample.h for uniform members.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_MEMBER_DRAWER_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_MEMBER_DRAWER_H_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/random.h"

namespace howl {

// The values that an attempt fixes for all experiments: the low end of the window of omega, and the
// shared parameters.
struct DrawGlobals {
  double window_hz = 0.0;
  double second = 0.0;  // M or M / N
  double N = 0.0;
  double tau_s = 0.0;
};

// Directs an attempt at the extremes of one experiment. An `end` is 0 or 1 for an end of its
// interval, else the draw is uniform. Empty ranges (lo > hi) leave the pilot search's.
struct DrawFocus {
  static constexpr Range kUnset{1.0, 0.0};
  std::size_t experiment = 0;
  double xi_end = 0.5;
  double phase_end = 0.5;
  double gain_end = 0.5;
  double loop_phase_end = 0.5;
  double omega_end = 0.5;  // where omega is free (M per experiment)
  // Ends for the other experiments too, six bits each (three for xi, three for the phase); zero
  // leaves them to chance.
  std::uint64_t pattern = 0;
  Range xi = kUnset;  // of this experiment
  Range window_hz = kUnset;
  Range second = kUnset;
  Range N = kUnset;
  Range tau_s = kUnset;

  double OtherEnd(std::size_t other, unsigned shift) const {
    if (pattern == 0) return 0.5;
    const std::uint64_t bits = (pattern >> (6 * (other % 10) + shift)) & 7u;
    return bits < 3 ? 0.0 : (bits < 6 ? 1.0 : 0.5);
  }
};

// The preview of a draw: the model of the experiment on which it is focused, and the state of the
// random numbers after it. No model: the draw is sure to fail.
struct Preview {
  std::optional<LoopModel> model;
  std::uint64_t state = 0;
};

// Draws one candidate member at a time. Immutable after construction: one object serves all
// threads.
class MemberDrawer {
 public:
  explicit MemberDrawer(const FamilyProblem& problem);
  ~MemberDrawer();
  MemberDrawer(const MemberDrawer&) = delete;
  MemberDrawer& operator=(const MemberDrawer&) = delete;

  // False when a pilot search found no place where a member may be.
  bool HasSupport() const;
  // One attempt; true when `models` (one for each experiment) is a member. `complete` tells
  // whether the attempt reached the test at all.
  bool Draw(UnitRandom& random, Member& models, bool& complete) const;
  bool DrawFocused(UnitRandom& random, const DrawFocus& focus, Member& models,
                   DrawGlobals& globals) const;
  // What DrawFocused would draw for focus.experiment, with the same random numbers, without the
  // others' models: the work does not grow with their number. No value where that cannot be told.
  std::optional<Preview> PreviewFocused(UnitRandom random, const DrawFocus& focus) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_MEMBER_DRAWER_H_
