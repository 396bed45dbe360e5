// From evidence to belief: how probable it is that nothing is wrong, and that what is wrong is not
// in the catalogue. Both are logistic in the best candidate's gain, in the gain that free slack
// still has after it, and in the gap that it leaves on held-out experiments.
#ifndef HOWL_DIAGNOSIS_VERDICT_VERDICT_H_
#define HOWL_DIAGNOSIS_VERDICT_VERDICT_H_

namespace howl {

// The largest slack in cut B (slack.h) on rigs without an effect where p's noise is strong.
inline constexpr double kFlameAllowance = 80.0;

struct Evidence {
  double gain = 0.0;            // of log-likelihood, by the best candidate, parameters paid for
  double gain_of_noise = 0.0;   // that simulated replicates seldom reach (bootstrap.h)
  double acoustic_slack = 0.0;  // left after it (slack.h)
  double flame_slack = 0.0;
  double gap_before = 0.0;
  double gap_after = 0.0;
  double gap_floor = 0.0;
  bool model_free = false;   // detected in the samples themselves: clipping's edge, few levels
  bool confirmed = false;    // by something other than the likelihood
  bool flame_alone = false;  // the candidate shows in cut B only
  bool unexplained_lines = false;    // coherent lines that no candidate accounts for
  bool form_is_wrong = false;        // the candidate is no cause of its own (Effect::IsOwnCause)
  bool unexplained_samples = false;  // an edge or few levels: the same
};

struct Belief {
  double none = 0.0;
  double unknown = 0.0;  // given that something is wrong
};

Belief Weigh(const Evidence& evidence);

// The slack beyond what is left on rigs whose effect has a form that is only nearly right.
double Unexplained(const Evidence& evidence);

// How fast the odds of a candidate fall with its distance to the best: models are never exact, so
// distances count by their share of the largest gain too.
double Temperature(double largest_gain);

// An effect that has at least this share of the best one's probability is not told from it.
inline constexpr double kClassProbability = 0.02;

// True where placebo effects (placebo.h) with as many parameters as the best candidate shrink the
// gap as much as it does: its gain then comes from its freedom, not from a cause. placebo_shrinkage
// is NaN where there is nothing to compare.
bool IsNoBetterThanPlacebo(double shrinkage, double placebo_shrinkage);

// The probability that what is wrong is not in the catalogue, given such a fact.
inline constexpr double kUnexplainedFact = 0.9;

// Gains in cut B below this may be noise: where p's is as strong as a hundredth of its amplitude,
// rigs with no effect reached 35 in trials, and 46 where a measured record is the reference.
inline constexpr double kNearNoise = 60.0;

// Of two kinds of evidence that do not compete (a line and a transfer function, say), the least
// that each must bring.
double DetectionGain(bool flame_alone);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_VERDICT_H_
