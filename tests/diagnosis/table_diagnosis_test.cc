// The lag that a published table allows, against closed forms: (3) with table 2 of the paper, the
// passivity of G, and tables made from a loop whose sensor lags by a known angle.
#include "diagnosis/table/table_diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/loop/crossings.h"
#include "model/loop/loop.h"
#include "model/numerics/units.h"

namespace howl::table_diagnosis_test {
namespace {

Experiment Row(const char* name, double f, double phase_deg, double gain) {
  Experiment row;
  row.name = name;
  row.frequency_hz = f;
  row.phase_deg = phase_deg;
  row.gain = gain;
  row.lines = {{750.0, 10.0}};
  return row;
}

std::vector<Experiment> PaperTable() {
  return {Row("exp1", 219.9, -5.74, 12.14), Row("exp2", 209.1, -9.44, 13.15),
          Row("exp3", 205.7, -14.35, 14.79), Row("exp4", 202.7, -19.18, 16.05)};
}

TableLimits Limits() {
  TableLimits limits;
  limits.omega_min_hz = 150.0;
  limits.xi_min = 0.02;
  limits.xi_max = 0.4;
  limits.M_max = 5000.0;
  return limits;
}

TEST(TableDiagnosis, DelayIsEquationThree) {
  const double tau_ms[] = {3.338, 3.461, 3.452, 3.437};  // the paper's tables, recomputed
  const std::vector<Experiment> rows = PaperTable();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(1e3 * DelayAtLag(rows[i], 0.0), tau_ms[i], 6e-4);
    // A lag of 45 degrees moves it to about 2.8 ms.
    EXPECT_NEAR(1e3 * DelayAtLag(rows[i], 45.0), 2.8, 0.08);
  }
}

TEST(TableDiagnosis, PapersTableAllowsASmallLagAtMost) {
  const TableDiagnosis table = DiagnoseTable(PaperTable(), Limits());
  ASSERT_TRUE(table.lag.any);
  EXPECT_LT(table.lag.low_deg, table.lag.high_deg);
  // Passive: 270 + Delta - 900 f / f2, with the line at most 1.96 times 10 Hz above 750.
  double least_deg = 90.0;
  for (const Experiment& row : PaperTable()) {
    const double own = 270.0 + row.phase_deg - 900.0 * row.frequency_hz / 769.6;
    EXPECT_FALSE(AgreesAtLag(row, own + 0.01, Limits())) << row.name;
    EXPECT_FALSE(AgreesAtLag(row, 45.0, Limits())) << row.name;
    const double scaled = std::tan(own * kRadPerDeg) * table.mean_frequency_hz / row.frequency_hz;
    least_deg = std::min(least_deg, std::atan(scaled) * kDegPerRad);
  }
  EXPECT_LT(table.lag.high_deg, least_deg);
  EXPECT_GT(table.lag.high_deg, least_deg - 3.0);  // reached but for the least damping allowed
  EXPECT_EQ(table.diagnosis.kind, VerdictKind::kUnknown);
  EXPECT_NEAR(table.cutoff_min_hz * std::tan(table.lag.high_deg * kRadPerDeg),
              table.mean_frequency_hz, 1e-9 * table.mean_frequency_hz);
}

// A loop with a known sensor: its table admits the true lag, and lies to both sides of it.
TEST(TableDiagnosis, AdmitsTheTrueLag) {
  const LoopParameters<double> loop{{215.0, 0.2, 6609.0, 2743.0, 3.0}, 3.46e-3};
  const auto closes = [&loop](double low, double high) {
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (LoopPhaseError(loop, middle) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  const double f = closes(190.0, 240.0);
  const double f2 = closes(690.0, 800.0);
  ASSERT_NEAR(LoopPhaseError(loop, f), 0.0, 1e-9);
  ASSERT_NEAR(LoopPhaseError(loop, f2), 0.0, 1e-9);
  const Complex<double> g = AcousticResponse(loop.acoustics, f);
  for (const double lag_deg : {0.0, 20.0, 45.0}) {
    Experiment row =
        Row("a", f, Angle(g) * kDegPerRad + lag_deg, Magnitude(g) / std::cos(lag_deg * kRadPerDeg));
    row.lines = {{f2, 5.0}};
    const TableDiagnosis table = DiagnoseTable({row}, Limits());
    ASSERT_TRUE(table.lag.any) << lag_deg;
    EXPECT_LT(table.lag.low_deg, lag_deg);
    EXPECT_GT(table.lag.high_deg, lag_deg);
    EXPECT_LT(table.lag.high_deg - table.lag.low_deg, 40.0);
    EXPECT_LT(table.experiments.at(0).tau_low_s, loop.tau_s);
    EXPECT_GT(table.experiments.at(0).tau_high_s, loop.tau_s);
  }
}

TEST(TableDiagnosis, OneModeInClosedForm) {
  // (5c) without a second mode: with t = tan(lambda - Delta), omega = f (sqrt(xi^2 t^2 + 1) - xi
  // t), and the line needs tan(arg G(f2)) = (omega^2 - f2^2) / (2 xi omega f2).
  TableLimits limits = Limits();
  limits.modes = 1;
  limits.xi_min = 0.2;
  limits.xi_max = 0.2 * (1.0 + 1e-12);
  limits.line_sigmas = 0.0;
  Experiment row = Row("a", 215.0, -10.0, 12.0);
  row.lines = {{780.0, 10.0}};
  const auto error_deg = [&](double lag_deg) {
    const double t = std::tan((lag_deg + 10.0) * kRadPerDeg);
    const double omega = 215.0 * (std::sqrt(0.04 * t * t + 1.0) - 0.2 * t);
    const double g = std::atan2(omega * omega - 780.0 * 780.0, 2.0 * 0.2 * omega * 780.0);
    return WrapDeg(90.0 + 360.0 * DelayAtLag(row, lag_deg) * 780.0 - g * kDegPerRad);
  };
  double low = -20.0;
  double high = 40.0;
  ASSERT_LT(error_deg(low) * error_deg(high), 0.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (error_deg(low) * error_deg(middle) > 0.0 ? low : high) = middle;
  }
  // The line without a width gives one lag alone; with one of 1 Hz, an interval around it.
  limits.line_sigmas = 0.1;
  const LagInterval lag = DiagnoseTable({row}, limits).lag;
  ASSERT_TRUE(lag.any);
  EXPECT_NEAR(0.5 * (lag.low_deg + lag.high_deg), low, 0.02);
}

}  // namespace
}  // namespace howl::table_diagnosis_test
