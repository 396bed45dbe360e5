// Records with two oscillations through the program: cycle_hz picks, oscillations.csv lists. And
// the sources of noise that a config gives to simulate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::oscillations_test {
namespace {

using ::testing::HasSubstr;

// 4 s at 2 kHz: p = cos 210 Hz + 0.8 cos 263 Hz, q the same with gains 12 and 5, p 10 degrees
// behind q and 30 before it; and 9 Hz that rules q.
std::string TwoAcousticAndASlowOne() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::ostringstream csv;
  csv << "p,q\n" << std::setprecision(9);
  for (int i = 0; i < 8000; ++i) {
    const double t = 2.0 * M_PI * i / 2000.0;
    const double deg = M_PI / 180.0;
    const double p = std::cos(210.0 * t) + 0.8 * std::cos(263.0 * t) + 0.05 * normal(random);
    const double q = std::cos(210.0 * t + 10.0 * deg) / 12.0 +
                     0.8 * std::cos(263.0 * t - 30.0 * deg) / 5.0 + 0.5 * std::cos(9.0 * t) +
                     0.005 * normal(random);
    csv << p << ',' << q << '\n';
  }
  return csv.str();
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(Oscillations, AreListedAndOneIsPicked) {
  const TemporaryFolder folder;
  folder.Write("two.csv", TwoAcousticAndASlowOne());
  const std::string record =
      "record: {file: two.csv, pressure: p, heat_release: q, "
      "sampling_hz: 2000}";
  const auto config = folder.Write("config.yaml",
                                   "cycle_hz: [240, 290]\n"
                                   "experiments:\n"
                                   "  - {name: upper, phi: 0.5, " +
                                       record +
                                       "}\n"
                                       "  - {name: lower, phi: 0.6, cycle_hz: [180, 240], " +
                                       record + "}\n");
  const ProgramResult result =
      RunHowl("analyse " + config.string() + " --out " + (folder.path() / "out").string());
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("records with several oscillations"));
  // The contract's columns, as they were.
  const auto rows = Lines(ReadFile(folder.path() / "out" / "characteristics.csv"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0],
            "name,phi,frequency_hz,frequency_std_hz,phase_deg,phase_std_deg,gain,gain_std,tau_s,"
            "flame_slope,flame_slope_std,loop_gain,stationary");
  const auto upper = Cells(rows[1]), lower = Cells(rows[2]);
  EXPECT_NEAR(std::stod(upper[2]), 263.0, 0.02);
  EXPECT_NEAR(std::stod(upper[4]), 30.0, 0.5);
  EXPECT_NEAR(std::stod(upper[6]), 5.0, 0.05);
  EXPECT_NEAR(std::stod(lower[2]), 210.0, 0.02);
  EXPECT_NEAR(std::stod(lower[4]), -10.0, 0.5);
  EXPECT_NEAR(std::stod(lower[6]), 12.0, 0.12);
  // Each record has all three, of which one is the cycle.
  const auto listed = Lines(ReadFile(folder.path() / "out" / "oscillations.csv"));
  ASSERT_EQ(listed.size(), 7U);
  for (const auto& [name, cycle_hz] : {std::pair{"upper", 263.0}, {"lower", 210.0}}) {
    std::vector<double> found;
    for (std::size_t i = 1; i < listed.size(); ++i) {
      const auto cells = Cells(listed[i]);
      if (cells[0] != name) continue;
      found.push_back(std::round(std::stod(cells[4])));
      EXPECT_EQ(cells[2], found.back() == cycle_hz ? "true" : "false") << listed[i];
      EXPECT_EQ(cells[3], "limit_cycle") << listed[i];
    }
    EXPECT_THAT(found, ::testing::UnorderedElementsAre(9.0, 210.0, 263.0));
  }
  const auto json = nlohmann::json::parse(ReadFile(folder.path() / "out" / "analysis.json"));
  EXPECT_EQ(json["oscillations"].size(), 2U);
  EXPECT_EQ(json["oscillations"][0]["oscillations"].size(), 3U);
}

TEST(NoiseSources, AreOfTheConfigAndNullIsNull) {
  const TemporaryFolder folder;
  const std::string experiments =
      "experiments:\n  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14, "
      "flame_slope: -0.703e-4}\nsimulate:\n  duration_s: 0.5\n";
  const auto record = [&](const std::string& name, const std::string& noise) {
    const auto config = folder.Write(name + ".yaml", experiments + noise);
    const std::string out = (folder.path() / name).string();
    const ProgramResult result =
        RunHowl("simulate " + config.string() + " --quiet --seed 5 --out " + out);
    EXPECT_EQ(result.status, 0) << result.err;
    return ReadFile(folder.path() / name / "a.csv");
  };
  const std::string plain = record("plain", "");
  EXPECT_EQ(record("null",
                   "  noise: [{source: duct, rms_relative: 0, corner_hz: 300}, "
                   "{source: background, rms_relative: 0}]\n"),
            plain);
  const std::string noisy =
      record("noisy", "  noise: [{source: pressure_sensor, rms_relative: 0.1, corner_hz: 50}]\n");
  // q is what it was.
  const auto before = Lines(plain), after = Lines(noisy);
  ASSERT_EQ(before.size(), after.size());
  EXPECT_NE(before[100], after[100]);
  for (std::size_t i = 1; i < before.size(); ++i) {
    ASSERT_EQ(Cells(before[i])[1], Cells(after[i])[1]);
  }
  EXPECT_NE(record("duct", "  noise: [{source: duct, rms_relative: 0.1, peak_hz: 120}]\n"), plain);
}

}  // namespace
}  // namespace howl::oscillations_test
