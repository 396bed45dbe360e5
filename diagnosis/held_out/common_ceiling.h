// Scores of several structures against one ceiling: in each band of each record's halves the least
// that any of them gives.
#ifndef HOWL_DIAGNOSIS_HELD_OUT_COMMON_CEILING_H_
#define HOWL_DIAGNOSIS_HELD_OUT_COMMON_CEILING_H_

#include <array>
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
  std::vector<std::array<std::vector<double>, 2>> least_;  // in the order of a score's bands
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_COMMON_CEILING_H_
