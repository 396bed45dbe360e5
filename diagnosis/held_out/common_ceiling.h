// Scores of several structures against one ceiling. Of each operating point and signal it is that
// of the structure whose free transfers leave least over all bands together: the least of each band
// by itself would be the luckiest of so many estimates, and a gap where there is none.
#ifndef HOWL_DIAGNOSIS_HELD_OUT_COMMON_CEILING_H_
#define HOWL_DIAGNOSIS_HELD_OUT_COMMON_CEILING_H_

#include <array>
#include <limits>
#include <vector>

#include "diagnosis/held_out/held_out_score.h"

namespace howl {

class CommonCeiling {
 public:
  void Lower(const HeldOutScore& score);
  HeldOutScore Against(HeldOutScore score) const;
  // The gap, 0 where the structure is as good as the ceiling.
  double Gap(const HeldOutScore& score) const;

 private:
  // Of one point and signal: the ceilings of its bands in either half, and the mean of their
  // logarithms.
  struct Least {
    std::array<std::vector<double>, 2> ceilings;
    double mean_log = std::numeric_limits<double>::infinity();
  };

  std::vector<std::array<Least, 2>> least_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_COMMON_CEILING_H_
