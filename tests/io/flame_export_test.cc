// What OSCILOS would make of the files, computed here from their text and numbers by its own
// formulas, against the flame in closed form.
#include "io/results/flame_export.h"

#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <complex>
#include <sstream>

#include "model/numerics/constants.h"
#include "tests/io/record_files.h"

namespace howl::flame_export_test {
namespace {

using Number = std::complex<double>;

constexpr double kSlope = -6.5e-5, kSaturation = 20.0, kTau = 3.4e-3;
constexpr FlameScale kScale = {.mean_heat_release = 50.0, .rate_at_full_modulation = 1.2e6};

// n = |k| V / mean q times D(a) / D(0): of a clipped line by Gelb and Van der Velde (1968), of the
// cubic by hand, both at x = a V |k| / Q.
double ClippedGain(double x) {
  if (x <= 1.0) return 1.0;
  return 2.0 / kPi * (std::asin(1.0 / x) + std::sqrt(1.0 - 1.0 / (x * x)) / x);
}
double CubicGain(double x) { return 1.0 - x * x / 9.0; }  // up to 3/2

double GainAtRest() { return -kSlope * kScale.rate_at_full_modulation / kScale.mean_heat_release; }
double Relative(double ratio) {
  return ratio * kScale.rate_at_full_modulation * -kSlope / kSaturation;
}

// OSCILOS_lite: textscan of three words and of three numbers, then polyval and exp.
Number LiteTransfer(const std::string& text, Number s) {
  std::istringstream words(text);
  std::string title;
  for (int k = 0; k < 3; ++k) words >> title;
  double type = 0.0, gain = 0.0, delay_ms = 0.0;
  words >> type >> gain >> delay_ms;
  EXPECT_EQ(type, 1.0);
  return gain * std::exp(-s * delay_ms * 1e-3);
}

struct Table {
  std::vector<double> f, value;
};

Table ReadTable(mat_t* file, const char* name) {
  matvar_t* const variable = Mat_VarRead(file, name);
  EXPECT_NE(variable, nullptr);
  EXPECT_EQ(variable->rank, 2);
  EXPECT_EQ(variable->dims[1], 2u);
  const auto rows = variable->dims[0];
  const auto* const data = static_cast<const double*>(variable->data);
  Table table{{data, data + rows}, {data + rows, data + 2 * rows}};
  Mat_VarFree(variable);
  return table;
}

// MATLAB's interp1(f, value, at, 'linear', 'extrap').
double Interpolated(const Table& table, double at) {
  std::size_t k = 1;
  while (k + 1 < table.f.size() && table.f[k] < at) ++k;
  const double share = (at - table.f[k - 1]) / (table.f[k] - table.f[k - 1]);
  return table.value[k - 1] + share * (table.value[k] - table.value[k - 1]);
}

TEST(FlameExport, OscilosLiteReadsTheFlameAtRest) {
  const Flame<double> flame{FlameShape::kTanh, kSlope, kSaturation, 0.0};
  const std::string text = OscilosLiteFlame(FlameGain(flame, kScale, 0.0), kTau);
  for (const double f : {0.0, 37.5, 205.7, 1000.0}) {
    const Number s(3.0, 2.0 * kPi * f);
    const Number truth = GainAtRest() * std::exp(-s * kTau);
    EXPECT_LT(std::abs(LiteTransfer(text, s) - truth), 1e-13 * std::abs(truth)) << f;
  }
}

TEST(FlameExport, OscilosLongReadsTheDescribingFunctionAtEveryFrequency) {
  const TemporaryFolder folder;
  const std::vector<double> frequencies = {0.0, 50.0, 100.0, 200.0, 450.0, 1000.0};
  struct Case {
    FlameShape shape;
    double (*gain)(double);
    double tolerance;  // of the describing function's sum over a cycle
  };
  for (const Case& one : {Case{FlameShape::kPiecewiseLinear, ClippedGain, 1e-4},
                          Case{FlameShape::kCubic, CubicGain, 1e-12}}) {
    const Flame<double> flame{one.shape, kSlope, kSaturation, 0.0};
    for (const double ratio : {0.0, 0.1, 0.3}) {
      const auto path = folder / "new" / "FTF.mat";
      WriteOscilosLongFlame(path, FlameGain(flame, kScale, ratio), kTau, frequencies);
      mat_t* const file = Mat_Open(path.c_str(), MAT_ACC_RDONLY);
      ASSERT_NE(file, nullptr);
      const Table gain = ReadTable(file, "Gain");
      const Table phase = ReadTable(file, "Phase");
      Mat_Close(file);
      for (double f = 0.0; f <= 1200.0; f += 7.0) {
        const Number read = std::polar(std::abs(Interpolated(gain, f)), Interpolated(phase, f));
        const Number truth =
            GainAtRest() * one.gain(Relative(ratio)) * std::exp(Number(0.0, -2.0 * kPi * f * kTau));
        EXPECT_LT(std::abs(read - truth), one.tolerance * std::abs(truth)) << ratio << " " << f;
      }
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "new" / "FTF.mat.matio"));
}

std::vector<std::vector<double>> Rows(const std::string& csv, const std::string& head) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, head);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

TEST(FlameExport, TheTablesAreTheModelInNaturalUnits) {
  const Flame<double> flame{FlameShape::kCubic, kSlope, kSaturation, 0.0};
  const std::vector<double> frequencies = {0.0, 100.0, 219.9, 500.0};
  const auto flames = Rows(FlameTableCsv(flame, kTau, frequencies, {0.0, 3e5}),
                           "frequency_hz,amplitude,gain,phase_deg");
  ASSERT_EQ(flames.size(), 8u);
  for (const auto& row : flames) {
    const Number read = std::polar(row[2], row[3] * kPi / 180.0);
    const double slope = kSlope * CubicGain(row[1] * -kSlope / kSaturation);
    const Number truth = slope * std::exp(Number(0.0, -2.0 * kPi * row[0] * kTau));
    EXPECT_LT(std::abs(read - truth), 1e-11 * std::abs(truth));
  }
  const LoopModel model{210.0, 0.1, 3000.0, 800.0, kTau};
  const auto acoustics = Rows(AcousticsTableCsv(model, frequencies), "frequency_hz,gain,phase_deg");
  ASSERT_EQ(acoustics.size(), 4u);
  for (const auto& row : acoustics) {  // (5a)
    const Number s(0.0, 2.0 * kPi * row[0]);
    const double o = 2.0 * kPi * 210.0;
    const Number truth = 3000.0 * s / (s * s + 2.0 * 0.1 * o * s + o * o) +
                         800.0 * s / (s * s + 2.0 * 0.1 * 3.0 * o * s + 9.0 * o * o);
    EXPECT_LT(std::abs(std::polar(row[1], row[2] * kPi / 180.0) - truth), 1e-12);
  }
}

}  // namespace
}  // namespace howl::flame_export_test
