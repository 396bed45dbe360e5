#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "diagnosis/candidates/attempt.h"

namespace howl {
namespace {

std::vector<ExperimentFit> HoldOutAll(const AttemptContext& at, const EffectFit& fit) {
  std::vector<ExperimentFit> out;
  for (std::size_t e = 0; e < at.records->size(); ++e) {
    out.push_back(HeldOut(*at.records, fit, e));
    if (!fit.effect->ChangesAcousticCut()) {
      out.back().acoustic_residual = at.base_held_out[e].acoustic_residual;
    }
    if (!fit.effect->ChangesFlameCut()) {
      out.back().flame_residual = at.base_held_out[e].flame_residual;
    }
  }
  return out;
}

}  // namespace

Attempt FromFit(const AttemptContext& at, EffectFit fit) {
  Attempt out;
  out.candidate.effect = fit.effect->id();
  out.candidate.block = fit.effect->block();
  out.parameters = static_cast<double>(fit.values.size());
  out.candidate.gain = GainOver(*at.base, fit);
  for (std::size_t j = 0; j < fit.values.size(); ++j) {
    out.candidate.parameters.push_back(
        WithError(fit.effect->parameters()[j], fit.values[j], fit.standard_errors[j + 1]));
  }
  const EffectContext& context = (*at.records)[0].at;
  out.leaks = fit.effect->PressureLeak(context.cycle_frequency_hz, context, fit.values) != 0.0;
  out.held_out = HoldOutAll(at, fit);
  out.fit = std::move(fit);
  return out;
}

Attempt TryTransfer(const AttemptContext& at, const std::string& unit,
                    const std::vector<EffectPointer>& forms) {
  return FromFit(at, FitBestForm(at.memory, unit, *at.records, forms, *at.base));
}

}  // namespace howl
