// Predictions of the family's members at operating points that were not measured: each member's
// path (operating_path.h) gives its loop there, and the loop gives
//
//   frequency    where arg L = 180 degrees (1a)
//   growth rate  of the rest state: of the pole that carries the oscillation (oscillation_pole.h)
//   amplitude    of the limit cycle with a saturating flame, by its describing function,
//                |L D(A)| = 1 (one harmonic); zero where (1b) does not hold, |L Phi'(0)| <= 1
//   unstable     (1b) holds there or, with two modes, at the crossing near the second mode
//
// An interval holds 95 % of the members' paths. It is no guarantee: that one exists at a measured
// point alone, where (1a) holds within the test's tolerance at the measured frequency f_k. The
// phase of a loop with one mode falls by more than 360 tau degrees a hertz, so that
//
//   |f - f_k| <= loop_phase_tolerance_deg / (360 min tau)
//
// for every member, min tau being the guaranteed bound.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_PREDICT_POINTS_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_PREDICT_POINTS_H_

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "estimation/analysis/flame/flame_shape.h"
#include "estimation/family/answers/predict/operating_path.h"

namespace howl {

// The median of the members' values, and the interval that holds 95 % of them; NaN without any.
struct SampledValue {
  double median = std::numeric_limits<double>::quiet_NaN();
  double lo = std::numeric_limits<double>::quiet_NaN();
  double hi = std::numeric_limits<double>::quiet_NaN();
};
SampledValue Summarise(std::vector<double> values);  // those that are finite

// The flame's saturation, which limits the cycle.
struct PredictedFlame {
  // Of each experiment whose record gave one; empty where none did. Between them the saturation's
  // logarithm is linear in phi, shape and offset are those of the nearest, beyond them all are.
  std::vector<std::optional<FlameShapeFit>> measured;
  // In the place of the measured ones: as the config states it.
  std::optional<Flame<double>> stated;

  // Neither: a hyperbolic tangent, whose amplitudes are ratios.
  bool IsAssumed() const;
  Flame<double> At(std::span<const Experiment> experiments, double phi, double slope) const;
};

struct PointPrediction {
  double phi = 0.0;
  PointKind kind = PointKind::kBetween;
  bool rests_on_unreliable = false;
  std::size_t members = 0;  // paths that have a loop there; zero at kOutside
  std::size_t without = 0;  // paths that have none
  SampledValue frequency_hz;
  SampledValue growth_rate;  // 1/s
  SampledValue loop_gain;    // |L Phi'(0)|
  // Of p, in its units; with an assumed flame of q, over the flame's saturation.
  SampledValue amplitude;
  double share_unstable = std::numeric_limits<double>::quiet_NaN();
};

// A prediction for each phi; without a flame slope in any experiment it has frequencies alone.
std::vector<PointPrediction> PredictPoints(const FamilyProblem& problem,
                                           const OperatingPoints& points,
                                           std::span<const MemberPath> paths,
                                           const PredictedFlame& flame, std::span<const double> phi,
                                           int threads);

// The half width of the guaranteed frequency at a measured point; no value with two modes, whose
// phase may rise, and without a bound of tau or a tolerance.
std::optional<double> GuaranteedReachHz(const FamilyProblem& problem, double tau_min_s);

// The range of phi in which there is a cycle: going up and down from the measured point of the
// largest median
// loop gain, the first phi at which a path's loop gain |L Phi'(0)| at the first mode's crossing
// falls to one (the growth rate of that mode crosses zero there), up to as far beyond the measured
// points as their range is wide. Paths that are stable at the start are left out.
struct CycleEnd {
  // Over the paths; infinite where so many do not cross within the range.
  double median = std::numeric_limits<double>::infinity();
  double lo = std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  double share_crossing = 0.0;
};
struct CycleLimits {
  double from_phi = 0.0;        // the start
  double share_unstable = 0.0;  // of the paths, there
  CycleEnd below, above;        // an end below is minus infinity where paths do not cross
};
std::optional<CycleLimits> FindCycleLimits(const OperatingPoints& points,
                                           std::span<const MemberPath> paths, int threads);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_PREDICT_POINTS_H_
