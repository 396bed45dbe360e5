// A slow change of one parameter within a run (figure 7's axis, crossed while recording):
//
//   value(t) = own value * factor(t),   factor: first until start_s, last from end_s, linear
//   between
//
// The delay moves from sample to sample, the others from block to block of the simulator.
#ifndef HOWL_MODEL_SIMULATION_RAMP_H_
#define HOWL_MODEL_SIMULATION_RAMP_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "model/loop/loop_effect.h"

namespace howl {

enum class RampedParameter : std::uint8_t {
  kOmega,
  kXi,
  kN,
  kM,
  kHarmonicRatio,
  kTau,
  kFlameSlope,
  kFlameSaturation
};

class ParameterRamp final : public LoopEffect {
 public:
  ParameterRamp(RampedParameter parameter, double first_factor, double last_factor, double start_s,
                double end_s)
      : parameter_(parameter),
        first_(first_factor),
        last_(last_factor),
        start_s_(start_s),
        end_s_(end_s) {}

  std::unique_ptr<LoopEffect> Clone() const override;
  void Parameters(const LoopContext& at, LoopParameters<double>* loop,
                  Flame<double>* flame) override;
  bool MovesDelay() const override { return parameter_ == RampedParameter::kTau; }
  void Delay(const LoopContext& at, std::span<double> tau_s) override;

 private:
  double Factor(double time_s) const;

  RampedParameter parameter_;
  double first_;
  double last_;
  double start_s_;
  double end_s_;
};

// All parameters through given points in time, linear between them and constant outside: a ramp of
// the operating parameter, each point being the loop at one of its values.
class LoopSchedule final : public LoopEffect {
 public:
  struct Point {
    double time_s = 0.0;
    LoopParameters<double> loop;
    Flame<double> flame;
  };

  explicit LoopSchedule(std::vector<Point> points);  // at least one, in order of time

  std::unique_ptr<LoopEffect> Clone() const override;
  void Parameters(const LoopContext& at, LoopParameters<double>* loop,
                  Flame<double>* flame) override;
  bool MovesDelay() const override { return true; }
  void Delay(const LoopContext& at, std::span<double> tau_s) override;
  double ShortestDelay(double tau_s) const override;
  double LongestDelay(double tau_s) const override;

 private:
  struct Between {
    const Point* from;
    const Point* to;
    double share;
  };
  Between Find(double time_s) const;

  std::vector<Point> points_;
};

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_RAMP_H_
