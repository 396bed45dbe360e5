#include <algorithm>
#include <cmath>

#include "diagnosis/localise/free_factor.h"
#include "diagnosis/localise/free_slack.h"

namespace howl {
namespace {

constexpr int kCausal = 4;
constexpr int kAnticausal = 2;

class AcousticFactor final : public NamedEffect {
 public:
  explicit AcousticFactor(double centre_hz)
      : NamedEffect("slack_acoustics_factor", LoopBlock::kAcoustics,
                    FactorParameters(kCausal + kAnticausal)),
        centre_hz_(centre_hz) {}
  bool ChangesAcousticCut() const override { return true; }
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& at, EffectValues x) const override {
    return Effect::Acoustics(acoustics, frequency_hz, at, x) *
           FreeFactor(frequency_hz, centre_hz_, x.first(kCausal), x.subspan(kCausal));
  }

 private:
  double centre_hz_;
};

class Modes final : public NamedEffect {
 public:
  Modes()
      : NamedEffect("slack_acoustics_modes", LoopBlock::kAcoustics,
                    {{"upper_ratio", "", 3.0, 2.0, 4.5, {3.0}, ParameterScale::kLogarithmic},
                     {"upper_damping", "", 1.0, 0.1, 10.0, {1.0}, ParameterScale::kLogarithmic},
                     {"ratio",
                      "",
                      2.0,
                      0.25,
                      8.0,
                      {0.6, 1.6, 2.3, 3.7, 4.6, 5.6},
                      ParameterScale::kLogarithmic},
                     {"coeff_over_N", "", 0.0, -5.0, 5.0, {0.02}},
                     {"zeta", "", 0.05, 0.002, 0.6, {0.05}, ParameterScale::kLogarithmic}}) {}
  bool ChangesAcousticCut() const override { return true; }
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& /*at*/, EffectValues x) const override {
    const double w = kRadPerSPerHz * frequency_hz;
    const double omega = kRadPerSPerHz * acoustics.omega_hz;
    const Complex<double> upper = UnitModeResponse(x[0] * omega, x[1] * acoustics.xi, w);
    const Complex<double> more = UnitModeResponse(x[2] * omega, x[4], w);
    const Complex<double> first = FirstModeResponse(acoustics, frequency_hz);
    return Response(first.re, first.im) + acoustics.M * Response(upper.re, upper.im) +
           x[3] * acoustics.N * Response(more.re, more.im);
  }
};

class Modulation final : public NamedEffect {
 public:
  Modulation()
      : NamedEffect("slack_acoustics_modulation", LoopBlock::kAcoustics,
                    {{"omega_over_record", "", 0.0, -0.3, 0.3, {0.0}},
                     {"omega_over_amplitude", "", 0.0, -0.3, 0.3, {0.0}},
                     {"xi_over_record", "", 0.0, -0.3, 0.3, {0.0}},
                     {"xi_over_amplitude", "", 0.0, -0.5, 1.0, {0.0}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ModulatesAcoustics() const override { return true; }
  void ModulateAcoustics(double position, double amplitude, EffectValues x, double* omega_factor,
                         double* xi_add) const override {
    const double square = amplitude * amplitude;
    *omega_factor *= std::max(0.1, 1.0 + x[0] * position + x[1] * (square - 1.0));
    *xi_add += x[2] * position + x[3] * square;
  }
};

}  // namespace

std::vector<EffectPointer> FreeAcoustics(const SlackScale& scale) {
  return {std::make_shared<AcousticFactor>(scale.centre_hz), std::make_shared<Modes>(),
          std::make_shared<Modulation>()};
}

}  // namespace howl
