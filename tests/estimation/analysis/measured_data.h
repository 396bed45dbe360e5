// Measured and practice records for tests, from the folders that HOWL_DATA and HOWL_PRACTICE name.
// A reader of its own, so that these tests depend on no file format code.
#ifndef HOWL_TESTS_ESTIMATION_ANALYSIS_MEASURED_DATA_H_
#define HOWL_TESTS_ESTIMATION_ANALYSIS_MEASURED_DATA_H_

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "estimation/analysis/spectra/record.h"

namespace howl::fixtures {

inline std::optional<std::string> DataFolder(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || *value == '\0') return std::nullopt;
  return std::string(value);
}

// Numbers of a plain or gzip text file with white space or commas between columns; lines that do
// not begin with a number are skipped.
inline std::vector<std::vector<double>> ReadColumns(const std::string& path) {
  std::string text;
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return {};
  char buffer[1 << 16];
  for (int n = 0; (n = gzread(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  gzclose(file);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<std::vector<double>> columns;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const char* at = line.c_str();
    for (std::size_t column = 0;; ++column) {
      char* end = nullptr;
      const double value = std::strtod(at, &end);
      if (end == at) break;
      if (column == columns.size()) columns.emplace_back();
      columns[column].push_back(value);
      at = end;
    }
  }
  return columns;
}

// Turbulent combustor: time, heat release, pressure at 10 kHz.
inline Record CombustorRecord(const std::string& folder, int point) {
  const auto columns =
      ReadColumns(folder + "/turbulent_combustor/p" + std::to_string(point) + ".txt.gz");
  return columns.size() == 3 ? Record{10000.0, columns[2], columns[1]} : Record{};
}

// Rijke tube: time, pressure.
inline Record RijkeRecord(const std::string& folder, const std::string& name) {
  auto columns = ReadColumns(folder + "/rijke_tube/" + name + ".txt.gz");
  if (columns.size() != 2) return {};
  const auto& time = columns[0];
  const double sampling_hz = static_cast<double>(time.size() - 1) / (time.back() - time.front());
  return {sampling_hz, columns[1], {}};
}

// Practice rigs: p, q at 5 kHz. The truth file holds one line for each experiment.
inline Record PracticeRecord(const std::string& folder, const std::string& rig, int experiment) {
  auto columns =
      ReadColumns(folder + "/" + rig + "/data/exp" + std::to_string(experiment) + ".csv");
  return columns.size() == 2 ? Record{5000.0, columns[0], columns[1]} : Record{};
}

inline double PracticeTruth(const std::string& folder, const std::string& rig, int experiment,
                            const std::string& key) {
  std::ifstream file(folder + "/" + rig + ".truth.json");
  std::string line;
  for (int i = 0; i <= experiment; ++i) std::getline(file, line);
  const auto at = line.find("\"" + key + "\":");
  return at == std::string::npos ? 0.0 : std::strtod(line.c_str() + at + key.size() + 3, nullptr);
}

}  // namespace howl::fixtures

#endif  // HOWL_TESTS_ESTIMATION_ANALYSIS_MEASURED_DATA_H_
