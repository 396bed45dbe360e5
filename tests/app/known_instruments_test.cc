// Known instruments through the program: one rig recorded by ideal instruments, and by a low-pass
// on q and a resonance on p whose channels are skewed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <random>
#include <sstream>
#include <vector>

#include "tests/app/program.h"

namespace howl::known_instruments_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Complex = std::complex<double>;

constexpr double kSamplingHz = 5000.0;
constexpr int kSamples = 20000;
constexpr double kDelay = 0.0004;
constexpr double kFrequencyHz = 211.0;
constexpr double kPhaseDeg = -10.0;
constexpr double kGain = 13.0;

Complex S(double frequency_hz) { return {0.0, 2.0 * M_PI * frequency_hz}; }
Complex OnPressure(double f) {
  const Complex u = S(f) / (2.0 * M_PI * 600.0);
  return 1.0 / (1.0 + 0.1 * u + u * u);
}
Complex OnHeatRelease(double f) {
  return std::exp(-S(f) * kDelay) / (1.0 + S(f) / (2.0 * M_PI * 120.0));
}

// A cycle with its second harmonic, through the instruments in closed form or not, in the noise of
// the recorder.
std::string Csv(bool ideal, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto of = [&](double f) { return ideal ? Complex(1.0) : OnPressure(f); };
  const auto through = [&](double f) { return ideal ? Complex(1.0) : OnHeatRelease(f); };
  const Complex p1 = of(kFrequencyHz), p2 = 0.1 * of(2.0 * kFrequencyHz);
  const Complex q1 = through(kFrequencyHz) * std::polar(1.0 / kGain, -kPhaseDeg * M_PI / 180.0);
  const Complex q2 = 0.1 / kGain * through(2.0 * kFrequencyHz);
  std::string text = "p,q\n";
  char line[80];
  for (int i = 0; i < kSamples; ++i) {
    const Complex turn = std::polar(1.0, 2.0 * M_PI * kFrequencyHz * i / kSamplingHz);
    std::snprintf(line, sizeof(line), "%.12g,%.12g\n",
                  (p1 * turn + p2 * turn * turn).real() + 0.01 * normal(random),
                  (q1 * turn + q2 * turn * turn).real() + 0.01 / kGain * normal(random));
    text += line;
  }
  return text;
}

const std::string kKnown =
    ", pressure_response: \"1 / (1 + 0.1 s / (2 pi 600) + (s / (2 pi 600))^2)\""
    ", heat_release_response: \"1 / (1 + s / (2 pi 120))\", delay_s: 0.0004";

std::string ConfigText(const std::string& file, const std::string& more) {
  return "experiments:\n  - {name: exp1, phi: 0.56, record: {file: " + file +
         ", heat_release: q, sampling_hz: 5000" + more + "}}\n";
}

// The columns of the one row.
std::map<std::string, double> Characteristics(const TemporaryFolder& folder,
                                              const std::string& config) {
  const ProgramResult run = RunHowl("analyse " + folder.Write("c.yaml", config).string() +
                                    " --out " + folder.path().string());
  EXPECT_EQ(run.status, 0) << run.err;
  std::istringstream lines(ReadFile(folder.path() / "characteristics.csv"));
  std::string names, values;
  std::getline(lines, names);
  std::getline(lines, values);
  std::istringstream name_cells(names), value_cells(values);
  std::map<std::string, double> row;
  for (std::string name, value; std::getline(name_cells, name, ',');) {
    std::getline(value_cells, value, ',');
    row[name] = std::strtod(value.c_str(), nullptr);
  }
  return row;
}

TEST(KnownInstruments, AnalyseGivesWhatIdealInstrumentsGive) {
  double phase_bias = 0.0, gain_bias = 0.0;
  constexpr int kSeeds = 4;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const TemporaryFolder folder;
    folder.Write("ideal.csv", Csv(true, seed));
    folder.Write("made.csv", Csv(false, seed));
    auto ideal = Characteristics(folder, ConfigText("ideal.csv", ""));
    auto raw = Characteristics(folder, ConfigText("made.csv", ""));
    auto given = Characteristics(folder, ConfigText("made.csv", kKnown));
    const auto differs = [&](auto& a, const std::string& name, const std::string& std_name) {
      return std::abs(a[name] - ideal[name]) / std::hypot(a[std_name], ideal[std_name]);
    };
    EXPECT_GT(differs(raw, "phase_deg", "phase_std_deg"), 20.0);
    EXPECT_GT(differs(raw, "gain", "gain_std"), 20.0);
    EXPECT_LT(differs(given, "phase_deg", "phase_std_deg"), 1.96);
    EXPECT_LT(differs(given, "gain", "gain_std"), 1.96);
    EXPECT_NEAR(given["phase_deg"], kPhaseDeg, 4.0 * given["phase_std_deg"]);
    EXPECT_NEAR(given["gain"], kGain, 4.0 * given["gain_std"]);
    EXPECT_NEAR(given["tau_s"], (270.0 + kPhaseDeg) / (360.0 * kFrequencyHz), 2e-6);
    EXPECT_GT(std::abs(raw["tau_s"] - ideal["tau_s"]), 1e-4);
    phase_bias += (given["phase_deg"] - kPhaseDeg) / kSeeds;
    gain_bias += (given["gain"] / kGain - 1.0) / kSeeds;
  }
  EXPECT_NEAR(phase_bias, 0.0, 0.1);
  EXPECT_NEAR(gain_bias, 0.0, 1e-3);
}

TEST(KnownInstruments, EveryCommandReadsTheRecordWithoutThem) {
  const TemporaryFolder folder;
  folder.Write("ideal.csv", Csv(true, 9));
  folder.Write("made.csv", Csv(false, 9));
  const auto gain = [&](const std::string& config) {
    const std::string out = " --out " + folder.path().string();
    RunHowl("fit " + folder.Write("c.yaml", config).string() + out);
    const std::string solution = ReadFile(folder.path() / "solution.json");
    const std::size_t at = solution.find("\"gain\":");
    EXPECT_NE(at, std::string::npos);
    return at == std::string::npos ? 0.0 : std::strtod(solution.c_str() + at + 7, nullptr);
  };
  const double ideal = gain(ConfigText("ideal.csv", ""));
  EXPECT_GT(std::abs(gain(ConfigText("made.csv", "")) / ideal - 1.0), 0.3);
  EXPECT_NEAR(gain(ConfigText("made.csv", kKnown)) / ideal, 1.0, 0.01);
}

TEST(KnownInstruments, AnalyseSaysWhatATableHoldsAndWhereTheDivisionIsLimited) {
  const TemporaryFolder folder;
  folder.Write("made.csv", Csv(true, 9));
  folder.Write("lens.csv", "frequency_hz,magnitude,phase_deg\n10,1,0\n100,1,0\n200,1e-3,0\n");
  const auto printed = [&](const std::string& more) {
    const ProgramResult run =
        RunHowl("analyse " + folder.Write("c.yaml", ConfigText("made.csv", more)).string() +
                " --out " + (folder.path() / "out").string());
    EXPECT_EQ(run.status, 0) << run.err;
    std::string text = run.out;
    for (std::size_t at = text.find("\n  "); at != std::string::npos; at = text.find("\n  ")) {
      text.replace(at, 3, " ");
    }
    return text;
  };
  const std::string limited = printed(", heat_release_response: lens.csv");
  EXPECT_THAT(limited,
              HasSubstr("exp1: heat_release_response is a table from 10 to 200 Hz: beyond, "
                        "from 0 to 2500 Hz, its ends are held"));
  EXPECT_THAT(limited, HasSubstr("|heat_release_response| is 0.001 of its largest: the division is "
                                 "limited below 0.01, and heat_release comes back 10 times too "
                                 "small"));
  EXPECT_THAT(printed(kKnown), Not(HasSubstr("_response")));
}

// What simulate writes is recorded by ideal instruments.
TEST(KnownInstruments, SimulateCarriesNoneOver) {
  const TemporaryFolder folder;
  folder.Write("made.csv", Csv(false, 9));
  const std::string config =
      folder.Write("c.yaml", ConfigText("made.csv", kKnown) + "simulate: {duration_s: 1}\n")
          .string();
  const ProgramResult run =
      RunHowl("simulate " + config + " --out " + (folder.path() / "out").string());
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string records = ReadFile(folder.path() / "out" / "records.yaml");
  EXPECT_THAT(records, HasSubstr("exp1.csv"));
  EXPECT_THAT(records, Not(HasSubstr("response")));
  EXPECT_THAT(records, Not(HasSubstr("delay_s")));
}

TEST(KnownInstruments, AMistakeIsOneLineAndStatusTwo) {
  const TemporaryFolder folder;
  folder.Write("made.csv", Csv(false, 9));
  folder.Write("lens.csv", "frequency_hz,magnitude,phase_deg\n100,1,0\n50,0.9,-20\n");
  const std::map<std::string, std::string> cases = {
      {", pressure_response: \"1 / (1 + x)\"",
       "c.yaml:2: experiments[0].record.pressure_response: "},
      {", pressure_response: absent.csv", "c.yaml:2: experiments[0].record.pressure_response: "},
      {", pressure_respons: 1", "c.yaml:2: experiments[0].record.pressure_respons: "},
      {", heat_release_response: lens.csv", "lens.csv:3: frequency_hz: 50, expected"}};
  for (const auto& [more, message] : cases) {
    const ProgramResult run =
        RunHowl("analyse " + folder.Write("c.yaml", ConfigText("made.csv", more)).string() +
                " --out " + (folder.path() / "out").string());
    EXPECT_EQ(run.status, 2) << more;
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "characteristics.csv"));
  }
}

}  // namespace
}  // namespace howl::known_instruments_test
