// What a record's spectra say of the flame's input.
#include "estimation/record_fit/spectra/record_spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/estimation/record_fit/modal_loop.h"

namespace howl::record_spectra_test {
namespace {

constexpr double kCycle_hz = 200.0;

// A sine that ends elsewhere than it begins, as every record does: from its end back to its
// beginning it jumps, and its rate there is many times that of the sine.
TEST(RecordSpectra, TheInputsRangeIsNotThatOfTheRecordsEnds) {
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

// Late by so many of the instants at which the record's flame is taken.
TransferFunction LateBy(double instants, const RecordSpectra& record) {
  const double late_s = instants / (record.bin_hz * static_cast<double>(record.Instants()));
  return [late_s](std::complex<double> s) {
    return std::exp(-s * (2.0 * std::numbers::pi * kCycle_hz * late_s));
  };
}

// A delay by whole instants may stand before a curve or behind it, and a factor before a line too:
// by one way the flame's functions are made anew in time, by the other their spectra are
// multiplied.
TEST(RecordSpectra, FiltersStandBeforeTheCurveOrBehindIt) {
  const RecordSpectra plain = MakeRecordSpectra(SimulateModalLoop(DuctOfModes(2), 0.4, 1),
                                                kCycle_hz, FlameInput::kPressureRate);
  const TransferFunction late = LateBy(7.0, plain);
  const RecordSpectra before = WithFilters(plain, {late, nullptr});
  const RecordSpectra behind = WithFilters(plain, {nullptr, late});
  EXPECT_LT((before.flame - behind.flame).norm(), 1e-9 * plain.flame.norm());
  EXPECT_GT((before.flame - plain.flame).norm(), 0.1 * plain.flame.norm());
  EXPECT_LT((before.slopes - plain.slopes).norm(), 1e-9 * plain.slopes.norm());
  for (const RecordSpectra* record : {&before, &behind}) {
    EXPECT_LT((record->input - plain.input.cwiseProduct(plain.s.unaryExpr(late))).norm(),
              1e-12 * plain.input.norm());
    ASSERT_TRUE(record->middle != nullptr || plain.middle == nullptr);
  }
  const RecordSpectra both = WithFilters(before, {nullptr, late});
  const RecordSpectra twice = WithFilters(behind, {nullptr, late});
  EXPECT_LT((both.flame - twice.flame).norm(), 1e-9 * plain.flame.norm());
}

// Between its instants the input is what it is at them: what a curve makes of it hardly reaches
// frequencies so high that they are taken for lower ones. A function counts for as much as a flame
// may have of it, under the taper that the likelihood is taken under.
TEST(RecordSpectra, InstantsAreCloseEnough) {
  const RecordSpectra plain = MakeRecordSpectra(SimulateModalLoop(DuctOfModes(2), 2.0, 1),
                                                kCycle_hz, FlameInput::kPressureRate);
  ASSERT_LT(plain.Instants(), plain.Samples());
  const TransferFunction late = LateBy(0.5, plain);
  const Eigen::MatrixXcd before = WithFilters(plain, {late, nullptr}).flame;
  const Eigen::MatrixXcd behind = WithFilters(plain, {nullptr, late}).flame;
  double error = 0.0;
  double size = 0.0;
  for (Eigen::Index k = 0; k < plain.flame.cols(); ++k) {
    const double weight = plain.scale.flame_deviation[k];
    error += (weight * Tapered(before.col(k) - behind.col(k))).squaredNorm();
    size += (weight * Tapered(plain.flame.col(k))).squaredNorm();
  }
  EXPECT_LT(std::sqrt(error / size), 1e-3);
}

// Noise of p that is taken out of what drives a flame stays out when it is filtered.
TEST(RecordSpectra, FiltersKeepWhatDrivesTheFlame) {
  const RecordSpectra plain = MakeRecordSpectra(SimulateModalLoop(DuctOfModes(2), 0.4, 1), 200.0,
                                                FlameInput::kPressureRate);
  const auto half = [](std::complex<double>) { return std::complex<double>(0.5); };
  Eigen::VectorXd noise(plain.Samples());
  RandomStream random(3);
  for (double& each : noise) each = 0.1 * random.Normal();
  const RecordSpectra first = WithFilters(DrivenWithout(plain, noise), {half, nullptr});
  const RecordSpectra last = DrivenWithout(WithFilters(plain, {half, nullptr}), noise);
  EXPECT_LT((first.flame - last.flame).norm(), 1e-12 * plain.flame.norm());
}

}  // namespace
}  // namespace howl::record_spectra_test
