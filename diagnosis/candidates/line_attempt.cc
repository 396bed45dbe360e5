#include <algorithm>

#include "diagnosis/candidates/attempt.h"

namespace howl {

Attempt TryLines(const AttemptContext& at, const Effect& effect,
                 const std::vector<CoherentLine>& lines, const LineOrigin& origin) {
  Attempt out = Named(at, effect);
  if (lines.empty()) return out;
  const bool hum = effect.kind() == EffectKind::kHum;
  const double in_channel = std::max(origin.heat_release_hum, origin.pressure_hum);
  if (hum) {
    out.candidate.gain = origin.mains ? in_channel : 0.0;
    out.candidate.block = origin.pressure_hum >= origin.heat_release_hum
                              ? LoopBlock::kPressureInstrument
                              : LoopBlock::kHeatReleaseInstrument;
    out.candidate.parameters.push_back(WithoutError("rel", origin.relative_amplitude, ""));
    out.candidate.parameters.push_back(WithoutError("hz", origin.mains_hz, "Hz"));
  } else {
    out.candidate.gain = origin.source;
    out.candidate.parameters.push_back(WithoutError("rel", origin.relative_amplitude, ""));
    out.candidate.parameters.push_back(WithoutError("hz", origin.frequency_hz, "Hz"));
  }
  out.without_lines = true;
  return out;
}

}  // namespace howl
