#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/records/channel_signal.h"
#include "diagnosis/samples/static_map.h"
#include "estimation/health/clipped_samples.h"

namespace howl {
namespace {

constexpr double kPlateauNoise = 0.45;

// Whether most records have samples that repeat at the ends of the range.
bool Repeats(const std::vector<CutRecord>& records, Channel channel) {
  const auto clipped = std::ranges::count_if(records, [&](const CutRecord& record) {
    const Eigen::VectorXd& signal = SignalOf(record, channel);
    return ShareClipped({signal.data(), static_cast<std::size_t>(signal.size())}) > 0.0;
  });
  return 2 * clipped > std::ssize(records);
}

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
  out.parameters = kClippingShapes * static_cast<double>(out.held_out.size());
  out.candidate.parameters.push_back(WithoutError("fraction", clipping.fraction, ""));
  for (std::size_t e = 0; e < out.held_out.size(); ++e) {
    out.held_out[e].acoustic_residual = clipping.fit.experiments[e].acoustic_residual;
  }
  // A flame that saturates makes as sharp an edge of q, and then p shows nothing of what is cut
  // off.
  out.model_free = clipping.sharp_edge && (pressure || Repeats(*at.records, channel) ||
                                           clipping.gain > PriceOfParameters(out.parameters));
  out.confirmed = out.model_free || clipping.plateau_noise < kPlateauNoise;
  return out;
}

}  // namespace howl
