// Recorded q is shifted in time against p: e^(-skew s), positive when q comes late.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

class Skew final : public NamedEffect {
 public:
  Skew()
      : NamedEffect("channel_skew", LoopBlock::kHeatReleaseInstrument,
                    {{"skew_s", "s", 0.0, -3e-3, 3e-3, {-4e-4, 4e-4}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    if (x[0] == 0.0) return 1.0;
    return std::polar(1.0, -kRadPerSPerHz * frequency_hz * x[0]);
  }
};

}  // namespace

std::vector<EffectPointer> ChannelSkew() { return {std::make_shared<Skew>()}; }

}  // namespace howl
