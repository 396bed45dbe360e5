// howl simulate in the place of section 4 of the paper: two lines, two cycles, hysteresis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "model/loop/crossings.h"
#include "tests/app/program.h"

namespace howl::simulate_test {
namespace {

using testing::HasSubstr;

// The first column, p.
std::vector<double> ReadPressure(const std::filesystem::path& path) {
  std::istringstream lines(ReadFile(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "p,q");
  std::vector<double> p;
  while (std::getline(lines, line)) p.push_back(std::stod(line));
  return p;
}

// Power of p at f, by a Hann window a fifth of a second long, over the whole record.
double Power(const std::vector<double>& p, double f) {
  constexpr std::size_t kWindow = 1000;
  constexpr double kSampling = 5000.0;
  double sum = 0.0;
  for (std::size_t begin = 0; begin + kWindow <= p.size(); begin += kWindow / 2) {
    double re = 0.0;
    double im = 0.0;
    for (std::size_t i = 0; i < kWindow; ++i) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(i);
      const double hann = 1.0 - std::cos(turn / kWindow);
      re += hann * p[begin + i] * std::cos(turn * f / kSampling);
      im += hann * p[begin + i] * std::sin(turn * f / kSampling);
    }
    sum += re * re + im * im;
  }
  return sum;
}

double StrongestIn(const std::vector<double>& p, double lo, double hi) {
  double best = lo;
  double most = -1.0;
  for (double f = lo; f <= hi; f += 2.5) {
    const double power = Power(p, f);
    if (power > most) {
      most = power;
      best = f;
    }
  }
  return best;
}

// The loop of configs/r228_section4.yaml, with other lines under `simulate:`.
std::string Section4(const std::string& simulate) {
  return "experiments:\n"
         "  - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,\n"
         "     flame_slope: -0.703e-4}\n"
         "model: {modes: 2}\n"
         "parameters:\n"
         "  omega_hz: {initial: 215, fixed: true}\n"
         "  xi: {initial: 0.2, fixed: true}\n"
         "  M_over_N: {initial: 0.7, fixed: true}\n"
         "  tau_s: {initial: 0.00346, fixed: true}\n"
         "simulate:\n" +
         simulate;
}

TEST(Section4, TheShippedConfigHasBothLinesAndHysteresis) {
  const TemporaryFolder folder;
  const ProgramResult run =
      RunHowl("simulate " + Config("r228_section4") + " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  // Figure 11: a line near 215 Hz and one near 750 Hz, neither of them the other's harmonic.
  const std::vector<double> p = ReadPressure(folder.path() / "exp1.csv");
  const double low_hz = StrongestIn(p, 150.0, 300.0);
  const double high_hz = StrongestIn(p, 700.0, 850.0);
  EXPECT_NEAR(low_hz, 216.0, 5.0);
  EXPECT_NEAR(high_hz, 750.0, 10.0);
  const double between = Power(p, 450.0);
  EXPECT_GT(Power(p, low_hz), 30.0 * between);
  EXPECT_GT(Power(p, high_hz), 30.0 * between);

  // Figure 12: the loop closes at both, with a gain above one, and the outer one is near 750 Hz.
  ASSERT_EQ(RunHowl("fit " + Config("r228_section4") + " --out " + folder.path().string()).status,
            0);
  const nlohmann::json fit =
      nlohmann::json::parse(ReadFile(folder.path() / "solution.json"))["experiments"][0];
  EXPECT_DOUBLE_EQ(fit["omega_hz"], 215.0);
  EXPECT_DOUBLE_EQ(fit["xi"], 0.2);
  EXPECT_DOUBLE_EQ(fit["tau_s"], 0.00346);
  const LoopParameters<double> loop = {{fit["omega_hz"], fit["xi"], fit["N"], fit["M"], 3.0},
                                       fit["tau_s"]};
  double inner = 0.0;
  double outer = 0.0;
  for (const PhaseCrossing& crossing : PhaseCrossings(loop, -0.703e-4, 900.0)) {
    if (std::abs(crossing.frequency_hz - 216.0) < 5.0) inner = crossing.gain;
    if (std::abs(crossing.frequency_hz - 746.0) < 10.0) outer = crossing.gain;
  }
  EXPECT_GT(inner, 1.0);
  EXPECT_GT(outer, inner);

  // Up, the lower cycle is left where it attracts no more, at 0.92; down, the upper one at 0.63
  // (tests/model/continuation_test.cc).
  EXPECT_THAT(run.out, HasSubstr("on the cycle at 750."));
  EXPECT_THAT(run.out, HasSubstr("by harmonic balance both cycles attract from 0.62"));
  std::istringstream rows(ReadFile(folder.path() / "sweep.csv"));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "experiment,direction,parameter,value,frequency_hz,p_amplitude");
  int up = 0;
  int down = 0;
  while (std::getline(rows, row)) {
    std::istringstream cells(row);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    ASSERT_EQ(cell.size(), 6u);
    EXPECT_EQ(cell[0] + cell[2], "exp1M_over_N");
    const bool is_up = cell[1] == "up";
    ++(is_up ? up : down);
    const double value = std::stod(cell[3]);
    const double frequency_hz = std::stod(cell[4]);
    const double switches_at = is_up ? 0.94 : 0.61;
    if (std::abs(value - switches_at) < 0.04) continue;
    EXPECT_NEAR(frequency_hz, value > switches_at ? 750.0 : 216.5, 5.0) << row;
  }
  EXPECT_EQ(up, 55);
  EXPECT_EQ(down, 55);
}

TEST(Section4, StartsWhereItIsAskedTo) {
  const TemporaryFolder folder;
  const std::string quiet =
      "  {duration_s: 1, settle_s: 0, combustion_noise_relative: 0, "
      "sensor_noise_relative: 0, ";
  for (const auto& [start, text, lo, hi] :
       std::vector<std::tuple<std::string, std::string, double, double>>{
           {"start: observed", "on the cycle at 216.", 210.0, 222.0},
           {"start: upper", "on the cycle at 750.", 745.0, 755.0},
           {"start_frequency_hz: 740", "on the cycle at 750.", 745.0, 755.0},
           {"start_frequency_hz: 220", "on the cycle at 216.", 210.0, 222.0}}) {
    const std::string config = folder.Write("start.yaml", Section4(quiet + start + "}\n")).string();
    const ProgramResult run = RunHowl("simulate " + config + " --out " + folder.path().string());
    ASSERT_EQ(run.status, 0) << start << run.err;
    EXPECT_THAT(run.out, HasSubstr(text)) << start;
    const std::vector<double> p = ReadPressure(folder.path() / "exp1.csv");
    const double frequency_hz = StrongestIn(p, 100.0, 1000.0);
    EXPECT_GE(frequency_hz, lo) << start;
    EXPECT_LE(frequency_hz, hi) << start;
    // It is there from the first sample on, and stays.
    const auto largest = [&](std::size_t begin) {
      return *std::max_element(p.begin() + static_cast<std::ptrdiff_t>(begin),
                               p.begin() + static_cast<std::ptrdiff_t>(begin + 100));
    };
    EXPECT_NEAR(largest(100) / largest(4800), 1.0, 0.02) << start;
  }
  // At rest without noise nothing ever starts.
  const std::string rest = folder.Write("rest.yaml", Section4(quiet + "start: rest}\n")).string();
  const ProgramResult run = RunHowl("simulate " + rest + " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("at rest"));
  const std::vector<double> p = ReadPressure(folder.path() / "exp1.csv");
  EXPECT_EQ(*std::ranges::max_element(p), 0.0);
}

// Records give their flame's shape and offset: what is simulated from them has both.
TEST(MeasuredFlame, IsSimulatedWhereRecordsGaveOne) {
  const TemporaryFolder folder;
  const std::string one =
      "experiments:\n"
      "  - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,\n"
      "     flame_slope: -0.703e-4}\n";
  const std::string config =
      folder.Write("cubic.yaml", one + "simulate: {flame_shape: cubic, saturation: 0.3}\n")
          .string();
  const std::string first = (folder.path() / "first").string();
  ASSERT_EQ(RunHowl("simulate " + config + " --out " + first).status, 0);
  const auto flame_of = [&](const std::string& out) {
    return nlohmann::json::parse(ReadFile(out + "/simulation.json"))["experiments"][0]["flame"];
  };
  EXPECT_EQ(flame_of(first)["shape"], "cubic");
  EXPECT_EQ(flame_of(first)["offset"], 0.0);
  // records.yaml does not say which flame it was; the records do.
  const std::string second = (folder.path() / "second").string();
  const ProgramResult run = RunHowl("simulate " + first + "/records.yaml --out " + second);
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json measured = flame_of(second);
  EXPECT_EQ(measured["shape"], "cubic");
  EXPECT_NEAR(measured["saturation"].get<double>(), 0.3, 0.01);
  EXPECT_THAT(run.out, HasSubstr("cubic"));
  // Unless the config asks for another.
  const std::string asked = folder
                                .Write("first/asked.yaml", ReadFile(first + "/records.yaml") +
                                                               "simulate: {flame_shape: arctan}\n")
                                .string();
  const std::string third = (folder.path() / "third").string();
  ASSERT_EQ(RunHowl("simulate " + asked + " --out " + third).status, 0);
  EXPECT_EQ(flame_of(third)["shape"], "arctan");
}

// The observed cycle does not attract when the other one's loop gain is far greater.
TEST(Section4, SaysWhereARecordHasLeftItsCycle) {
  const TemporaryFolder folder;
  std::string text = Section4("  {duration_s: 2, settle_s: 1}\n");
  text.replace(text.find("M_over_N: {initial: 0.7"), 23, "M_over_N: {initial: 1.3");
  const ProgramResult run = RunHowl("simulate " + folder.Write("far.yaml", text).string() +
                                    " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("which does not attract"));
  EXPECT_THAT(run.out, HasSubstr("exp1 has left its cycle: its strongest line is at 7"));
  const ProgramResult stays =
      RunHowl("simulate " + folder.Write("stays.yaml", Section4("  {duration_s: 2}\n")).string() +
              " --out " + folder.path().string());
  ASSERT_EQ(stays.status, 0) << stays.err;
  EXPECT_THAT(stays.out, testing::Not(HasSubstr("left its cycle")));
}

TEST(Section4, MistakesAreOneLine) {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder.path() / "out").string();
  for (const auto& [simulate, expected] : std::vector<std::pair<std::string, std::string>>{
           {"  start_frequency_hz: 400\n",
            ":11: simulate.start_frequency_hz: no cycle near 400.0 Hz"},
           {"  start: uper\n", ":11: simulate.start: "},
           {"  start: upper\n  start_frequency_hz: 750\n", "expected only one of the two"},
           {"  sweep: {parameter: M_over_N, from: 0.5, to: 0.5}\n",
            "simulate.sweep.to: is from, expected another value"},
           {"  sweep: {parameter: M_over_N, from: 0.5}\n", "simulate.sweep.to: "},
           {"  sweep: {parameter: m_over_n, from: 0.5, to: 1}\n", "M_over_N"},
           {"  sweep: {parameter: xi, from: 0, to: 1}\n", "simulate.sweep.from: "},
           {"  sweep: {parameter: xi, from: 0.1, to: 0.3, one_way_s: 1, steps: 50}\n",
            "simulate.sweep.steps: 50 windows of 1 s"}}) {
    const std::string config = folder.Write("bad.yaml", Section4(simulate)).string();
    const ProgramResult run = RunHowl("simulate " + config + out);
    EXPECT_EQ(run.status, 2) << simulate;
    EXPECT_THAT(run.err, HasSubstr(expected)) << simulate;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << simulate;
  }
  // One mode has no upper cycle, and no M.
  const std::string one_mode =
      "experiments:\n"
      "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,\n"
      "     flame_slope: -0.703e-4}\n"
      "simulate:\n  ";
  for (const auto& [simulate, expected] : std::vector<std::pair<std::string, std::string>>{
           {"start: upper\n", ":5: simulate.start: no cycle above the observed one attracts"},
           {"sweep: {parameter: M_over_N, from: 0.5, to: 1}\n", "belongs to the second mode"}}) {
    const std::string config = folder.Write("one.yaml", one_mode + simulate).string();
    const ProgramResult run = RunHowl("simulate " + config + out);
    EXPECT_EQ(run.status, 2) << simulate;
    EXPECT_THAT(run.err, HasSubstr(expected)) << simulate;
  }
}

TEST(Section4, ASweepDependsOnTheSeedAlone) {
  const TemporaryFolder folder;
  const std::string config =
      folder
          .Write("sweep.yaml", Section4("  {duration_s: 0.2, sweep: {parameter: tau_s, from: "
                                        "0.0034, to: 0.0036, one_way_s: 2, steps: 4}}\n"))
          .string();
  const auto sweep = [&](const std::string& flags) {
    EXPECT_EQ(
        RunHowl("simulate " + config + flags + " --quiet --out " + folder.path().string()).status,
        0);
    return ReadFile(folder.path() / "sweep.csv");
  };
  const std::string one = sweep(" --threads 1");
  EXPECT_EQ(sweep(" --threads 2"), one);
  EXPECT_NE(sweep(" --seed 2"), one);
}

}  // namespace
}  // namespace howl::simulate_test
