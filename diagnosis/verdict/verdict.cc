#include "diagnosis/verdict/verdict.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

// Log-likelihoods are of Gaussian noise whose spectrum is itself fitted. On blind rigs with no
// effect (results/trial) the largest gain was 3 in cut A.
constexpr double kDetectionGain = 8.0;
// Cut B's regressor is recorded p, whose sensor noise is corrected for only in the mean. Where that
// noise is near a hundredth of p's amplitude, rigs with no effect reach 16.
constexpr double kFlameDetectionGain = 16.0;
// Rigs with no effect stay below the floor itself.
constexpr double kGapOverFloor = 2.2;
constexpr double kGapOverFloorWidth = 0.15;
constexpr double kDetectionWidth = 2.0;
constexpr double kAcousticAllowance = 8.0;  // on rigs without an effect there is none
constexpr double kUnexplainedDetection = 15.0;
constexpr double kUnexplainedWidth = 3.0;
constexpr double kUnknownShare = 0.10;
constexpr double kConfirmedUnknownShare = 0.35;
constexpr double kUnknownWidth = 0.02;
constexpr double kUnknownGapShare = 0.016;  // of the squared gap
constexpr double kUnknownGapWidth = 0.004;
constexpr double kNothing = 0.03;  // of shrinkage
constexpr double kTemperature = 1.5;
constexpr double kTemperatureShare = 0.001;
constexpr double kTemperatureMostGain = 1e4;

double Logistic(double x) { return 1.0 / (1.0 + std::exp(-std::clamp(x, -50.0, 50.0))); }

}  // namespace

double Unexplained(const Evidence& at) {
  return std::max(0.0, at.acoustic_slack - kAcousticAllowance) +
         std::max(0.0, at.flame_slack - kFlameAllowance);
}

Belief Weigh(const Evidence& at) {
  const double rest = Unexplained(at);
  Belief out;
  const double detection = std::max(DetectionGain(at.flame_alone), at.gain_of_noise);
  out.none = Logistic((detection - at.gain) / kDetectionWidth) *
             Logistic((kUnexplainedDetection - rest) / kUnexplainedWidth);
  // A fit whose noise had to grow is no fit, even if no candidate improves it.
  out.none *= Logistic((kGapOverFloor - at.gap_before / std::max(at.gap_floor, 1e-12)) /
                       kGapOverFloorWidth);
  if (at.model_free) out.none = 0.0;
  if (!at.model_free && rest > 0.5 * kUnexplainedDetection) {
    const double share = at.confirmed ? kConfirmedUnknownShare : kUnknownShare;
    out.unknown = Logistic((rest / (rest + std::max(0.0, at.gain)) - share) / kUnknownWidth);
  }
  if (!at.model_free && !at.confirmed) {
    // Nor may the held-out gap stay well above the floor.
    const double above = std::pow(at.gap_after, 2) - 4.0 * std::pow(at.gap_floor, 2);
    const double left = std::max(0.0, above) / std::max(std::pow(at.gap_before, 2), 1e-300);
    out.unknown = std::max(out.unknown, Logistic((left - kUnknownGapShare) / kUnknownGapWidth));
  }
  if (at.form_is_wrong) out.unknown = std::max(out.unknown, kUnexplainedFact);
  if (at.unexplained_lines || at.unexplained_samples) {
    out.none = 0.0;
    out.unknown = std::max(out.unknown, kUnexplainedFact);
  }
  return out;
}

bool IsNoBetterThanPlacebo(double shrinkage, double placebo_shrinkage) {
  return placebo_shrinkage > kNothing && placebo_shrinkage >= shrinkage;
}

double Temperature(double largest_gain) {
  return kTemperature + kTemperatureShare * std::clamp(largest_gain, 0.0, kTemperatureMostGain);
}

double DetectionGain(bool flame_alone) {
  return flame_alone ? kFlameDetectionGain : kDetectionGain;
}

}  // namespace howl
