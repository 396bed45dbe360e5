#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "model/numerics/constants.h"
#include "tests/app/program.h"

namespace howl::fit_family_test {
namespace {

using Json = nlohmann::json;

Json ReadJson(const std::filesystem::path& path) { return Json::parse(ReadFile(path)); }

struct Row {
  int member;
  std::string experiment;
  double phi, omega_hz, xi, N, M, tau_s;
};

std::vector<Row> ReadFamily(const std::filesystem::path& path) {
  std::stringstream lines(ReadFile(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "member,experiment,phi,omega_hz,xi,N,M,tau_s,loop_gain,gain_error,phase_error_deg,"
            "loop_phase_error_deg");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::stringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    rows.push_back({std::stoi(cell[0]), cell[1], std::stod(cell[2]), std::stod(cell[3]),
                    std::stod(cell[4]), std::stod(cell[5]), std::stod(cell[6]),
                    std::stod(cell[7])});
  }
  return rows;
}

struct Measured {
  double frequency_hz, phase_deg, gain, flame_slope;
  bool reliable;
};

// The paper's tables 2 and 3.
const std::map<std::string, Measured>& Table() {
  static const std::map<std::string, Measured> table = {
      {"exp1", {219.9, -5.74, 12.14, -0.703e-4, true}},
      {"exp2", {209.1, -9.44, 13.15, -0.707e-4, true}},
      {"exp3", {205.7, -14.35, 14.79, -0.670e-4, true}},
      {"exp4", {202.7, -19.18, 16.05, -0.626e-4, true}},
      {"exp5", {198.4, -22.92, 18.80, -0.401e-4, false}},
      {"exp6", {179.8, -42.72, 45.01, -0.0872e-4, false}}};
  return table;
}

double AngleDeg(std::complex<double> z) { return std::arg(z) * 180.0 / kPi; }

// Every condition of design tolerances, from the paper's equations by std::complex alone.
void ExpectMembersFulfilThePapersEquations(const std::string& config, bool one_mode,
                                           double xi_max) {
  SCOPED_TRACE(config);
  const TemporaryFolder folder;
  const ProgramResult run =
      RunHowl("family " + Config(config) + " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<Row> rows = ReadFamily(folder.path() / "family.csv");
  std::map<int, std::vector<Row>> members;
  for (const Row& row : rows) members[row.member].push_back(row);
  EXPECT_EQ(members.size(), 1000u);
  for (auto& [number, models] : members) {
    ASSERT_EQ(models.size(), Table().size());
    std::ranges::sort(models, {}, &Row::phi);
    double omega_min = 1e300;
    double omega_max = 0.0;
    double last_xi = 0.0;
    for (const Row& row : models) {
      const Measured& measured = Table().at(row.experiment);
      const std::complex<double> s(0.0, 2.0 * kPi * measured.frequency_hz);
      const double w = 2.0 * kPi * row.omega_hz;
      const std::complex<double> G =
          row.N * s / (s * s + 2.0 * w * row.xi * s + w * w) +
          row.M * s / (s * s + 2.0 * (3.0 * w) * row.xi * s + 9.0 * w * w);
      EXPECT_NEAR(std::abs(G) / measured.gain, 1.0, 0.01 + 1e-9);
      EXPECT_LE(std::abs(AngleDeg(G * std::polar(1.0, -measured.phase_deg * kPi / 180.0))),
                0.5 + 1e-9);
      const std::complex<double> L = s * G * std::exp(-row.tau_s * s);
      EXPECT_LE(std::abs(AngleDeg(-L)), 1.0 + 1e-9);
      if (measured.reliable) {
        EXPECT_GE(std::abs(L * measured.flame_slope), 1.0 - 1e-9);
      }
      EXPECT_GT(row.xi, 0.0);
      EXPECT_LE(row.xi, xi_max);
      EXPECT_GE(row.xi, last_xi);
      last_xi = row.xi;
      // p lags q at every operating point, so that omega lies below the limit cycle's frequency.
      if (one_mode) {
        EXPECT_LT(row.omega_hz, measured.frequency_hz);
      }
      omega_min = std::min(omega_min, row.omega_hz);
      omega_max = std::max(omega_max, row.omega_hz);
    }
    EXPECT_LE(omega_max / omega_min - 1.0, 0.25 + 1e-9);
  }
}

TEST(Family, OneModeMembersFulfilThePapersEquations) {
  ExpectMembersFulfilThePapersEquations("r228", true, 0.3);
}

TEST(LongFamily, TwoModeMembersFulfilThePapersEquations) {
  ExpectMembersFulfilThePapersEquations("r228_two_modes", false, 0.4);
}

std::string R228WithTest(const std::string& from, const std::string& to) {
  std::string text = ReadFile(Config("r228"));
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST(Family, EmptyFamilyNamesTheConditionsThatExcludeEachOther) {
  const TemporaryFolder folder;
  const auto config =
      folder.Write("tight.yaml", R228WithTest("omega_spread_max: 0.25", "omega_spread_max: 0.15"));
  const ProgramResult run =
      RunHowl("family " + config.string() + " --out " + folder.path().string());
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, testing::HasSubstr("empty"));
  const Json json = ReadJson(folder.path() / "family.json");
  EXPECT_THAT(json["empty_because"].get<std::vector<std::string>>(),
              testing::UnorderedElementsAre("phase_tolerance_deg", "omega_spread_max", "xi_max"));
  EXPECT_EQ(json["counts"]["members"], 0);
  EXPECT_EQ(ReadFamily(folder.path() / "family.csv").size(), 0u);
}

TEST(Fit, WritesTheSolutionOfThePublishedTable) {
  const TemporaryFolder folder;
  const ProgramResult run = RunHowl("fit " + Config("r228") + " --out " + folder.path().string());
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = ReadJson(folder.path() / "solution.json");
  EXPECT_EQ(json["schema"], "howl.solution/1");
  ASSERT_EQ(json["experiments"].size(), 6u);
  // notes to the paper, items 2 and 4; the joint fit may trade a tenth of a degree for a tau that
  // varies less.
  const std::vector<double> tau_ms = {3.338, 3.461, 3.452, 3.437, 3.459, 3.511};
  const std::vector<double> loop_gain = {1.179, 1.221, 1.281, 1.280, 0.940, 0.443};
  for (std::size_t i = 0; i < 6; ++i) {
    const Json& experiment = json["experiments"][i];
    EXPECT_NEAR(1e3 * experiment["tau_s"].get<double>(), tau_ms[i], 0.003);
    EXPECT_NEAR(experiment["loop_gain"].get<double>(), loop_gain[i], 0.001);
    EXPECT_LT(experiment["omega_hz"], experiment["frequency_hz"]);
  }
  // notes to the paper, item 5: a straight line through the loop gains of experiments 1 to 4
  // reaches one at 0.675 (the paper reads about 0.64 off its figure).
  const Json& vanishing = json["vanishing_phi"];
  EXPECT_NEAR(vanishing["value"].get<double>(), 0.675, 0.0005);
  EXPECT_LT(vanishing["lo"], vanishing["value"]);
  EXPECT_TRUE(vanishing["hi"].is_null() || vanishing["hi"] > vanishing["value"]);
}

TEST(Fit, AnswerDoesNotDependOnThreads) {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "2"}) {
    for (const std::string command : {"fit ", "family "}) {
      ASSERT_EQ(RunHowl(command + Config("r228") + " --threads " + threads + " --out " +
                        (folder.path() / threads).string())
                    .status,
                0);
    }
  }
  for (const char* file : {"solution.json", "family.csv", "family.json", "tradeoff.csv"}) {
    EXPECT_EQ(ReadFile(folder.path() / "1" / file), ReadFile(folder.path() / "2" / file)) << file;
  }
}

TEST(List, FiltersAndSorts) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  ASSERT_EQ(RunHowl("family " + Config("r228") + out).status, 0);
  const ProgramResult run =
      RunHowl("list " + Config("r228") + out +
              " --filter 'xi_max<0.2,exp1.omega_hz>=216' --sort -exp1.xi --rows 0 --columns "
              "member,exp1.xi,exp1.omega_hz");
  ASSERT_EQ(run.status, 0) << run.err;
  std::stringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  double last = 1e300;
  int rows = 0;
  for (double member = 0, xi = 0, omega_hz = 0; lines >> member >> xi >> omega_hz; ++rows) {
    EXPECT_LE(xi, last);
    EXPECT_LT(xi, 0.2);
    EXPECT_GE(omega_hz, 216.0);
    last = xi;
  }
  EXPECT_GT(rows, 10);
  EXPECT_LT(rows, 1000);
}

TEST(List, WrongColumnIsOneLineAndStatusTwo) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  ASSERT_EQ(RunHowl("family " + Config("r228_reliable") + out).status, 0);
  for (const std::string option : {"--sort exp9.xi", "--filter 'xi_max=3'", "--filter 'xi_max<x'",
                                   "--columns nonsense", "--rows -1", "--rows many"}) {
    const ProgramResult run = RunHowl("list " + Config("r228_reliable") + out + " " + option);
    EXPECT_EQ(run.status, 2) << option;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_THAT(run.err, testing::HasSubstr("expected")) << option;
  }
}

}  // namespace
}  // namespace howl::fit_family_test
