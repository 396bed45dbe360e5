// What a record's spectra say of the flame's input.
#include "estimation/record_fit/spectra/record_spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

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

// p and q = tanh(dp/dt) of a cycle, 13 samples long, behind one anti-alias filter: a sinc under
// Blackman's window that has lost half at 0.44 of the sampling rate, as acquisition has it.
Record BehindAnAntiAliasFilter() {
  constexpr int kFine = 16;  // steps a sample
  constexpr int kReach = 14;
  constexpr int kSamples = 13007;
  constexpr double kEnd = 0.44;
  const double turn = 2.0 * std::numbers::pi / (13.0 * kFine);
  std::vector<double> taps;
  double sum = 0.0;
  for (int k = -kReach * kFine; k <= kReach * kFine; ++k) {
    const double t = 2.0 * std::numbers::pi * kEnd * k / kFine;
    const double u = std::numbers::pi * k / (kReach * kFine);
    const double window = 0.42 + 0.5 * std::cos(u) + 0.08 * std::cos(2.0 * u);
    taps.push_back(window * (k == 0 ? 1.0 : std::sin(t) / t));
    sum += taps.back();
  }
  Record out;
  out.sampling_hz = 13.0 * kCycle_hz;
  for (int i = 0; i < kSamples; ++i) {
    double p = 0.0;
    double q = 0.0;
    for (int k = -kReach * kFine; k <= kReach * kFine; ++k) {
      const double weight = taps[static_cast<std::size_t>(k + kReach * kFine)] / sum;
      const double angle = turn * (i * kFine + k);
      const double rate = std::cos(angle) - 0.06 * std::cos(3.0 * angle + 0.5);
      p += weight * (std::sin(angle) - 0.02 * std::sin(3.0 * angle + 0.5));
      q += weight * std::tanh(1.5 * rate);
    }
    out.pressure.push_back(p);
    out.heat_release.push_back(q);
  }
  return out;
}

// The curve of a p that a filter has dulled is not what the filter makes of the curve: a band that
// reached to where the filter begins would show a flame that no curve makes. What is left at any
// bin lies below what noise of 2 % leaves of a line in 5000 cycles: 0.02 sqrt(2 / 65000).
TEST(RecordSpectra, ItsBandEndsWhereAnAntiAliasFilterBegins) {
  const RecordSpectra record =
      MakeRecordSpectra(BehindAnAntiAliasFilter(), kCycle_hz, FlameInput::kPressureRate);
  const Eigen::VectorXcd heat_release = Tapered(record.heat_release);
  Eigen::MatrixXcd flame(record.bins(), record.flame.cols());
  for (Eigen::Index k = 0; k < flame.cols(); ++k) flame.col(k) = Tapered(record.flame.col(k));
  Eigen::MatrixXd columns(2 * flame.rows(), flame.cols());
  columns << flame.real(), flame.imag();
  Eigen::VectorXd wanted(columns.rows());
  wanted << heat_release.real(), heat_release.imag();
  const Eigen::VectorXd curve = columns.colPivHouseholderQr().solve(wanted);
  const double left = (heat_release - flame * curve).cwiseAbs().maxCoeff();
  EXPECT_LT(left, 1.1e-4 * heat_release.cwiseAbs().maxCoeff());
  EXPECT_GT(record.bin_hz * static_cast<double>(record.below.size() + record.bins()),
            4.5 * kCycle_hz);
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
