// The odds that decide what a budget says, to one. bench/loop_growth_study counts how often items
// come into loops that are right, and how often what is missing is found, as records grow longer
// and points more. Nats of what was left out need no law by which these would scale: they are the
// logarithm of a ratio of densities, whatever the length, the rate, the points and the noise.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_ODDS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_ODDS_H_

namespace howl {

// That an item comes in where it has no place, with the number of items that were offered: one in
// twenty, as is customary. Of free errors at the cycle's lines two are, of acoustics and of flame.
inline constexpr double kOddsOfItem = 20.0;
// Against another item in the place of one that came in: within them the two are a class.
inline constexpr double kOddsOfClass = 50.0;

// Causes that a verdict names. Of some forty items three and more can imitate what none of them is:
// of sixty rigs of the second simulator two had such an account (bench/loop_trial_study), one of an
// effect that is no item, and one of two causes beside which the third was none.
inline constexpr int kMostNamed = 2;

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_ODDS_H_
