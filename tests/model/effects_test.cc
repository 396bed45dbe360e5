// Every effect of the catalogue at its null is the base, bit for bit, in every place of the loop;
// away from it, the closed forms of its equation.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <set>
#include <string>

#include "model/effects/catalogue.h"
#include "tests/model/find_effect.h"

namespace howl::effects_test {
namespace {

constexpr Acoustics<double> kAcoustics{213.7, 0.17, 6609.0, 1900.0, 3.0};
const EffectContext kContext{0.31, 207.0, 1.2, 0.08};

bool SameBits(Response a, Response b) { return a.real() == b.real() && a.imag() == b.imag(); }

EffectPointer Find(std::string_view id, std::size_t form = 0) {
  return FindIn(Catalogue(), id, form);
}

TEST(Effects, NullIsTheBaseBitForBit) {
  for (const EffectPointer& effect : Catalogue()) {
    const std::vector<double> x = NullValues(*effect);
    for (const double f : {3.1, 33.3, 207.0, 750.1, 1655.5}) {
      const Complex<double> g = AcousticResponse(kAcoustics, f);
      const Response q(0.731, -2.17);
      EXPECT_TRUE(SameBits(effect->Acoustics(kAcoustics, f, kContext, x), {g.re, g.im}))
          << effect->id();
      for (const Response factor :
           {effect->PressureInstrument(f, x), effect->HeatReleaseInstrument(f, x),
            effect->FlameIn(f, kContext, x), effect->FlameOut(f, kContext, x)}) {
        EXPECT_TRUE(SameBits(q * factor, q)) << effect->id();
        EXPECT_TRUE(SameBits(q / factor, q)) << effect->id();
      }
      EXPECT_TRUE(SameBits(effect->PressureLeak(f, kContext, x), 0.0)) << effect->id();
    }
    EXPECT_EQ(effect->DelayFactor(kContext, x), 1.0) << effect->id();
    EXPECT_EQ(effect->DelayPerAmplitude(x), 0.0) << effect->id();
    double omega_factor = 1.0;
    double xi_add = 0.0;
    effect->ModulateAcoustics(0.4, 1.3, x, &omega_factor, &xi_add);
    EXPECT_EQ(omega_factor, 1.0) << effect->id();
    EXPECT_EQ(xi_add, 0.0) << effect->id();
  }
}

TEST(Effects, TwentyTwoIdentifiers) {
  std::set<std::string> ids;
  for (const EffectPointer& effect : Catalogue()) {
    ids.insert(std::string(effect->id()));
    EXPECT_FALSE(effect->parameters().empty()) << effect->id();
    for (const EffectParameter& p : effect->parameters()) {
      EXPECT_LT(p.low, p.high) << effect->id();
      for (const double start : p.starts) {
        EXPECT_GE(start, p.low) << effect->id();
        EXPECT_LE(start, p.high) << effect->id();
      }
    }
  }
  EXPECT_EQ(ids.size(), 22u);
}

TEST(Effects, FirstOrderFiltersAtTheirCutOff) {
  for (const char* id : {"q_sensor_lowpass", "flame_lowpass"}) {
    const EffectPointer effect = Find(id);
    const std::vector<double> x = {300.0};
    const Response at =
        effect->HeatReleaseInstrument(300.0, x) * effect->FlameOut(300.0, kContext, x);
    EXPECT_NEAR(std::abs(at), std::sqrt(0.5), 1e-14) << id;
    EXPECT_NEAR(std::arg(at), -std::atan(1.0), 1e-14) << id;
  }
}

TEST(Effects, HighPassesAtTheirCutOff) {
  const std::vector<double> x = {30.0};
  const Response p = Find("p_sensor_highpass")->PressureInstrument(30.0, x);
  const Response q = Find("q_sensor_highpass")->HeatReleaseInstrument(30.0, x);
  for (const Response at : {p, q}) {
    EXPECT_NEAR(std::abs(at), std::sqrt(0.5), 1e-14);
    EXPECT_NEAR(std::arg(at), std::atan(1.0), 1e-14);
  }
  EXPECT_EQ(Find("p_sensor_highpass")->PressureInstrument(0.0, x), 0.0);
  EXPECT_EQ(Find("p_sensor_highpass")->HeatReleaseInstrument(30.0, x), 1.0);
  EXPECT_EQ(Find("q_sensor_highpass")->PressureInstrument(30.0, x), 1.0);
}

TEST(Effects, ButterworthAtItsCutOff) {
  const EffectPointer effect = Find("q_sensor_lowpass", 1);
  const std::vector<double> x = {300.0};
  EXPECT_NEAR(std::abs(effect->HeatReleaseInstrument(300.0, x)), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(std::arg(effect->HeatReleaseInstrument(300.0, x)), -2.0 * std::atan(1.0), 1e-14);
}

TEST(Effects, ResonanceGainsOneOverTwoZeta) {
  const std::vector<double> x = {757.0, 0.15};
  const Response at = Find("p_sensor_resonance")->PressureInstrument(757.0, x);
  EXPECT_NEAR(std::abs(at), 1.0 / 0.3, 1e-12);
}

TEST(Effects, SkewIsADelayOfQ) {
  const std::vector<double> x = {-2e-4};
  const Response at = Find("channel_skew")->HeatReleaseInstrument(500.0, x);
  EXPECT_NEAR(std::arg(at), 2.0 * M_PI * 500.0 * 2e-4, 1e-12);
  EXPECT_NEAR(std::abs(at), 1.0, 1e-14);
}

TEST(Effects, DetunedToThreeIsTheBase) {
  const std::vector<double> x = {2.6};
  Acoustics<double> moved = kAcoustics;
  moved.harmonic_ratio = 2.6;
  const Complex<double> g = AcousticResponse(moved, 420.0);
  EXPECT_TRUE(
      SameBits(Find("mode_detuning")->Acoustics(kAcoustics, 420.0, kContext, x), {g.re, g.im}));
}

TEST(Effects, TwoPathsCancelWhereTheyAreOpposed) {
  const EffectPointer path = Find("second_delay_path");
  const std::vector<double> x = {0.5, 2e-3};  // opposed at 250 Hz
  EXPECT_NEAR(std::abs(path->FlameIn(250.0, kContext, x)), 0.0, 1e-14);
}

TEST(Effects, ModePeaksWhereItIsPut) {
  const EffectPointer mode = Find("extra_acoustic_mode");
  const std::vector<double> x = {5.0, 0.2, 0.02};
  const double f = 5.0 * kAcoustics.omega_hz;
  const Complex<double> base = AcousticResponse(kAcoustics, f);
  const Response added = mode->Acoustics(kAcoustics, f, kContext, x) - Response(base.re, base.im);
  // c N / (2 zeta w), real.
  EXPECT_NEAR(added.real(), 0.2 * kAcoustics.N / (2.0 * 0.02 * 2.0 * M_PI * f), 1e-12);
  EXPECT_NEAR(added.imag(), 0.0, 1e-12);
}

}  // namespace
}  // namespace howl::effects_test
