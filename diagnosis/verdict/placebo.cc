#include "diagnosis/verdict/placebo.h"

#include <glog/logging.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "model/noise/random_stream.h"

namespace howl {
namespace {

constexpr double kMost = 0.5;
constexpr double kStart = 0.02;
// Periods of the phase over frequency: no base parameter changes a response in such a way.
constexpr double kShortestPeriod_hz = 150.0;
constexpr double kLongestPeriod_hz = 700.0;

// Turns of the phase over the whole range of operating points: no experiment tells of the next.
constexpr double kFewestTurns = 3.0;
constexpr double kMostTurns = 12.0;

struct Ripple {
  std::array<double, 3> per_hz{};
  std::array<double, 3> per_position{};
  std::array<double, 3> phase{};
  double offset = 0.0;

  Response At(double frequency_hz, double phi_position) const {
    double psi = offset;
    for (std::size_t i = 0; i < per_hz.size(); ++i) {
      psi += std::numbers::pi *
             std::sin(per_hz[i] * frequency_hz + per_position[i] * phi_position + phase[i]);
    }
    return std::polar(1.0, psi);
  }
};

Ripple DrawRipple(RandomStream* random) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Ripple out;
  for (std::size_t i = 0; i < out.per_hz.size(); ++i) {
    const double period =
        kShortestPeriod_hz + (kLongestPeriod_hz - kShortestPeriod_hz) * random->Uniform();
    out.per_hz[i] = kTurn / period;
    out.per_position[i] = kTurn * (kFewestTurns + (kMostTurns - kFewestTurns) * random->Uniform());
    out.phase[i] = kTurn * random->Uniform();
  }
  out.offset = kTurn * random->Uniform();
  return out;
}

std::vector<EffectParameter> Parameters(std::size_t count) {
  std::vector<EffectParameter> out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back({"x" + std::to_string(i + 1), "", 0.0, -kMost, kMost, {kStart}});
  }
  return out;
}

class Ripples final : public NamedEffect {
 public:
  Ripples(std::size_t parameters, bool acoustic_cut, bool flame_cut, std::uint64_t seed)
      : NamedEffect("placebo", LoopBlock::kAcoustics, Parameters(parameters)),
        acoustic_cut_(acoustic_cut),
        flame_cut_(flame_cut) {
    RandomStream random(seed);
    for (std::size_t i = 0; i < parameters; ++i) ripples_.push_back(DrawRipple(&random));
  }

  bool ChangesAcousticCut() const override { return acoustic_cut_; }
  bool ChangesFlameCut() const override { return flame_cut_; }
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& at, EffectValues x) const override {
    const Response base = Effect::Acoustics(acoustics, frequency_hz, at, x);
    return acoustic_cut_ ? base * Factor(frequency_hz, at, x) : base;
  }
  Response FlameOut(double frequency_hz, const EffectContext& at, EffectValues x) const override {
    return flame_cut_ ? Factor(frequency_hz, at, x) : 1.0;
  }

 private:
  Response Factor(double frequency_hz, const EffectContext& at, EffectValues x) const {
    Response out = 1.0;
    for (std::size_t i = 0; i < ripples_.size(); ++i) {
      out += x[i] * ripples_[i].At(frequency_hz, at.phi_position);
    }
    return out;
  }

  bool acoustic_cut_;
  bool flame_cut_;
  std::vector<Ripple> ripples_;
};

}  // namespace

EffectPointer PlaceboEffect(std::size_t parameters, bool acoustic_cut, bool flame_cut,
                            std::uint64_t seed) {
  CHECK_GT(parameters, 0u);
  CHECK(acoustic_cut || flame_cut);
  return std::make_shared<Ripples>(parameters, acoustic_cut, flame_cut, seed);
}

}  // namespace howl
