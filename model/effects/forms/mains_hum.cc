// 50 or 60 Hz and its multiples in one recorded channel.
#include <cmath>
#include <limits>
#include <numbers>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// Simulated with the odd multiples of a rectifier: rel cos(w t) + rel / 3 cos(3 w t + ...) + ...
constexpr int kMultiples[] = {1, 3, 5};

class HumInstrument final : public ChannelInstrument {
 public:
  HumInstrument(Channel channel, double amplitude, double hz)
      : ChannelInstrument(channel), amplitude_(amplitude), hz_(hz) {}
  std::unique_ptr<Instrument> Clone() const override {
    return std::make_unique<HumInstrument>(*this);
  }
  void Start(double rate_hz, std::uint64_t seed) override {
    rate_hz_ = rate_hz;
    RandomStream stream(seed);
    for (double& phase : phase_rad_) phase = 2.0 * std::numbers::pi * stream.Uniform();
  }

 protected:
  void ApplyToChannel(double time_s, std::span<double> signal) override {
    for (std::size_t i = 0; i < signal.size(); ++i) {
      const double angle = kRadPerSPerHz * hz_ * (time_s + static_cast<double>(i) / rate_hz_);
      for (std::size_t k = 0; k < std::size(kMultiples); ++k) {
        signal[i] += amplitude_ / kMultiples[k] * std::cos(kMultiples[k] * angle + phase_rad_[k]);
      }
    }
  }

 private:
  double amplitude_;
  double hz_;
  double rate_hz_ = 1.0;
  double phase_rad_[std::size(kMultiples)] = {};
};

class Hum final : public NamedEffect {
 public:
  explicit Hum(Channel channel)
      : NamedEffect("mains_hum",
                    channel == Channel::kPressure ? LoopBlock::kPressureInstrument
                                                  : LoopBlock::kHeatReleaseInstrument,
                    {{"rel", "", 0.0, 0.0, 10.0, {}}, {"hz", "Hz", 50.0, 50.0, 60.0, {}}}),
        channel_(channel) {}
  EffectKind kind() const override { return EffectKind::kHum; }
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
  EffectForm form() const override {
    return {"channel", channel_ == Channel::kPressure ? "p" : "q"};
  }
  bool AddTo(const SimulationScale& scale, EffectValues x, RigParameters* rig) const override {
    const bool p = channel_ == Channel::kPressure;
    rig->instruments.push_back(std::make_shared<HumInstrument>(
        channel_, x[0] * (p ? scale.pressure_amplitude : scale.heat_release_amplitude), x[1]));
    return true;
  }

 private:
  Channel channel_;
};

}  // namespace

std::vector<EffectPointer> MainsHum(const CatalogueBase& /*base*/) {
  return {std::make_shared<Hum>(Channel::kHeatRelease)};
}

std::vector<EffectPointer> MainsHumInPressure() {
  return {std::make_shared<Hum>(Channel::kPressure)};
}

}  // namespace howl
