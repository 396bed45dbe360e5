#include "io/results/flame_export.h"

#include <matio.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <numbers>
#include <system_error>

#include "io/results/csv_writer.h"
#include "io/user_error.h"
#include "io/whole_file.h"
#include "model/loop/acoustics.h"

namespace howl {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMilliseconds = 1e3;

// (frequency, value) in two columns, as MATLAB stores them: column by column.
bool AddTable(mat_t* file, const char* name, const std::vector<double>& frequencies_hz,
              const std::vector<double>& values) {
  std::vector<double> table = frequencies_hz;
  table.insert(table.end(), values.begin(), values.end());
  std::array<std::size_t, 2> sizes = {values.size(), 2};
  const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(
      Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sizes.data(), table.data(), 0),
      Mat_VarFree);
  return variable && Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) == 0;
}

}  // namespace

double FlameGain(const Flame<double>& flame, const FlameScale& scale, double velocity_ratio) {
  const double amplitude = velocity_ratio * scale.rate_at_full_modulation;
  return -DescribingFunction(flame, amplitude) * scale.rate_at_full_modulation /
         scale.mean_heat_release;
}

std::string OscilosLiteFlame(double gain, double tau_s) {
  std::array<char, 128> row{};
  std::snprintf(row.data(), row.size(), "1\t\t%.17g\t\t%.17g\n", gain, kMilliseconds * tau_s);
  return std::string("Type\t\tParam_1\t\tParam_2\n") + row.data();
}

void WriteOscilosLongFlame(const std::filesystem::path& path, double gain, double tau_s,
                           const std::vector<double>& frequencies_hz) {
  std::vector<double> phases_rad;
  for (const double f : frequencies_hz) phases_rad.push_back(-2.0 * std::numbers::pi * f * tau_s);
  // matio writes files alone; what it wrote becomes one that appears as a whole. The header is the
  // same every time: matio's own has the date.
  std::filesystem::create_directories(path.parent_path());
  const std::filesystem::path draft = path.string() + ".matio";
  bool good = false;
  {
    const std::unique_ptr<mat_t, int (*)(mat_t*)> file(
        Mat_CreateVer(draft.c_str(), "MATLAB 5.0 MAT-file, by howl export", MAT_FT_MAT5),
        Mat_Close);
    good = file &&
           AddTable(file.get(), "Gain", frequencies_hz,
                    std::vector<double>(frequencies_hz.size(), gain)) &&
           AddTable(file.get(), "Phase", frequencies_hz, phases_rad);
  }
  const std::string bytes = good ? ReadWholeFile(draft).value_or("") : std::string();
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);
  if (!good) throw UserError(path.string(), 0, "", "cannot be written");
  WriteWholeFile(path, bytes);
}

std::string FlameTableCsv(const Flame<double>& flame, double tau_s,
                          const std::vector<double>& frequencies_hz,
                          const std::vector<double>& amplitudes) {
  CsvWriter csv("frequency_hz,amplitude,gain,phase_deg");
  for (const double amplitude : amplitudes) {
    const double gain = -DescribingFunction(flame, amplitude);
    for (const double f : frequencies_hz) {
      csv.Cell(f).Cell(amplitude).Cell(gain).Cell(180.0 - 360.0 * f * tau_s).EndRow();
    }
  }
  return csv.Text();
}

std::string AcousticsTableCsv(const LoopModel& model, const std::vector<double>& frequencies_hz) {
  CsvWriter csv("frequency_hz,gain,phase_deg");
  for (const double f : frequencies_hz) {
    if (f == 0.0) {  // G(0) = 0 from the side of 90 degrees
      csv.Cell(f).Cell(0.0).Cell(90.0).EndRow();
      continue;
    }
    const Complex<double> g = AcousticResponse(model.Loop().acoustics, f);
    csv.Cell(f).Cell(Magnitude(g)).Cell(kDegrees * std::atan2(g.im, g.re)).EndRow();
  }
  return csv.Text();
}

}  // namespace howl
