// The sensor's noise of a record from which a known instrument was taken out: it came in behind the
// instrument, and was divided by it as well.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>

#include "estimation/analysis/instruments/remove_instruments.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::known_instrument_noise_test {
namespace {

constexpr double kCycle_hz = 203.0;
constexpr double kCutoff_hz = 245.0;

Instruments LowPass() {
  FormulaError error;
  Instruments out;
  out.heat_release = InstrumentResponse::Parse("1 / (1 + s / (2 pi 245))", error);
  EXPECT_TRUE(out.heat_release.has_value()) << error.message;
  return out;
}

Record WithoutLowPass(Record record) {
  EXPECT_FALSE(RemoveInstruments(LowPass(), record).has_value());
  return record;
}

double LowPassPower(double frequency_hz) {
  return 1.0 / (1.0 + std::pow(frequency_hz / kCutoff_hz, 2));
}

TEST(KnownInstrumentNoise, IsDividedByTheInstrument) {
  const Record quiet = SimulateModalLoop(DuctOfModes(2), 8.0, 1);
  Record noisy = quiet;
  RandomStream random(2);
  for (double& q : noisy.heat_release) q += random.Normal();
  const Record corrected = WithoutLowPass(noisy);
  const RecordSpectra record = MakeRecordSpectra(corrected, kCycle_hz, FlameInput::kPressure);
  const NoiseTerm sensor{LoopNoise::kHeatReleaseSensor, 1};
  const Eigen::VectorXd shape = NoiseShape(sensor, record);
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const double expected = 1.0 / LowPassPower(record.s[i].imag() * kCycle_hz);
    ASSERT_NEAR(shape[i], expected, 1e-9 * expected) << i;
  }
  // What the noise alone has become has that spectrum, in the band's lower and upper half.
  Record noise = corrected;
  const Record without = WithoutLowPass(quiet);
  for (std::size_t i = 0; i < noise.heat_release.size(); ++i) {
    noise.heat_release[i] -= without.heat_release[i];
  }
  const RecordSpectra alone = MakeRecordSpectra(noise, record);
  const Eigen::VectorXd flat = Tapered(alone.heat_release).cwiseAbs2().cwiseQuotient(shape);
  const Eigen::Index half = flat.size() / 2;
  EXPECT_NEAR(flat.head(half).mean() / flat.tail(half).mean(), 1.0, 0.05);
}

TEST(KnownInstrumentNoise, IsNoneOfOtherSources) {
  const RecordSpectra record = MakeRecordSpectra(
      WithoutLowPass(SimulateModalLoop(DuctOfModes(2), 2.0, 1)), kCycle_hz, FlameInput::kPressure);
  for (const LoopNoise source : {LoopNoise::kCombustion, LoopNoise::kPressureSensor,
                                 LoopNoise::kDuct, LoopNoise::kBackground}) {
    EXPECT_EQ(NoiseShape({source, 1}, record), Eigen::VectorXd::Ones(record.bins()));
  }
  ASSERT_TRUE(record.middle);
  const NoiseTerm sensor{LoopNoise::kHeatReleaseSensor, 1};
  const double top_hz = record.middle->s[record.middle->bins() - 1].imag() * kCycle_hz;
  EXPECT_NEAR(NoiseShape(sensor, *record.middle).tail(1)[0], 1.0 / LowPassPower(top_hz), 1e-9);
}

}  // namespace
}  // namespace howl::known_instrument_noise_test
