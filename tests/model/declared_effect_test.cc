// Formulas of a user's effect against closed forms, and their nulls against the base bit for bit.
#include "model/effects/declared_effect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "model/numerics/constants.h"

namespace howl::declared_effect_test {
namespace {

EffectDeclaration Declare(LoopPlace place, DeclaredForm form, const std::string& formula,
                          std::vector<EffectParameter> parameters) {
  EffectDeclaration out;
  out.name = "mine";
  out.place = place;
  out.form = form;
  out.parameters = std::move(parameters);
  FormulaError error;
  const auto parsed = DeclaredFormula::Parse(formula, place, form, out.parameters, error);
  EXPECT_TRUE(parsed.has_value()) << error.message;
  if (parsed) out.numerator = {*parsed};
  return out;
}

EffectParameter Parameter(const std::string& name, double null_value) {
  EffectParameter p;
  p.name = name;
  p.null_value = null_value;
  p.low = 1.0;
  p.high = 2.0;
  p.starts = {1.5};
  return p;
}

TEST(DeclaredEffect, ResonanceIsItsClosedForm) {
  const DeclaredEffect effect(Declare(LoopPlace::kPressureRecorded, DeclaredForm::kTransfer,
                                      "1 / (1 + 2*zeta*s/(2*pi*f0_hz) + (s/(2*pi*f0_hz))^2)",
                                      {Parameter("f0_hz", kInfinity), Parameter("zeta", 0.2)}));
  const std::vector<double> x = {600.0, 0.15};
  for (const double f : {30.0, 206.0, 600.0, 1700.0}) {
    const std::complex<double> u(0.0, f / 600.0);
    const std::complex<double> expected = 1.0 / (1.0 + 2.0 * 0.15 * u + u * u);
    EXPECT_LT(std::abs(effect.PressureInstrument(f, x) - expected), 1e-12 * std::abs(expected));
    EXPECT_EQ(effect.HeatReleaseInstrument(f, x), 1.0);
  }
  EXPECT_TRUE(effect.ChangesAcousticCut());
  EXPECT_TRUE(effect.ChangesFlameInput());
  EXPECT_LE(effect.FromBase(NullValues(effect)).distance, 1e-15);
  // An infinite frequency with any damping is the base too.
  EXPECT_LE(effect.FromBase(std::vector<double>{kInfinity, 0.7}).distance, 1e-15);
}

TEST(DeclaredEffect, PolynomialsAreTheFormula) {
  EffectDeclaration declaration =
      Declare(LoopPlace::kFlameOut, DeclaredForm::kTransfer, "w", {Parameter("w", 500.0)});
  FormulaError error;
  for (const char* const text : {"1", "w"}) {
    declaration.denominator.push_back(*DeclaredFormula::Parse(
        text, declaration.place, declaration.form, declaration.parameters, error));
  }
  const DeclaredEffect effect(declaration);
  const std::vector<double> x = {300.0};
  const Response s = LaplaceVariable(70.0);
  EXPECT_LT(std::abs(effect.FlameOut(70.0, {}, x) - 300.0 / (s + 300.0)), 1e-15);
}

TEST(DeclaredEffect, AddedDelayIsAPhase) {
  const DeclaredEffect effect(Declare(LoopPlace::kHeatReleaseRecorded, DeclaredForm::kDelay,
                                      "lag_s", {Parameter("lag_s", 0.0)}));
  const std::vector<double> x = {2e-4};
  const double angle = -2.0 * 3.14159265358979323846 * 700.0 * 2e-4;
  EXPECT_LT(std::abs(effect.HeatReleaseInstrument(700.0, x) - std::polar(1.0, angle)), 1e-14);
}

TEST(DeclaredEffect, DelayFactorKnowsTheOperatingPoint) {
  const DeclaredEffect effect(Declare(LoopPlace::kDelay, DeclaredForm::kDelay,
                                      "1 + span * phi_position", {Parameter("span", 0.0)}));
  const EffectContext at{0.25, 207.0, 1.2, 0.08};
  EXPECT_DOUBLE_EQ(effect.DelayFactor(at, std::vector<double>{0.4}), 1.1);
  EXPECT_EQ(effect.block(), LoopBlock::kDelay);
}

TEST(DeclaredEffect, AnotherModeThroughG) {
  const DeclaredEffect effect(Declare(LoopPlace::kAcoustics, DeclaredForm::kTransfer,
                                      "1 + c * N * s / (s^2 + 0.1 * s * w + w^2) / G",
                                      {Parameter("c", 0.0), Parameter("w", 3000.0)}));
  const Acoustics<double> acoustics{213.7, 0.17, 6609.0, 1900.0, 3.0};
  const Complex<double> g = AcousticResponse(acoustics, 330.0);
  const Response s = LaplaceVariable(330.0);
  const Response mode = 0.2 * 6609.0 * s / (s * s + 0.1 * s * 2500.0 + 2500.0 * 2500.0);
  const Response expected = Response(g.re, g.im) + mode;
  EXPECT_LT(
      std::abs(effect.Acoustics(acoustics, 330.0, {}, std::vector<double>{0.2, 2500.0}) - expected),
      1e-12 * std::abs(expected));
}

TEST(DeclaredEffect, NullIsTheBaseBitForBit) {
  // A formula whose null is one but for rounding.
  const DeclaredEffect effect(Declare(LoopPlace::kAcoustics, DeclaredForm::kTransfer,
                                      "a / 3 + a * 2 / 3 + s * 0", {Parameter("a", 1.0)}));
  const Acoustics<double> acoustics{213.7, 0.17, 6609.0, 1900.0, 3.0};
  const Complex<double> g = AcousticResponse(acoustics, 77.7);
  EXPECT_EQ(effect.Acoustics(acoustics, 77.7, {}, NullValues(effect)), Response(g.re, g.im));
}

TEST(DeclaredEffect, DistanceTellsAWrongNull) {
  const DeclaredEffect effect(Declare(LoopPlace::kFlameIn, DeclaredForm::kTransfer,
                                      "1 / (1 + s / (2*pi*corner_hz))",
                                      {Parameter("corner_hz", 1000.0)}));
  // Largest at the highest frequency looked at: |1 / (1 + 20 j) - 1|.
  EXPECT_NEAR(effect.FromBase(NullValues(effect)).distance, 20.0 / std::sqrt(401.0), 1e-12);
  EXPECT_EQ(effect.FromBase(NullValues(effect)).at, 2e4);
}

TEST(DeclaredFormula, NamesWhatItDoesNotKnow) {
  FormulaError error;
  EXPECT_FALSE(
      DeclaredFormula::Parse("1 + G", LoopPlace::kFlameOut, DeclaredForm::kTransfer, {}, error));
  EXPECT_EQ(error.position, 4u);
  EXPECT_EQ(error.message, "unknown name G, expected s, f_hz, j, pi or a function");
}

}  // namespace
}  // namespace howl::declared_effect_test
