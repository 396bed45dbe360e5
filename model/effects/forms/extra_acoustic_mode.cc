// One more mode in G: c N s / (s^2 + 2 zeta w s + w^2), w = ratio omega. What is broader than zeta
// of 0.15 is no mode of its own: it would reshape the modes that are there.
#include <cmath>
#include <limits>
#include <vector>

#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {
namespace {

constexpr int kRatios = 65;         // up to 8
constexpr double kSameMode = 0.02;  // of log frequency

// Half a line's width apart.
std::vector<double> Ratios() {
  std::vector<double> ratios;
  double ratio = 0.35;
  for (int i = 0; i < kRatios; ++i) {
    ratios.push_back(ratio);
    ratio *= 1.05;
  }
  return ratios;
}

class Mode final : public NamedEffect {
 public:
  Mode(int modes, double harmonic_ratio)
      : NamedEffect("extra_acoustic_mode", LoopBlock::kAcoustics,
                    {{"ratio",
                      "",
                      2.0,
                      0.25,
                      12.0,
                      {0.6, 1.5, 2.0, 2.5, 3.6, 4.4, 5.0, 5.6, 6.4, 7.2},
                      ParameterScale::kLogarithmic,
                      Ratios()},
                     {"coeff_over_N", "", 0.0, -5.0, 5.0, {0.3}},
                     {"zeta", "", 0.05, 0.002, 0.15, {0.05}, ParameterScale::kLogarithmic}}),
        modes_(modes),
        harmonic_ratio_(harmonic_ratio) {}
  bool ChangesAcousticCut() const override { return true; }
  // A second mode at the frequency of one that is there says that this one is no simple mode.
  bool IsOwnCause(EffectValues x) const override {
    return std::abs(std::log(x[0])) > kSameMode &&
           (modes_ == 1 || std::abs(std::log(x[0] / harmonic_ratio_)) > kSameMode);
  }
  std::vector<double> ModeRatios(EffectValues x) const override { return {x[0]}; }
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& at, EffectValues x) const override {
    const Response base = Effect::Acoustics(acoustics, frequency_hz, at, x);
    if (x[1] == 0.0) return base;
    const Complex<double> mode = UnitModeResponse(kRadPerSPerHz * x[0] * acoustics.omega_hz, x[2],
                                                  kRadPerSPerHz * frequency_hz);
    return base + x[1] * acoustics.N * Response(mode.re, mode.im);
  }
  std::string SimulationFault(const RigParameters& rig, EffectValues /*x*/) const override {
    return rig.extra_modes.size() < 2 ? "" : "is the third extra mode, expected at most two";
  }
  bool AddTo(const SimulationScale& /*scale*/, EffectValues x, RigParameters* rig) const override {
    const auto& acoustics = rig->model.loop.acoustics;
    rig->extra_modes.push_back({x[0] * acoustics.omega_hz, x[2], x[1] * acoustics.N});
    return true;
  }

 private:
  int modes_;  // of the base
  double harmonic_ratio_;
};

}  // namespace

std::vector<EffectPointer> ExtraAcousticMode(const CatalogueBase& base) {
  return {std::make_shared<Mode>(base.modes, base.harmonic_ratio)};
}

}  // namespace howl
