// The odds that decide what a budget says, to one. bench/loop_growth_study counts how often items
// come into loops that are right, and how often what is missing is found, as records grow longer
// and points more. Nats of what was left out need no law by which these would scale: they are the
// logarithm of a ratio of densities, whatever the length, the rate, the points and the noise.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_ODDS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_ODDS_H_

#include <algorithm>
#include <cmath>

namespace howl {

// That an item comes in where it has no place, with the number of items that were offered: one in
// twenty, as is customary. Of free errors at the cycle's lines two are, of acoustics and of flame.
inline constexpr double kOddsOfItem = 20.0;
// No cause has the very form that an item gives it: a real low-pass is not of first order, a drift
// is not even. An item whose form is off by this share of its size leaves the share's square of
// what it gains, and what is left passes for other causes, or for errors at the cycle's lines: so
// these must gain as much more. Unlike nats it hangs on nothing but how well forms are known; it
// decides where records tell most. Of some 100 rigs of two simulators with one effect
// (bench/diagnose_rigs.py, bench/loop_practice_study, with a twentieth here) seven left more than a
// twentieth: 0.07 of a damping that follows the amplitude, 0.08 of a mode and of clipped p, and of
// gains that fluctuate or jump, which are modelled to first order, 0.10, 0.11, 0.17 and 0.19. The
// price of a tenth is a cause that is worth less than a hundredth of another: it is not named.
inline constexpr double kFormError = 0.1;

// What another item must gain beside those that gained so much, in nats.
inline double LeftByForms(double gained_nats) {
  return kFormError * kFormError * std::max(gained_nats, 0.0);
}

// Of the bound of what a fluctuating gain makes of the cycle's lines (lines_of_gain.h), how far its
// errors may go: gain and amplitudes are those of a curve that is itself off. On rigs of three
// simulators whose gain fluctuates or jumps errors were 0.3, 0.6, 1.0, 1.0, 1.5 and 1.5 of it
// (bench/diagnose_rigs.py prints them), of what else errs there 3.9, 8 and 19: a delay and an
// operating point that wander, and a cube of p in q.
inline constexpr double kBoundOfGain = 2.0;

// Against another item in the place of one that came in: within them the two are a class.
inline constexpr double kOddsOfClass = 50.0;

// Of a trial's gain what need not be known, from which fits to all points go on: with it what the
// item brings is off by a sixtieth of its size, and what forms leave is 40 times as much.
inline double UnknownOfTrial(double gained_nats) { return LeftByForms(gained_nats) / 40.0; }

// Nats by which a trial that gained less than one of so many may be as good.
inline double WithinReach(double gained_nats) {
  return std::log(kOddsOfClass) + UnknownOfTrial(gained_nats);
}

// Causes that a verdict names. Of some forty items three and more can imitate what none of them is:
// of sixty rigs of the second simulator two had such an account (bench/loop_trial_study), one of an
// effect that is no item, and one of two causes beside which the third was none.
inline constexpr int kMostNamed = 2;

// Of the gap that a right loop leaves: errors of its parameters then make half of what no loop can
// foretell, and no gap tells a wrong loop from it. Its square goes as the number of parameters over
// that of samples. It was below 0.06 on 24 rigs of the second simulator (bench/diagnose_rigs.py);
// on three records of the measured combustor 0.16 to 0.21 with 13 to 18 items, 0.98 with 20.
inline constexpr double kMostFloor = 0.7071;

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_ODDS_H_
