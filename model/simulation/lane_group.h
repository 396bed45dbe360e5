// One group of up to W members carried through time together: their past, noise, effects and
// recorders. See model/simulation/simulate.h for the scheme and model/simulation/lane_loop.h for
// the inner loops.
#ifndef HOWL_MODEL_SIMULATION_LANE_GROUP_H_
#define HOWL_MODEL_SIMULATION_LANE_GROUP_H_

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/simulation/decimate.h"
#include "model/simulation/lane_loop.h"
#include "model/simulation/simulate.h"

namespace howl::internal {

// Numbers of the streams that a member's seed splits into.
enum class StreamKey : std::uint64_t {
  kCombustion = 1,
  kPressureSensor = 2,
  kHeatReleaseSensor = 3,
  kEffects = 1000,
  kInstruments = 2000,
  kDigitisers = 3000
};

struct ModeParameters {
  double omega_rad_s;
  double xi;
  double coefficient;
};

std::array<ModeParameters, kMaxModes> Modes(const RigParameters& rig,
                                            const LoopParameters<double>& loop);
LaneCoefficients MakeCoefficients(const RigParameters& rig, const LoopParameters<double>& loop,
                                  const Flame<double>& flame, double step_s);
int NumModes(const RigParameters& rig);

// From true signals to a record: instruments, anti-alias filter, sensor noise, digitisers.
class Recorder {
 public:
  Recorder(const SimulationCase& one, const SimulationOptions& options, int ratio);

  int half_length() const { return pressure_filter_.half_length(); }
  // Consecutive samples at the internal rate, from half_length() before the record's start on.
  void Push(std::span<double> pressure, std::span<double> heat_release);
  SimulatedRecord Finish();

 private:
  SimulatedRecord record_;
  std::size_t wanted_;
  std::size_t wanted_true_;
  std::size_t received_ = 0;
  Decimator pressure_filter_;
  Decimator heat_release_filter_;
  Noise noise_;
  std::uint64_t seed_;
  std::vector<std::unique_ptr<Instrument>> instruments_;
  std::vector<std::unique_ptr<Instrument>> digitisers_;
};

// Members with the same internal rate, number of modes and flame shape.
void RunLanes(std::span<const SimulationCase* const> cases, const SimulationOptions& options,
              double internal_hz, std::span<SimulatedRecord*> records);

}  // namespace howl::internal

#endif  // HOWL_MODEL_SIMULATION_LANE_GROUP_H_
