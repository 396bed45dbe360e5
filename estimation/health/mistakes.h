// Mistakes that data come with, and how each is undone. One experiment's characteristics are
// (f, Delta, g, Phi'(0)): frequency, phase and gain from q to p, and the flame's slope.
//
//   inverted          p or q with the wrong sign: Delta -> Delta + 180
//   phase_sign        Delta counted from p to q, or a lag as positive: Delta -> -Delta
//   p_and_q_swapped   G taken for 1 / G: Delta -> -Delta, g -> 1 / g
//   gain_inverted     g is |q| / |p|: g -> 1 / g
//   phase_in_radians  Delta -> 180 / pi Delta
//   frequency_in_khz, frequency_in_rad_per_s, lines_in_khz
//   flame_slope_unit  Phi'(0) too small by a power of ten
//   sampling_rate     a record's rate wrong by a factor: time, and so 1 / f and Phi'(0), scale
//
// The slope of a flame whose delayed p' was read half a period off, as an inverted channel makes
// it, is the right one: the two signs cancel. The slope of a record with p and q swapped is that of
// no flame.
#ifndef HOWL_ESTIMATION_HEALTH_MISTAKES_H_
#define HOWL_ESTIMATION_HEALTH_MISTAKES_H_

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "estimation/analysis/loop/experiment.h"

namespace howl {

struct Mistake {
  std::string id;
  std::string text;       // "p or q with the wrong sign, as from an inverted transducer"
  std::string undone;     // "with phase_deg + 180"
  bool in_tables = true;  // a published row can have it
  bool in_records = false;
  bool in_transfer = false;  // a record's transfer shows it, and is the better judge
  bool alone = true;         // one experiment can have it while others have not
  bool together = true;      // undone in all at once it changes what fits
  // False where the experiment shows that it has not this mistake.
  std::function<bool(Experiment&)> undo;
};

// `recorded`: for each experiment, whether its numbers were estimated from a record.
std::vector<Mistake> PossibleMistakes(std::span<const Experiment> experiments);

// A loop gain g |Phi'(0)| 2 pi f at the cycle far from one, (1b), shows a wrong unit: below
// kSmallestLoopGain the factor by which the slope is too small, a power of ten, is undone and
// tried; above kLargestLoopGain it is told from the number alone. A cycle's flame works at the
// share 1 / (loop gain) of its slope.
inline constexpr double kSmallestLoopGain = 0.02;
inline constexpr double kLargestLoopGain = 100.0;

// g |Phi'(0)| 2 pi f; NaN without a slope.
double MeasuredLoopGain(const Experiment& experiment);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_MISTAKES_H_
