// Sources of noise against the closed forms of their spectra, alone and through the loop.
#include "model/simulation/noise_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "model/cycles/prediction.h"
#include "model/loop/crossings.h"
#include "tests/model/density.h"
#include "tests/model/paper_loop.h"

namespace howl::noise_source_test {
namespace {

constexpr NoiseSpectrum kWhite{NoiseColour::kWhite, 0.0, 0.0};
constexpr NoiseSpectrum kLow{NoiseColour::kLowPass, 150.0, 0.0};
constexpr NoiseSpectrum kResonance{NoiseColour::kResonance, 120.0, 0.1};

// A mean over `segments` periodograms of Hann's window is known to 1 / sqrt(segments); four of
// them.
double Tolerance(double segments) { return 4.0 / std::sqrt(segments); }

TEST(NoiseProcess, DensityHoldsTheMeanSquare) {
  for (const NoiseSpectrum& spectrum : {kLow, kResonance}) {
    double sum = 0.0;
    // tan maps the half axis to a finite interval; the integrands are smooth there.
    constexpr int kPoints = 20000;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 0.5 * std::numbers::pi * (i + 0.5) / kPoints;
      const double f = 130.0 * std::tan(angle);
      const double slope = 130.0 / (std::cos(angle) * std::cos(angle));
      sum += spectrum.DensityPerSquare(f, 0.0) * slope * 0.5 * std::numbers::pi / kPoints;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
  EXPECT_DOUBLE_EQ(kWhite.DensityPerSquare(100.0, 5000.0) * 2500.0, 1.0);
}

TEST(NoiseProcess, SamplesHaveTheStatedDensityAndMeanSquare) {
  constexpr double kRate = 20000.0;
  constexpr std::size_t kSamples = 4000000;
  constexpr std::size_t kSegment = 4000;  // 5 Hz: narrower than the resonance's 24 Hz
  constexpr std::size_t kSegments = kSamples / kSegment;
  for (const NoiseSpectrum& spectrum : {kWhite, kLow, kResonance}) {
    NoiseProcess process(spectrum, 0.3, kRate, 17);
    std::vector<double> x(kSamples);
    process.AddTo(x);
    double square = 0.0;
    for (const double value : x) square += value * value / kSamples;
    EXPECT_NEAR(square, 0.09, 0.09 * 0.05);
    for (const double f : {40.0, 100.0, 120.0, 150.0, 300.0, 900.0}) {
      // Aliases add (pi f_c / f_s)^2 / 3 of S_0, 1.9e-4: 0.7 % of the low-pass at 900 Hz.
      const double expected = 0.09 * spectrum.DensityPerSquare(f, kRate);
      EXPECT_NEAR(Density(x, kRate, f, kSegment) / expected, 1.0,
                  Tolerance(static_cast<double>(kSegments)) + 0.01)
          << f;
    }
  }
}

// The exact discretisation does not know the rate: every other sample at twice the rate is the same
// process.
TEST(NoiseProcess, CorrelationIsTheContinuousOne) {
  constexpr double kRate = 1000.0;
  NoiseProcess process(kResonance, 1.0, kRate, 3);
  std::vector<double> x(2000000);
  process.AddTo(x);
  const double w = 2.0 * std::numbers::pi * kResonance.frequency_hz;
  const double zeta = kResonance.damping, wd = w * std::sqrt(1.0 - zeta * zeta);
  for (const std::size_t lag : {1u, 3u, 8u, 20u}) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < x.size(); ++i) sum += x[i] * x[i + lag];
    const double t = static_cast<double>(lag) / kRate;
    const double expected =
        std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
    EXPECT_NEAR(sum / static_cast<double>(x.size() - lag), expected, 0.01) << lag;
  }
}

SimulationCase Paper(std::uint64_t seed) {
  SimulationCase one;
  one.rig.model = PaperLoop(0.415);
  one.rig.model.flame.slope *= 0.75;  // gain 0.88 at 216 Hz: no cycle
  one.seed = seed;
  return one;
}

SimulationOptions Long() {
  SimulationOptions options;
  options.duration_s = 200.0;
  options.settle_s = 0.5;
  options.sampling_hz = options.internal_hz = 20000.0;
  return options;
}

// d drives p through the loop, p = G d / (1 - L), and q = L / G p is the flame's answer alone.
TEST(NoiseSource, DuctIsFeltByTheFlameAndNotShownByQ) {
  for (const NoiseSpectrum& spectrum : {NoiseSpectrum{NoiseColour::kLowPass, 400.0, 0.0},
                                        NoiseSpectrum{NoiseColour::kResonance, 300.0, 0.2}}) {
    SimulationCase one = Paper(5);
    const double std_dev = 1e-5;  // far from saturation
    AddNoiseSource({NoisePlace::kDuct, spectrum, 0.0, std_dev}, &one.rig);
    const SimulatedRecord record = Simulate(one, Long());
    for (const double f : {150.0, 320.0, 746.0}) {
      const double source = std_dev * std_dev * spectrum.DensityPerSquare(f, 20000.0);
      // NoiseTransferAt is for noise n in q: q = n / (1 - L), p = G n / (1 - L).
      const NoiseTransfer transfer = NoiseTransferAt(one.rig.model, f);
      EXPECT_NEAR(
          Density(record.pressure, 20000.0, f, 4000) / (source * std::norm(transfer.pressure)), 1.0,
          Tolerance(1000) + 0.03)
          << f;
      EXPECT_NEAR(Density(record.heat_release, 20000.0, f, 4000) /
                      (source * std::norm(transfer.heat_release - 1.0)),
                  1.0, Tolerance(1000) + 0.03)
          << f;
    }
  }
}

TEST(NoiseSource, CombustionIsShownByQ) {
  SimulationCase one = Paper(6);
  AddNoiseSource({NoisePlace::kCombustion, kResonance, 0.0, 1e-5}, &one.rig);
  const SimulatedRecord record = Simulate(one, Long());
  // Away from the loop's own resonance near 216 Hz, which segments of 5 Hz do not resolve.
  for (const double f : {90.0, 120.0, 150.0, 320.0}) {
    const double source = 1e-10 * kResonance.DensityPerSquare(f, 20000.0);
    const NoiseTransfer transfer = NoiseTransferAt(one.rig.model, f);
    EXPECT_NEAR(Density(record.heat_release, 20000.0, f, 4000) /
                    (source * std::norm(transfer.heat_release)),
                1.0, Tolerance(1000) + 0.03)
        << f;
  }
}

TEST(NoiseSource, SensorsAndBackgroundAddToTheRecordAlone) {
  SimulationOptions options;
  options.duration_s = 40.0;
  SimulationCase plain = Paper(7);
  plain.rig.noise.combustion_density = 1e-10;
  plain.rig.noise.combustion_corner_hz = 400.0;
  const SimulatedRecord without = Simulate(plain, options);
  const auto added = [&](const NoiseSource& source, bool to_pressure) {
    SimulationCase one = plain;
    AddNoiseSource(source, &one.rig);
    const SimulatedRecord with = Simulate(one, options);
    std::vector<double> difference = to_pressure ? with.pressure : with.heat_release;
    const std::vector<double>& base = to_pressure ? without.pressure : without.heat_release;
    for (std::size_t i = 0; i < base.size(); ++i) difference[i] -= base[i];
    return difference;
  };
  const NoiseSource p_sensor{NoisePlace::kPressureSensor, kLow, 2.0, 0.0};
  const std::vector<double> p = added(p_sensor, true);
  const std::vector<double> none = added(p_sensor, false);
  for (const double x : none) ASSERT_EQ(x, 0.0);
  for (const double f : {50.0, 150.0, 300.0}) {
    EXPECT_NEAR(Density(p, 5000.0, f) / (4.0 * kLow.DensityPerSquare(f, 5000.0)), 1.0,
                Tolerance(200) + 0.03)
        << f;
  }
  const std::vector<double> q = added({NoisePlace::kHeatReleaseSensor, kWhite, 0.0, 0.05}, false);
  EXPECT_NEAR(Density(q, 5000.0, 1000.0) / (0.0025 * 2.0 / 5000.0), 1.0, Tolerance(200));
  // The background is one process: each channel has its share of the same samples.
  const NoiseSource background{NoisePlace::kBackground, kResonance, 2.0, 0.05};
  const std::vector<double> in_p = added(background, true);
  const std::vector<double> in_q = added(background, false);
  for (std::size_t i = 0; i < in_p.size(); ++i) ASSERT_NEAR(in_p[i], 40.0 * in_q[i], 1e-9);
}

TEST(NoiseSource, WithoutStrengthNoBitChanges) {
  SimulationCase plain = Paper(8);
  plain.rig.noise = {1e-8, 1200.0, 0.01, 0.001};
  SimulationCase one = plain;
  for (const NoisePlace place : kNoisePlaces) AddNoiseSource({place, kLow, 0.0, 0.0}, &one.rig);
  const SimulatedRecord a = Simulate(plain, {}), b = Simulate(one, {});
  EXPECT_EQ(a.pressure, b.pressure);
  EXPECT_EQ(a.heat_release, b.heat_release);
}

// Another source of noise changes no draw of the combustion noise.
TEST(NoiseSource, LeavesTheOtherStreamsAlone) {
  SimulationCase plain = Paper(9);
  plain.rig.noise.pressure_sensor_std = 0.01;
  SimulationCase one = plain;
  AddNoiseSource({NoisePlace::kHeatReleaseSensor, kLow, 0.0, 0.1}, &one.rig);
  EXPECT_EQ(Simulate(plain, {}).pressure, Simulate(one, {}).pressure);
}

}  // namespace
}  // namespace howl::noise_source_test
