#include "model/effects/combined.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <vector>

#include "model/effects/catalogue.h"
#include "tests/model/find_effect.h"

namespace howl::combined_test {
namespace {

TEST(Combined, FactorsMultiplyAndNullsAreTheOther) {
  const EffectPointer low_pass = FindIn(Catalogue(), "q_sensor_lowpass");
  const EffectPointer skew = FindIn(Catalogue(), "channel_skew");
  const EffectPointer both = Combine(low_pass, skew);
  EXPECT_EQ(both->id(), "q_sensor_lowpass+channel_skew");
  ASSERT_EQ(both->parameters().size(), 2U);
  EXPECT_EQ(both->parameters()[1].name, "channel_skew.skew_s");
  const std::vector<double> x = {300.0, 2e-4};
  for (const double f : {50.0, 210.0, 900.0}) {
    // First-order low-pass and a shift, in closed form.
    const Response truth =
        std::polar(1.0, -2.0 * std::numbers::pi * f * 2e-4) / Response(1.0, f / 300.0);
    EXPECT_LT(std::abs(both->HeatReleaseInstrument(f, x) - truth), 1e-12);
    const std::vector<double> first_alone = {300.0, 0.0};
    EXPECT_EQ(both->HeatReleaseInstrument(f, first_alone),
              low_pass->HeatReleaseInstrument(f, std::vector<double>{300.0}));
  }
}

TEST(Combined, AcousticsAddTheirChanges) {
  const EffectPointer mode = FindIn(Catalogue(), "extra_acoustic_mode");
  const EffectPointer detuned = FindIn(Catalogue(), "mode_detuning");
  const EffectPointer both = Combine(mode, detuned);
  const Acoustics<double> base{205.0, 0.15, 6000.0, 1500.0, 3.0};
  std::vector<double> x;
  for (const EffectPointer& effect : {mode, detuned}) {
    for (const EffectParameter& p : effect->parameters()) x.push_back(p.starts.back());
  }
  const std::size_t n = mode->parameters().size();
  const EffectValues all(x);
  for (const double f : {150.0, 500.0, 1200.0}) {
    const Complex<double> g = AcousticResponse(base, f);
    const Response truth = mode->Acoustics(base, f, {}, all.first(n)) +
                           detuned->Acoustics(base, f, {}, all.subspan(n)) - Response(g.re, g.im);
    EXPECT_LT(std::abs(both->Acoustics(base, f, {}, x) - truth), 1e-12 * std::abs(truth));
  }
}

}  // namespace
}  // namespace howl::combined_test
