#include <utility>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/candidates/declared_fit.h"

namespace howl {

Attempt TryDeclaredMap(const AttemptContext& at, const DeclaredEffect& effect) {
  Attempt out = Named(at, effect);
  DeclaredMapFit map = FitDeclaredMap(*at.experiments, *at.records, *at.base, effect);
  out.candidate.gain = map.gain;
  for (std::size_t j = 0; j < map.values.size(); ++j) {
    const EffectParameter& p = effect.parameters()[j];
    out.candidate.parameters.push_back(WithoutError(p.name, map.values[j], p.unit));
    out.candidate.parameters.back().at_bound = StandsAtBound(p, map.values[j]);
  }
  out.held_out = std::move(map.held_out);
  return out;
}

Attempt TryDeclaredLine(const AttemptContext& at, const DeclaredEffect& effect,
                        const std::vector<CoherentLine>& lines) {
  Attempt out = Named(at, effect);
  const DeclaredLineFit line = FitDeclaredLine(*at.records, *at.base, lines, effect);
  out.candidate.gain = line.gain;
  out.without_lines = line.all_lines;
  if (line.gain > 0.0) {
    out.candidate.parameters.push_back(WithoutError("rel", line.relative_amplitude, ""));
    out.candidate.parameters.push_back(WithoutError("hz", line.frequency_hz, "Hz"));
  }
  // As many parameters as a line of the catalogue has.
  out.parameters = 2.0;
  return out;
}

}  // namespace howl
