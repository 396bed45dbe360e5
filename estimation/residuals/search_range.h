// The guard rails of a search: with f the frequency of a cycle and g its gain, both over all
// experiments,
//
//   omega: f / 1000 .. 1000 f,   tau: 0.0001 / f .. 1000 / f,   N and M: 2 pi f g (1e-9 .. 1e9)
//
// in units of the data, so that a loop run slower or faster, or recorded in other units, is
// searched alike. xi and M / N have no dimension; their bounds are the model's own.
#ifndef HOWL_ESTIMATION_RESIDUALS_SEARCH_RANGE_H_
#define HOWL_ESTIMATION_RESIDUALS_SEARCH_RANGE_H_

#include <span>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"

namespace howl {

struct SearchRange {
  double min = 0.0;  // natural units, positive
  double max = 0.0;
};

class SearchRails {
 public:
  // CHECKs that there is an experiment.
  explicit SearchRails(std::span<const Experiment> experiments);

  // The bounds that `spec` states come first; an initial value that it states lies within.
  SearchRange RangeOf(ParameterKind kind, const ParameterSpec& spec) const;

 private:
  SearchRange omega_, tau_, coefficient_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_SEARCH_RANGE_H_
