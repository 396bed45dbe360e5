// What a structure foretells of each half of each record that it was not fitted to: nats, and the
// errors of its predictions (band_errors.h).
//
//   gap^2 = mean over signals and bands of error / ceiling - 1
//
// Negative where predictions are better than the ceiling, which a free transfer's own error allows.
// The floor is the gap of a right structure, whose parameters have the errors that half a record
// leaves them:
//
//   floor^2 = mean over signals and bands of spread / ceiling
#ifndef HOWL_DIAGNOSIS_HELD_OUT_HELD_OUT_SCORE_H_
#define HOWL_DIAGNOSIS_HELD_OUT_HELD_OUT_SCORE_H_

#include <array>
#include <cstddef>
#include <vector>

#include "diagnosis/held_out/band_errors.h"

namespace howl {

struct HeldOutScore {
  std::vector<std::array<double, 2>> nats;  // of a point's halves
  std::vector<std::array<std::vector<BandErrors>, 2>> errors;

  double Nats(std::size_t half) const;
  double Nats() const { return Nats(0) + Nats(1); }
  double Gap(std::size_t half) const;
  double Gap() const;
  double Floor() const;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_HELD_OUT_SCORE_H_
