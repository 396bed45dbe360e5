// The spectrum of hum: lines at multiples of the mains' frequency, each with its own power.
#include <gtest/gtest.h>

#include <cmath>

#include "estimation/record_fit/spectra/record_spectra.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "tests/estimation/record_fit/modal_loop.h"

namespace howl::hum_test {
namespace {

constexpr double kMains_hz = 50.0;
const NoiseTerm kHum{LoopNoise::kHeatReleaseHum, 5, kMains_hz};  // 50, 100, 150, 200 Hz

Eigen::Index BinAt(const RecordSpectra& record, double hz) {
  Eigen::Index at = 0;
  (record.scale.cycle_hz * record.s.imag().array() - hz).abs().minCoeff(&at);
  return at;
}

TEST(Hum, HasAPowerOfItsOwnAtEachMultiple) {
  const RecordSpectra record = MakeRecordSpectra(SimulateModalLoop(DuctOfModes(2), 0.8, 1), 230.0,
                                                 FlameInput::kPressureRate);
  Eigen::VectorXd c(5);
  c << -2.0, 1.0, -3.0, 0.5, 2.0;
  const Eigen::VectorXd spectrum = NoiseSpectrum(kHum, record, c);
  const Eigen::VectorXd shape = NoiseShape(kHum, record);
  for (int n = 1; n <= 4; ++n) {
    const Eigen::Index at = BinAt(record, n * kMains_hz);
    EXPECT_GT(shape[at], 0.5);
    EXPECT_NEAR(spectrum[at], std::exp(c[0] + c[n]) * shape[at], 1e-12);
  }
  // Beyond those that it has a power for there are none.
  EXPECT_LT(shape[BinAt(record, 5.0 * kMains_hz)], 1e-4);
}

// So that what one half of a record tells of a multiple's power holds for the other.
TEST(Hum, HasTheSameMultiplesInAPart) {
  const Record all = SimulateModalLoop(DuctOfModes(2), 0.8, 1);
  Record part = all;
  part.pressure.resize(all.pressure.size() / 2);
  part.heat_release.resize(all.heat_release.size() / 2);
  // The band begins beside the first multiple, the cycle is at the fourth and beyond the sixth.
  for (const double cycle_hz : {200.0, 333.3, 400.0}) {
    const RecordSpectra whole = MakeRecordSpectra(all, cycle_hz, FlameInput::kPressureRate);
    const RecordSpectra half = MakeRecordSpectra(part, whole);
    const double first_hz =
        std::ceil(RecordScale::kLowestOfCycle * cycle_hz / kMains_hz) * kMains_hz;
    for (int n = 1; n <= 3; ++n) {
      for (const RecordSpectra& each : {whole, half}) {
        const Eigen::Index at = BinAt(each, first_hz + n * kMains_hz);
        EXPECT_GT(NoiseShape(kHum, each)[at], 0.5);
        EXPECT_EQ(LogSpectrumColumns(kHum, each)(at, 1 + n), 1.0);
      }
    }
  }
}

}  // namespace
}  // namespace howl::hum_test
