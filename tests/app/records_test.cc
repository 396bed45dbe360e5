// Records through the program: the round trip from published numbers to records and back, measured
// records, and bad ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

#include "tests/app/program.h"

namespace howl::records_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Rows of a CSV file by the header's names.
std::vector<std::map<std::string, std::string>> ReadCsv(const std::filesystem::path& path) {
  std::stringstream lines(ReadFile(path));
  std::string line;
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    std::stringstream cells(line);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    if (names.empty()) {
      names = values;
      continue;
    }
    values.resize(names.size());
    std::map<std::string, std::string> row;
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = values[k];
    rows.push_back(row);
  }
  return rows;
}

// The paper's table 2.
constexpr std::array<std::array<double, 3>, 6> kTable2 = {{{219.9, -5.74, 12.14},
                                                           {209.1, -9.44, 13.15},
                                                           {205.7, -14.35, 14.79},
                                                           {202.7, -19.18, 16.05},
                                                           {198.4, -22.92, 18.80},
                                                           {179.8, -42.72, 45.01}}};

TEST(RoundTrip, FittedSimulatedAnalysedGivesTableTwoBack) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  ASSERT_EQ(RunHowl("simulate " + Config("r228_two_modes") + out).status, 0);
  const std::string records = (folder.path() / "records.yaml").string();
  const ProgramResult analyse = RunHowl("analyse " + records + out);
  ASSERT_EQ(analyse.status, 0) << analyse.err;
  const auto rows = ReadCsv(folder.path() / "characteristics.csv");
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = [&](const char* name) { return std::stod(rows[i].at(name)); };
    EXPECT_NEAR(value("frequency_hz") / kTable2[i][0], 1.0, 0.005);
    EXPECT_NEAR(value("phase_deg"), kTable2[i][1], 1.0);
    EXPECT_NEAR(value("gain") / kTable2[i][2], 1.0, 0.02);
    EXPECT_EQ(rows[i].at("stationary"), "true");
  }
  // The same config with records in the place of numbers runs fit, family and list unchanged.
  EXPECT_EQ(RunHowl("fit " + records + out).status, 0);
}

TEST(RoundTrip, OneModeRecordsRunFitFamilyAndList) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  ASSERT_EQ(RunHowl("simulate " + Config("r228_reliable") + out).status, 0);
  // The published config with its numbers replaced by records and nothing else changed.
  std::string text = ReadFile(Config("r228_reliable"));
  std::string swapped;
  std::stringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t numbers = line.find("frequency_hz:");
    if (numbers != std::string::npos) {
      const std::size_t name = line.find("exp");
      line = line.substr(0, numbers) + "record: {file: " + line.substr(name, 4) +
             ".csv, pressure: p, heat_release: q, sampling_hz: 5000}}";
    }
    swapped += line + "\n";
  }
  swapped += "residuals: {transfer: off}\n";
  const std::string config = folder.Write("swapped.yaml", swapped).string();
  for (const std::string command : {"fit ", "family ", "list "}) {
    const ProgramResult run = RunHowl(command + config + out);
    EXPECT_EQ(run.status, 0) << command << run.out << run.err;
  }
}

// What the records are asked is what the table was asked: the same model, scopes, test and
// residuals.
TEST(RoundTrip, RecordsYamlAsksWhatTheConfigAsks) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const std::string config =
      folder
          .Write("asked.yaml",
                 "experiments:\n"
                 "  - &first {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74,\n"
                 "            gain: 12.14, flame_slope: -0.703e-4}\n"
                 "  - {<<: *first, name: exp2, phi: 0.53, frequency_hz: 219.0}\n"
                 "parameters: {tau_s: {scope: shared}}\n"
                 "residuals: {tau_prior: off, damping_prior: {xi_typical: 0.15}}\n"
                 "family: {members: 20, test: {xi_max: 0.21, xi_increasing: false}}\n"
                 "simulate: {effects: [{effect: mains_hum, rel: 0.1, hz: 50}]}\n")
          .string();
  const ProgramResult simulate = RunHowl("simulate " + config + out);
  ASSERT_EQ(simulate.status, 0) << simulate.err;
  const std::string text = ReadFile(folder.path() / "records.yaml");
  EXPECT_THAT(text, Not(HasSubstr("hum")));
  const std::string records = (folder.path() / "records.yaml").string();
  ASSERT_EQ(RunHowl("fit " + records + out).status, 0);
  EXPECT_THAT(ReadFile(folder.path() / "solution.json"), HasSubstr("\"name\": \"tau_s\""));
  const ProgramResult family = RunHowl("family " + records + out);
  EXPECT_LE(family.status, 1) << family.err;
  EXPECT_THAT(ReadFile(folder.path() / "family.json"), HasSubstr("\"xi_max\": 0.21"));
}

TEST(Simulate, SameSeedSameRecordsWithAnyNumberOfThreads) {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "2"}) {
    ASSERT_EQ(RunHowl("simulate " + Config("r228_reliable") + " --threads " + threads + " --out " +
                      (folder.path() / threads).string())
                  .status,
              0);
  }
  EXPECT_EQ(ReadFile(folder.path() / "1" / "exp3.csv"), ReadFile(folder.path() / "2" / "exp3.csv"));
}

TEST(MeasuredRecords, StoredFiguresAreReproduced) {
  if (std::getenv("HOWL_DATA") == nullptr) {
    GTEST_SKIP() << "HOWL_DATA is not set: no measured records here";
  }
  for (const std::string name : {"turbulent_combustor", "rijke_tube"}) {
    const ProgramResult run = RunHowl("regress " + Config(name));
    EXPECT_EQ(run.status, 0) << run.out << run.err;
  }
}

struct BadRecord {
  std::string name;
  std::string content;
  std::string record;   // keys of the record beside `file`
  std::string message;  // part of the one line
};

std::string GoodRows(int count, const std::string& header = "p,q\n") {
  std::string text = header;
  for (int i = 0; i < count; ++i) {
    text += std::to_string(std::sin(0.26 * i)) + "," + std::to_string(std::cos(0.26 * i)) + "\n";
  }
  return text;
}

std::string TimedRows(int count, int gap_at, double step_s) {
  std::string text = "t,p,q\n";
  double t = 0.0;
  for (int i = 0; i < count; ++i) {
    char row[80];
    std::snprintf(row, sizeof row, "%.6f,%.5f,%.5f\n", t, std::sin(0.26 * i), std::cos(0.26 * i));
    text += row;
    t += i == gap_at ? 0.5 : step_s;
  }
  return text;
}

TEST(BadRecords, EachIsOneLineStatusTwoAndNoOutput) {
  const std::string plain = "pressure: p, heat_release: q, sampling_hz: 5000";
  const std::string timed = "pressure: p, heat_release: q, time: t";
  std::string constant = "p,q\n";
  for (int i = 0; i < 9000; ++i) constant += "1,0.5\n";
  const std::vector<BadRecord> cases = {
      {"nan", GoodRows(8998) + "nan,1\n" + GoodRows(100, ""), plain, "data.csv:9000: p: nan"},
      {"ragged", GoodRows(100) + "1\n" + GoodRows(100, ""), plain, "data.csv:102:"},
      {"one sample", GoodRows(1), plain, "expected at least 32"},
      {"constant", constant, plain, "constant"},
      {"wrong column", GoodRows(9000), "pressure: pressure, heat_release: q, sampling_hz: 5000",
       "no such column"},
      {"truncated gzip", std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03\x4b", 11), plain, "gzip"},
      {"two rates", TimedRows(9000, -1, 0.0002), timed + ", sampling_hz: 10000",
       "two sampling rates"},
      {"time gap", TimedRows(9000, 5000, 0.0002), timed, "time gap"},
      {"text", GoodRows(500) + "0.1V,1\n", plain, "data.csv:502: p:"},
      {"empty", "", plain, "empty"}};
  for (const BadRecord& bad : cases) {
    const TemporaryFolder folder;
    folder.Write("data.csv", bad.content);
    const auto config = folder.Write(
        "config.yaml",
        "experiments:\n  - {name: a, phi: 0.5, record: {file: data.csv, " + bad.record + "}}\n");
    const std::filesystem::path out = folder.path() / "out";
    for (const std::string command : {"analyse ", "fit ", "family "}) {
      const ProgramResult run = RunHowl(command + config.string() + " --out " + out.string());
      EXPECT_EQ(run.status, 2) << bad.name;
      EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << bad.name << "\n" << run.err;
      EXPECT_THAT(run.err, testing::HasSubstr(bad.message)) << bad.name;
      EXPECT_EQ(run.out, "") << bad.name;
      EXPECT_FALSE(std::filesystem::exists(out)) << bad.name;
    }
  }
}

}  // namespace
}  // namespace howl::records_test
