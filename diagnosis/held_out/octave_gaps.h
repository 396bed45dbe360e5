// The gap of each operating point, signal and octave: octaves about the cycle's frequency, its
// half, its double and so on.
//
//   gap^2 = mean over an octave's bands, of both halves, of error / ceiling - 1 held_out_score.h
//
// The shares are of the squared gap of all, whose sum they are, so that they say where it comes
// from; negative where predictions are better than the ceiling.
#ifndef HOWL_DIAGNOSIS_HELD_OUT_OCTAVE_GAPS_H_
#define HOWL_DIAGNOSIS_HELD_OUT_OCTAVE_GAPS_H_

#include <string>
#include <vector>

#include "diagnosis/held_out/held_out_score.h"
#include "model/effects/effect.h"

namespace howl {

struct OctaveGap {
  std::string experiment;
  LoopBlock block = LoopBlock::kAcoustics;  // for p given q; kFlame for q given p
  int octave = 0;                           // about 2^octave times the cycle's frequency
  double low_hz = 0.0;
  double high_hz = 0.0;
  double gap = 0.0;  // with the sign of its square
  double share = 0.0;
};

// Point after point, p before q, and upwards in frequency. One cycle's frequency a point.
std::vector<OctaveGap> GapsByOctave(const std::vector<std::string>& names,
                                    const std::vector<double>& cycle_hz, const HeldOutScore& score);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_OCTAVE_GAPS_H_
