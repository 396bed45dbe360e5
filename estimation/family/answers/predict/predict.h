// Predictions of the family for quantities that were not measured.
//
// An expression of the parameters has a guaranteed interval (estimation/family/bounds/enclose.h
// with EncloseOptions::expressions). Everything else is evaluated member by member: its interval is
// the range over the members given, sampled, and says so.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_PREDICT_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_PREDICT_H_

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimation/family/problem/problem.h"
#include "model/loop/flame.h"

namespace howl {

enum class IntervalKind { kGuaranteed, kSampled };

struct Prediction {
  std::string name;
  IntervalKind kind = IntervalKind::kSampled;
  Range interval{1.0, -1.0};    // lo > hi: no member has it
  Range central_90{1.0, -1.0};  // 5 % to 95 % of the members, sampled ones only
  std::size_t members = 0;      // that have a value
};

// A member's value; no value where it has none.
using MemberPredictor = std::function<std::optional<double>(std::span<const LoopModel>)>;

// Members are evaluated on `threads` threads (0: all cores); the answer does not depend on the
// number.
Prediction PredictSampled(std::string name, std::span<const Member> members,
                          const MemberPredictor& predictor, int threads = 1);

// The amplitude of p in the limit cycle that the member has with that flame, next to a frequency:
// the describing function closes the loop at the phase crossing within 20 % of it,
//
//   |L(j 2 pi f) D(A)| = 1,
//
// and harmonic balance (model/cycles/harmonic_balance.h) refines frequency and amplitude. No value
// where the loop has no such crossing or its gain at rest does not exceed one there.
std::optional<double> PressureAmplitude(const LoopModel& model, const Flame<double>& flame,
                                        double frequency_hz);

// A frequency within (lo, hi) at which arg L = 180 degrees (mod 360): the one nearest to the middle
// of the band. Near 750 Hz it is the paper's non-harmonic line.
std::optional<double> CrossingNear(const LoopModel& model, const Range& band_hz);

// |L(j 2 pi f) Phi'(0)| at that frequency: above one, the loop can oscillate at the line by itself.
std::optional<double> LineGain(const LoopModel& model, const Range& band_hz, double flame_slope);

// A member at a phi that was not measured. Each parameter is linear in phi between the two
// neighbouring experiments (so xi still does not fall with phi, and omega stays within its
// spread); no value outside the measured range.
std::optional<LoopModel> InterpolateModel(std::span<const Experiment> experiments,
                                          std::span<const LoopModel> models, double phi);

// The limit cycle that a member predicts at that phi: the crossing of the interpolated loop nearest
// to the frequency interpolated between the neighbours, within `reach` of it relatively.
std::optional<double> InterpolatedFrequency(std::span<const Experiment> experiments,
                                            std::span<const LoopModel> models, double phi,
                                            double reach = 0.2);

// The quantile: the value nearest to the share `share` of the way through the values, of which
// there must be at least one, in ascending order; infinite ones count.
double NearestRank(std::span<const double> ascending, double share);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_PREDICT_H_
