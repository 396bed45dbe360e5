// Places inside the loop where something beyond the base equations can act. An effect overrides
// the calls that it needs; the others leave every bit alone, and so must every call at the
// effect's null value.
//
//   p'(t) -> [Delay] -> v = p'(t - tau) -> [FlameIn] -> Phi -> [FlameOut] -> + n -> [Source] -> q
//   q + [Drive] -> acoustics, whose parameters [Parameters] may move slowly -> p, p'
//
// Blocks are of at most kLoopBlock consecutive samples. Members with effects run alone, not side
// by side in vector lanes; their bits do not depend on it.
#ifndef HOWL_MODEL_LOOP_LOOP_EFFECT_H_
#define HOWL_MODEL_LOOP_LOOP_EFFECT_H_

#include <cstdint>
#include <memory>
#include <span>

#include "model/loop/flame.h"
#include "model/loop/loop.h"

namespace howl {

inline constexpr int kLoopBlock = 32;

struct RigParameters;

// The past of p', interpolated to order 6.
class DelayLine {
 public:
  virtual ~DelayLine() = default;
  // out[i] = p'(t_i - delay_s[i]) for the block's samples t_i.
  virtual void Read(std::span<const double> delay_s, std::span<double> out) const = 0;
};

struct LoopContext {
  double time_s = 0.0;  // of the block's first sample, from the start of the record
  double step_s = 0.0;
  LoopParameters<double> loop;  // as they are in this block
  Flame<double> flame;
  // Amplitudes of sinusoids with the signals' mean square over the last 20 ms or so.
  double rate_amplitude = 0.0;
  double pressure_amplitude = 0.0;
  // Mean squares over the block before; at the start, over the past.
  double rate_square = 0.0;
  double pressure_square = 0.0;
  const DelayLine* delay_line = nullptr;
  std::span<const double> tau_s;  // delay at each sample, once Delay has been called
};

class LoopEffect {
 public:
  virtual ~LoopEffect() = default;
  virtual std::unique_ptr<LoopEffect> Clone() const = 0;

  // Before the first sample. `seed` is this effect's own.
  virtual void Start(const RigParameters& /*rig*/, double /*step_s*/, std::uint64_t /*seed*/) {}

  // Once a block, before all other calls: parameters for this block, from the rig's own.
  virtual void Parameters(const LoopContext& /*at*/, LoopParameters<double>* /*loop*/,
                          Flame<double>* /*flame*/) {}

  // Delay for each sample; called if MovesDelay().
  virtual bool MovesDelay() const { return false; }
  virtual void Delay(const LoopContext& /*at*/, std::span<double> /*tau_s*/) {}

  // What the effect reads of the past, given the loop's delay.
  virtual double ShortestDelay(double tau_s) const { return tau_s; }
  virtual double LongestDelay(double tau_s) const { return tau_s; }

  virtual void FlameIn(const LoopContext& /*at*/, std::span<double> /*v*/) {}
  virtual void FlameOut(const LoopContext& /*at*/, std::span<double> /*heat_release*/) {}
  virtual void Source(const LoopContext& /*at*/, std::span<double> /*heat_release*/) {}

  // Added to what drives the acoustics, not to the heat release; called if Drives().
  virtual bool Drives() const { return false; }
  virtual void Drive(const LoopContext& /*at*/, std::span<double> /*drive*/) {}
};

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_LOOP_EFFECT_H_
