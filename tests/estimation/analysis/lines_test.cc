#include "estimation/analysis/spectra/lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace howl::lines_test {
namespace {

Record Noise(int samples, double pole, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Record record{5000.0, {}, {}};
  double p = 0.0;
  for (int t = 0; t < samples; ++t) {
    p = pole * p + normal(random);
    record.pressure.push_back(p);
    record.heat_release.push_back(normal(random));
  }
  return record;
}

std::vector<SpectralLine> Lines(const Record& record, double fundamental_hz) {
  return FindLines(record,
                   WelchSpectrum(RemoveMean(record.pressure), RemoveMean(record.heat_release),
                                 record.sampling_hz),
                   fundamental_hz);
}

// One percent a channel is asked for: in 200 records of two channels 4 are expected, and 14 or more
// come with probability below 1e-4. The floor's own error doubles the rate at most.
TEST(FindLines, FalseAlarmsAreRare) {
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    alarms += Lines(Noise(8192, 0.5, seed), 0.0).empty() ? 0 : 1;
  }
  EXPECT_LE(alarms, 20);
}

// A record that repeats itself exactly has a line at every multiple of its repetition, and rounding
// between them, all of it beyond any floor: each pair of candidates was compared by walking from
// one to the other, which took the cube of their number.
TEST(FindLines, ARecordThatRepeatsItselfTakesNoLonger) {
  const Record once = Noise(2000, 0.9, 3);
  Record record{5000.0, {}, {}};
  for (int k = 0; k < 160; ++k) {
    record.pressure.insert(record.pressure.end(), once.pressure.begin(), once.pressure.end());
    record.heat_release.insert(record.heat_release.end(), once.heat_release.begin(),
                               once.heat_release.end());
  }
  const std::vector<SpectralLine> lines = Lines(record, 0.0);
  ASSERT_FALSE(lines.empty());
  // The strongest is at a multiple of the repetition: 2000 samples at 5 kHz.
  const SpectralLine& strongest = *std::ranges::max_element(lines, {}, &SpectralLine::p_amplitude);
  EXPECT_NEAR(std::remainder(strongest.frequency_hz.value, 2.5), 0.0, 0.05);
}

TEST(FindLines, ListsFundamentalHarmonicAndNonHarmonicLine) {
  Record record = Noise(16000, 0.0, 7);
  for (std::size_t t = 0; t < record.pressure.size(); ++t) {
    const double time = static_cast<double>(t) / 5000.0;
    record.pressure[t] +=
        20.0 * std::cos(2 * M_PI * 210.3 * time) + 1.0 * std::cos(2 * M_PI * 748.2 * time + 1.0);
    record.heat_release[t] += 2.0 * std::cos(2 * M_PI * 420.6 * time);
  }
  const auto lines = Lines(record, 210.3);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].harmonic, 1);
  EXPECT_NEAR(lines[0].frequency_hz.value, 210.3, 4 * lines[0].frequency_hz.std);
  EXPECT_NEAR(lines[0].p_amplitude, 20.0, 0.2);
  EXPECT_EQ(lines[1].harmonic, 2);
  EXPECT_NEAR(lines[1].q_amplitude, 2.0, 0.1);
  EXPECT_EQ(lines[2].harmonic, 0);
  EXPECT_NEAR(lines[2].frequency_hz.value, 748.2, 4 * lines[2].frequency_hz.std);
  EXPECT_NEAR(lines[2].p_amplitude, 1.0, 0.15);
  for (const SpectralLine& line : lines) {
    EXPECT_TRUE(line.narrow);
    EXPECT_LT(line.frequency_hz.std, 0.05);
    EXPECT_LT(std::min(line.p_log10_p_value, line.q_log10_p_value), -6.0);
  }
}

// White noise through a resonator of 400 Hz and half-power width 2 xi f = 64 Hz.
TEST(FindLines, ResonanceIsToldFromALineByItsWidth) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  Record record{5000.0, {}, {}};
  const double r = std::exp(-M_PI * 64.0 / 5000.0);
  const double a1 = 2 * r * std::cos(2 * M_PI * 400.0 / 5000.0), a2 = -r * r;
  double y1 = 0, y2 = 0;
  for (int t = 0; t < 64000; ++t) {
    const double y = a1 * y1 + a2 * y2 + normal(random);
    y2 = y1;
    y1 = y;
    record.pressure.push_back(y);
  }
  // Short segments see the resonance as one peak.
  const auto lines = FindLines(record, WelchSpectrum(record.pressure, {}, 5000.0, 512), 0.0);
  ASSERT_FALSE(lines.empty());
  EXPECT_NEAR(lines[0].frequency_hz.value, 400.0, 20.0);
  EXPECT_FALSE(lines[0].narrow);
  EXPECT_NEAR(lines[0].width_hz, 64.0, 25.0);
}

}  // namespace
}  // namespace howl::lines_test
