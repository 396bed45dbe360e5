#include "model/simulation/lane_effects.h"

#include "model/simulation/lane_group.h"

namespace howl::internal {
namespace {

bool SameLoop(const LoopParameters<double>& a, const LoopParameters<double>& b) {
  return a.acoustics.omega_hz == b.acoustics.omega_hz && a.acoustics.xi == b.acoustics.xi &&
         a.acoustics.N == b.acoustics.N && a.acoustics.M == b.acoustics.M &&
         a.acoustics.harmonic_ratio == b.acoustics.harmonic_ratio && a.tau_s == b.tau_s;
}

bool SameFlame(const Flame<double>& a, const Flame<double>& b) {
  return a.slope == b.slope && a.saturation == b.saturation && a.offset == b.offset;
}

}  // namespace

void LaneEffects::Start(const SimulationCase& one, double step_s, const DelayLine* line) {
  at.step_s = step_s;
  at.loop = one.rig.model.loop;
  at.flame = one.rig.model.flame;
  at.delay_line = line;
  for (const auto& effect : one.rig.effects) {
    effects_.push_back(effect->Clone());
    effects_.back()->Start(
        one.rig, step_s,
        DeriveSeed(one.seed, static_cast<std::uint64_t>(StreamKey::kEffects) + effects_.size()));
    moves_delay_ = moves_delay_ || effects_.back()->MovesDelay();
  }
}

void LaneEffects::Delay(std::span<double> tau_s) {
  for (const auto& effect : effects_) {
    if (effect->MovesDelay()) effect->Delay(at, tau_s);
  }
}

void LaneEffects::FlameIn(std::span<double> v) {
  for (const auto& effect : effects_) effect->FlameIn(at, v);
}

void LaneEffects::FlameOut(std::span<double> heat_release) {
  for (const auto& effect : effects_) effect->FlameOut(at, heat_release);
}

void LaneEffects::Source(std::span<double> heat_release) {
  for (const auto& effect : effects_) effect->Source(at, heat_release);
}

void LaneEffects::Drive(std::span<double> drive) {
  for (const auto& effect : effects_) {
    if (effect->Drives()) effect->Drive(at, drive);
  }
}

bool LaneEffects::MoveParameters(const RigParameters& rig) {
  LoopParameters<double> loop = rig.model.loop;
  Flame<double> flame = rig.model.flame;
  for (const auto& effect : effects_) effect->Parameters(at, &loop, &flame);
  if (SameLoop(loop, at.loop) && SameFlame(flame, at.flame)) return false;
  at.loop = loop;
  at.flame = flame;
  return true;
}

}  // namespace howl::internal
