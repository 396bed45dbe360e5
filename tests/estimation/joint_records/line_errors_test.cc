// Errors of a model at the cycle's own lines: how large they are is estimated with them, so that a
// right model keeps what the lines tell, and a wrong one is not led astray by them.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "estimation/joint_records/records_fit.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::line_errors_test {
namespace {

using C = std::complex<double>;

constexpr double kSeconds = 1.5;
constexpr int kLines = 4;

PointStructure Structure(int lines) {
  PointStructure out = FreeStructure(2);
  out.acoustic_lines = lines;
  out.flame_lines = lines;
  return out;
}

// The content of x within kLineReach of the frequency's multiples, times 1 + errors.
void MultiplyLines(double cycle_hz, double sampling_hz, const std::vector<C>& errors,
                   std::vector<double>* x) {
  const std::vector<double> from = *x;
  const auto n = static_cast<double>(from.size());
  for (std::size_t h = 0; h < errors.size(); ++h) {
    const double middle = static_cast<double>(h + 1) * cycle_hz;
    const double reach = kLineReach * cycle_hz;
    const auto first = static_cast<int>(std::ceil((middle - reach) * n / sampling_hz));
    const auto last = static_cast<int>(std::floor((middle + reach) * n / sampling_hz));
    for (int k = first; k <= last; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / n;
      C sum = 0.0;
      for (std::size_t i = 0; i < from.size(); ++i) {
        sum += from[i] * std::polar(1.0, -turn * static_cast<double>(i));
      }
      const C added = 2.0 / n * errors[h] * sum;
      for (std::size_t i = 0; i < from.size(); ++i) {
        (*x)[i] += (added * std::polar(1.0, turn * static_cast<double>(i))).real();
      }
    }
  }
}

struct Found {
  LoopPoint point;
  double tau_s = 0.0;
  double tau_std_s = 0.0;
  double flame_error = 0.0;  // as the law has it
  Eigen::VectorXd std;       // of the flame's errors, real parts first
};

Found Fit(const Record& record, double cycle_hz, int lines) {
  const std::vector<OperatingPoint> points = {
      {1.0, MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate)}};
  const PointStructure structure = Structure(lines);
  const RecordsFit fit = FitRecords(points, structure, {.starts = 6});
  EXPECT_TRUE(fit.points[0].converged);
  Found out;
  const Eigen::Index flame = points[0].record.flame.cols();
  out.point = ToPoint(structure, flame, fit.points[0].parameters);
  const Eigen::VectorXd std = fit.points[0].Covariance().diagonal().cwiseSqrt();
  const double turn = 2.0 * std::numbers::pi * cycle_hz;
  out.tau_s = out.point.path.tau / turn;
  out.tau_std_s = out.tau_s * std[structure.Delay()];
  out.std = std.segment(structure.FlameLine(flame), structure.FlameLines());
  if (lines > 0) out.flame_error = fit.law.spread[fit.law.spread.size() - 1];
  return out;
}

TEST(LineErrors, OfARightModelAreSmallAndCostLittle) {
  const ModalLoop loop = DuctOfModes(2);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const Record record = SimulateModalLoop(loop, kSeconds, 31);
  const Found without = Fit(record, cycle_hz, 0);
  const Found with = Fit(record, cycle_hz, kLines);
  EXPECT_LT(with.flame_error, 0.03);
  EXPECT_LT(std::abs(with.tau_s - loop.tau_s), 4.0 * with.tau_std_s);
  EXPECT_LT(with.tau_std_s, 3.0 * without.tau_std_s);
}

TEST(LineErrors, OfAWrongModelDoNotMoveTheDelay) {
  const ModalLoop loop = DuctOfModes(2);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  Record record = SimulateModalLoop(loop, kSeconds, 32);
  const std::vector<C> errors = {C(0.0, 0.25), C(-0.4, 0.1), C(0.3, 0.0)};
  MultiplyLines(cycle_hz, record.sampling_hz, errors, &record.heat_release);
  const Found without = Fit(record, cycle_hz, 0);
  EXPECT_GT(std::abs(without.tau_s - loop.tau_s), 4.0 * without.tau_std_s);
  const Found with = Fit(record, cycle_hz, kLines);
  EXPECT_LT(std::abs(with.tau_s - loop.tau_s), 4.0 * with.tau_std_s);
  EXPECT_GT(with.flame_error, 0.1);
  const C first = with.point.flame_lines[0] - errors[0];
  EXPECT_LT(std::abs(first.real()), 4.0 * with.std[0]);
  EXPECT_LT(std::abs(first.imag()), 4.0 * with.std[kLines]);
}

}  // namespace
}  // namespace howl::line_errors_test
