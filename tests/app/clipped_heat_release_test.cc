// Of a q that was clipped before noise came to it.
#include "app/diagnose/clipped_heat_release.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/practice_records.h"

namespace howl::clipped_heat_release_test {
namespace {

constexpr std::size_t kSamples = 16000;

struct Made {
  double saturation;  // of the flame: its gain at rest over its largest answer
  double noise;       // of combustion
  double clipped_at;  // of the cycle's amplitude
  double sensor;      // its noise, behind the clipping
};

std::vector<NamedRecord> RigOf(const Made& made) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<NamedRecord> out(3);
  for (NamedRecord& each : out) {
    each.name = "exp";
    each.record.sampling_hz = 5000.0;
    double phase = 0.0;
    for (std::size_t i = 0; i < kSamples; ++i) {
      phase += 0.26 + 0.01 * normal(random);
      const double p = std::sin(phase);
      const double q = std::tanh(made.saturation * p) / std::tanh(made.saturation);
      each.record.pressure.push_back(p);
      each.record.heat_release.push_back(
          std::clamp(q + made.noise * normal(random), -made.clipped_at, made.clipped_at) +
          made.sensor * normal(random));
    }
  }
  return out;
}

TEST(ClippedHeatRelease, MayBeWhereTheDensityEndsInEdges) {
  for (const double level : {0.7, 0.8, 0.9}) {
    for (const double sensor : {1e-3, 4e-3}) {
      EXPECT_TRUE(HeatReleaseMayBeClipped(RigOf({0.8, 0.03, level, sensor})))
          << level << " " << sensor;
    }
  }
}

TEST(ClippedHeatRelease, IsNotWhereCombustionsNoiseBlursThem) {
  for (const double saturation : {0.1, 1.0, 2.0, 4.0}) {
    EXPECT_FALSE(HeatReleaseMayBeClipped(RigOf({saturation, 0.03, 10.0, 1e-3}))) << saturation;
  }
}

// These tell by themselves that they are clipped, and need no search.
TEST(ClippedHeatRelease, IsNotAskedForWhereSamplesRepeat) {
  EXPECT_FALSE(HeatReleaseMayBeClipped(RigOf({0.8, 0.03, 0.8, 0.0})));
}

TEST(LongClippedHeatRelease, IsFoundInAPracticeRig) {
  const char* folder = std::getenv("HOWL_PRACTICE");
  if (!folder) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  const std::vector<NamedRecord> rig = PracticeRecords(std::string(folder) + "/case011");
  DiagnosisOptions options;
  options.choose_modes = options.choose_delays = true;
  const std::optional<Diagnosis> found = DiagnoseClippedHeatRelease(rig, options);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->effect, "q_clipping");
  options.withheld = {"q_clipping"};
  EXPECT_FALSE(DiagnoseClippedHeatRelease(rig, options).has_value());
}

}  // namespace
}  // namespace howl::clipped_heat_release_test
