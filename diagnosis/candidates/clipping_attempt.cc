#include "diagnosis/candidates/attempt.h"
#include "diagnosis/records/channel_signal.h"
#include "diagnosis/samples/static_map.h"

namespace howl {
namespace {

constexpr double kPlateauNoise = 0.45;

}  // namespace

Attempt TryClipping(const AttemptContext& at, const Effect& effect) {
  Attempt out = Named(at, effect);
  const Channel channel = ChannelOf(effect.block());
  const bool pressure = channel == Channel::kPressure;
  ClippingFit clipping = FitClipping(*at.records, channel, *at.base);
  if (at.reference) {
    clipping.gain =
        std::max(0.0, clipping.gain - 2.0 * (pressure ? at.reference->pressure_clipping_gain
                                                      : at.reference->heat_release_clipping_gain));
    clipping.sharp_edge &=
        !(pressure ? at.reference->pressure_sharp_edge : at.reference->heat_release_sharp_edge);
  }
  out.candidate.gain = clipping.gain;
  out.candidate.parameters.push_back(WithoutError("fraction", clipping.fraction, ""));
  for (std::size_t e = 0; e < out.held_out.size(); ++e) {
    out.held_out[e].acoustic_residual = clipping.fit.experiments[e].acoustic_residual;
  }
  out.model_free = clipping.sharp_edge;
  out.confirmed = clipping.sharp_edge || clipping.plateau_noise < kPlateauNoise;
  out.parameters = kClippingShapes * static_cast<double>(out.held_out.size());
  return out;
}

}  // namespace howl
