#include "estimation/analysis/second_crossing.h"

#include <cmath>

#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kLeastShare = 0.01;  // of the cycle's amplitude: weaker lines are noise's
constexpr double kAbove = 1.05;       // of the cycle's frequency

// The phase by which the paper's loop, with one delay at both crossings, misses the published line:
// its table leaves 10 to 30 degrees. Beyond that and the interval of the phase the loop does not
// close.
constexpr double kClosesWithinDeg = 30.0;

}  // namespace

Estimate LoopPhaseErrorAt(const Analysis& analysis, const SpectralLine& line) {
  if (!analysis.tau_s || !std::isfinite(line.phase_deg.value)) return {};
  const double turn_s = 360.0 * line.frequency_hz.value;
  const double tau_std_s = std::isfinite(analysis.tau_s->std) ? analysis.tau_s->std : 0.0;
  return {WrapDeg(line.phase_deg.value - 90.0 - turn_s * analysis.tau_s->value),
          std::hypot(line.phase_deg.std, turn_s * tau_std_s)};
}

Estimate LoopGainAt(const Analysis& analysis, const SpectralLine& line) {
  if (!analysis.loop_gain) return {};
  if (!(line.q_amplitude > 0.0)) return {0.0, 0.0};
  const Characteristics& cycle = analysis.characteristics;
  const double gain = analysis.loop_gain->value * line.p_amplitude / line.q_amplitude /
                      cycle.gain.value * line.frequency_hz.value / cycle.frequency_hz.value;
  // The relative error of |P / Q| is that of its phase in radians.
  return {gain, gain * std::hypot(line.phase_deg.std * kRadPerDeg,
                                  analysis.loop_gain->std / analysis.loop_gain->value)};
}

const SpectralLine* FindSecondCrossing(const Analysis& analysis) {
  const Characteristics& cycle = analysis.characteristics;
  const SpectralLine* strongest = nullptr;
  for (const SpectralLine& line : analysis.lines) {
    if (line.harmonic != 0) continue;
    if (line.p_amplitude < kLeastShare * cycle.p_amplitude) continue;
    if (line.frequency_hz.value < kAbove * cycle.frequency_hz.value) continue;
    if (strongest == nullptr || line.p_amplitude > strongest->p_amplitude) strongest = &line;
  }
  if (strongest == nullptr || !strongest->narrow) return nullptr;
  const Estimate error = LoopPhaseErrorAt(analysis, *strongest);
  if (!(std::abs(error.value) <= kClosesWithinDeg + kNormal95 * error.std)) return nullptr;
  const Estimate gain = LoopGainAt(analysis, *strongest);
  if (gain.value + kNormal95 * gain.std < 1.0) return nullptr;
  return strongest;
}

}  // namespace howl
