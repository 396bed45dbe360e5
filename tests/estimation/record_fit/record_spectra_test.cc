// What a record's spectra say of the flame's input.
#include "estimation/record_fit/spectra/record_spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace howl {
namespace {

// A sine that ends elsewhere than it begins, as every record does: from its end back to its
// beginning it jumps, and its rate there is many times that of the sine.
TEST(RecordSpectra, TheInputsRangeIsNotThatOfTheRecordsEnds) {
  constexpr double kCycle_hz = 200.0;
  const double turn = 2.0 * std::numbers::pi * kCycle_hz;
  Record record;
  record.sampling_hz = 10000.0;
  for (int i = 0; i < 20013; ++i) {
    const double t = static_cast<double>(i) / record.sampling_hz;
    record.pressure.push_back(std::sin(turn * t));
    record.heat_release.push_back(std::cos(turn * t) + 0.2 * std::cos(3.0 * turn * t));
  }
  const double largest = std::numbers::sqrt2;  // over the root mean square, as the scale has it
  for (const FlameInput input : {FlameInput::kPressureRate, FlameInput::kPressure}) {
    const RecordSpectra spectra = MakeRecordSpectra(record, kCycle_hz, input);
    EXPECT_NEAR(spectra.scale.input_range, largest, 0.05 * largest) << static_cast<int>(input);
  }
}

}  // namespace
}  // namespace howl
