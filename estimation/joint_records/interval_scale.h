// How much wider intervals are than the likelihood has them, as the halves of the records tell.
//
//   S^2 = mean over the points of (a - b)^2 / (s_a^2 + s_b^2) + (c - m)^2 / s_c^2
//
// of a quantity that the halves of a record have as a +- s_a and b +- s_b (half_fits.h), and the
// whole as c +- s_c; m is the mean of a and b, each over its variance. Where the model is right the
// first term is one, but for chance, and the second next to nothing, for then the whole is what its
// halves are together. Where it is wrong the likelihood's errors are too small, and know one
// maximum alone: they are multiplied by S where it is above one, as the Particle Data Group does
// with measurements that disagree (the scale factor of its Review, section "Unconstrained
// averaging").
//
// What halves and whole have in common, as a model that errs alike in all, S does not see.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_INTERVAL_SCALE_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_INTERVAL_SCALE_H_

#include <cstddef>
#include <string>
#include <vector>

#include "estimation/joint_records/half_fits.h"

namespace howl {

struct IntervalScale {
  std::string quantity;    // as solution.json names it: "tau_s", "small_signal.loop_gain"
  double halves = 0.0;     // S
  std::size_t points = 0;  // that have the quantity
  std::size_t worst = 0;   // the point at which it differs most

  double Factor() const { return halves > 1.0 ? halves : 1.0; }
};

// Of every quantity that a point's record and both of its halves have.
std::vector<IntervalScale> ScalesOf(std::vector<FittedLoop> wholes, std::vector<HalfLoops> halves);

// With the errors of each multiplied.
void Widen(const std::vector<IntervalScale>& scales, std::vector<FittedLoop>* loops);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_INTERVAL_SCALE_H_
