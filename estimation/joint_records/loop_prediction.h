// The loop of small signals at an operating point, measured or not, from those that the records of
// several points show (small_signal_loop.h): its frequency f, growth rate sigma and gain g.
//
// From point to point is carried what a record fixes, and not each parameter by itself, whose
// errors make up for one another: ln f, sigma / (2 pi f) and ln g each follow the law of
// parameter_law.h,
//
//   u_e = m + b z_e + s e_e
//
// with what each record tells of them as evidence. Of another point the law gives Student's density
// about m + b z, which allows for the error of the line and of s. At a measured point the density
// is normal, with the errors of its record. Nothing of it is guaranteed.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_LOOP_PREDICTION_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_LOOP_PREDICTION_H_

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "estimation/joint_records/onset.h"
#include "estimation/joint_records/parameter_law.h"

namespace howl {

// Median, and the interval that holds 95 %; NaN where nothing can be said.
struct PredictedValue {
  double value;
  double lo;
  double hi;
};

struct RestLoopPrediction {
  std::optional<std::size_t> measured;  // the point that was measured there
  PredictedValue frequency_hz;
  PredictedValue growth_rate_1_s;
  PredictedValue loop_gain;
  double share_unstable;  // the probability that small oscillations grow; NaN
};

// Without values.
RestLoopPrediction NoPrediction();

class LoopPredictor {
 public:
  // Points without a root are left out. Without two that have different operating parameters there
  // are predictions at measured points alone.
  explicit LoopPredictor(std::span<const OnsetPoint> points);

  RestLoopPrediction At(double operating_parameter) const;

 private:
  RestLoopPrediction Measured(std::size_t e) const;
  RestLoopPrediction Elsewhere(double operating_parameter) const;

  std::vector<OnsetPoint> points_;
  double mean_ = 0.0;  // of the operating parameter
  double deviation_ = 0.0;
  std::optional<ParameterLaw> law_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_LOOP_PREDICTION_H_
