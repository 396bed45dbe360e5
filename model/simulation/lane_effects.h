// The effects of one simulated rig, in the order in which the rig has them.
#ifndef HOWL_MODEL_SIMULATION_LANE_EFFECTS_H_
#define HOWL_MODEL_SIMULATION_LANE_EFFECTS_H_

#include <memory>
#include <span>
#include <vector>

#include "model/loop/loop_effect.h"
#include "model/simulation/simulate.h"

namespace howl::internal {

class LaneEffects {
 public:
  void Start(const SimulationCase& one, double step_s, const DelayLine* line);

  bool MovesDelay() const { return moves_delay_; }
  void Delay(std::span<double> tau_s);
  void FlameIn(std::span<double> v);
  void FlameOut(std::span<double> heat_release);
  void Source(std::span<double> heat_release);
  void Drive(std::span<double> drive);

  // Puts the loop and the flame, as the effects have them now, into `at`. False where they are as
  // they were.
  bool MoveParameters(const RigParameters& rig);

  LoopContext at;

 private:
  std::vector<std::unique_ptr<LoopEffect>> effects_;
  bool moves_delay_ = false;
};

}  // namespace howl::internal

#endif  // HOWL_MODEL_SIMULATION_LANE_EFFECTS_H_
