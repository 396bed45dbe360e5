// Recorded q is shifted in time against p: e^(-skew s), positive when q comes late.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"
#include "model/numerics/lagrange.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

// x -> x(t - delay), by interpolation of order 6 among the samples that there are.
class LateChannel final : public ChannelInstrument {
 public:
  LateChannel(Channel channel, double delay_s) : ChannelInstrument(channel), delay_s_(delay_s) {}
  std::unique_ptr<Instrument> Clone() const override {
    return std::make_unique<LateChannel>(*this);
  }
  void Start(double rate_hz, std::uint64_t /*seed*/) override {
    const double steps = delay_s_ * rate_hz;
    const double first = std::max(0.0, std::floor(steps) + kFirstNode<kNodes>);
    weights_ = LagrangeWeights<kNodes>(steps - first + kFirstNode<kNodes>);
    past_.assign(static_cast<std::size_t>(first) + kNodes, 0.0);
    at_ = 0;
    first_ = true;
  }

 protected:
  void ApplyToChannel(double /*time_s*/, std::span<double> signal) override {
    if (delay_s_ == 0.0) return;
    const std::size_t n = past_.size();
    for (double& x : signal) {
      if (first_) std::fill(past_.begin(), past_.end(), x);
      first_ = false;
      past_[at_] = x;  // the oldest, n - 1 samples ago, comes next
      std::size_t read = at_ + 1 == n ? 0 : at_ + 1;
      at_ = read;
      double sum = 0.0;
      for (std::size_t j = kNodes; j-- > 0;) {
        sum += weights_[j] * past_[read];
        read = read + 1 == n ? 0 : read + 1;
      }
      x = sum;
    }
  }

 private:
  static constexpr int kNodes = 6;
  double delay_s_;
  std::array<double, kNodes> weights_{};
  std::vector<double> past_;
  std::size_t at_ = 0;
  bool first_ = true;
};

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
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    // Where a record begins is arbitrary: q early is p late.
    rig->instruments.push_back(std::make_shared<LateChannel>(
        x[0] < 0.0 ? Channel::kPressure : Channel::kHeatRelease, std::abs(x[0])));
    return true;
  }
};

}  // namespace

std::vector<EffectPointer> ChannelSkew(const CatalogueBase& /*base*/) {
  return {std::make_shared<Skew>()};
}

}  // namespace howl
