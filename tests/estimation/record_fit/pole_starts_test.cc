// Where fits of a record look for its modes, beside lines that tell nothing of them.
#include "estimation/record_fit/starts/pole_starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/estimation/record_fit/modal_loop.h"

namespace howl::pole_starts_test {
namespace {

constexpr double kMains_hz = 50.0;

// Hum at the mains' frequency and its third multiple.
void AddHum(double share, Record* record) {
  std::vector<double>& q = record->heat_release;
  const double amplitude = share * std::numbers::sqrt2 * RootMeanSquare(q);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double angle =
        2.0 * std::numbers::pi * kMains_hz * static_cast<double>(i) / record->sampling_hz;
    q[i] += amplitude * (std::cos(angle) + 0.3 * std::cos(3.0 * angle));
  }
}

TEST(PoleStarts, LookBesideTheLinesOfHum) {
  ModalLoop loop = DuctOfModes(2);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  loop.slope = 1.5 / loop.Open(cycle_hz).real();
  const Record clean = SimulateModalLoop(loop, 1.6, 7, {});
  Record with_hum = clean;
  AddHum(0.3, &with_hum);
  PointStructure structure;
  structure.modes = 2;
  const auto poles_of = [&](const Record& record) {
    const RecordSpectra spectra = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
    return PoleStarts(spectra, structure).Relocated(PoleStarts(spectra, structure).Spread());
  };
  const auto distance = [](const std::vector<StartPole>& a, const std::vector<StartPole>& b) {
    double worst = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      worst = std::max({worst, std::abs(std::log(a[k].omega / b[k].omega)),
                        std::abs(std::log(a[k].xi / b[k].xi))});
    }
    return worst;
  };
  const std::vector<StartPole> truth = poles_of(clean);
  ASSERT_EQ(truth.size(), 2u);
  EXPECT_GT(distance(poles_of(with_hum), truth), 0.05);
  structure.noise = {{LoopNoise::kHeatReleaseHum, 1 + 3, kMains_hz}};
  // Fewer bins are left, and hum reaches a little beyond five.
  EXPECT_LT(distance(poles_of(with_hum), truth), 0.02);
}

}  // namespace
}  // namespace howl::pole_starts_test
