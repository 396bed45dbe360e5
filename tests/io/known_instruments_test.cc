// What a config says of a record's instruments: taken out of the record where it is read, and each
// mistake one line with its file, line and key.
#include <complex>
#include <functional>

#include "io/config/reading/config_reading.h"
#include "io/records/response_table.h"
#include "tests/io/config_file.h"
#include "tests/io/record_files.h"

namespace howl::known_instruments_test {
namespace {

using testing::HasSubstr;

constexpr double kSamplingHz = 5000.0;
constexpr double kFrequencyHz = 211.37;
constexpr int kSamples = 20000;

std::complex<double> LowPass(double frequency_hz) {
  return 1.0 / (1.0 + std::complex<double>(0.0, frequency_hz / 120.0));
}

// p is a cosine of one, and q the same through the low-pass.
std::string Csv() {
  std::string text = "p,q\n";
  char line[80];
  for (int i = 0; i < kSamples; ++i) {
    const std::complex<double> turn = std::polar(1.0, 2.0 * M_PI * kFrequencyHz * i / kSamplingHz);
    std::snprintf(line, sizeof(line), "%.15g,%.15g\n", turn.real(),
                  (LowPass(kFrequencyHz) * turn).real());
    text += line;
  }
  return text;
}

std::string Table(const std::function<std::string(int, std::string)>& change = nullptr) {
  std::string text = "frequency_hz,magnitude,phase_deg\n";
  int number = 1;
  char line[120];
  for (double f = 0.0; f < 2510.0; f += 2.5) {
    const std::complex<double> h = LowPass(f);
    std::snprintf(line, sizeof(line), "%g,%.15g,%.15g", f, std::abs(h), std::arg(h) * 180.0 / M_PI);
    ++number;
    text += (change ? change(number, line) : line) + "\n";
  }
  return text;
}

std::string ConfigText(const std::string& more) {
  return "experiments:\n"
         "  - name: exp1\n"
         "    phi: 0.56\n"
         "    record:\n"
         "      file: data.csv\n"
         "      heat_release: q\n"
         "      sampling_hz: 5000\n" +
         more;
}

// The line of a mistake in the config or in what it names, the folder's name taken off.
std::string MistakeOf(const ConfigFile& file) {
  std::string text = "no mistake";
  try {
    const Config config = LoadConfig(file.Path());
    const ExperimentConfig& each = config.experiments.front();
    LoadRecord(*each.record, config.source.string(), each.record_line);
  } catch (const UserError& error) {
    text = error.what();
  }
  const std::string folder = file.Folder().string() + "/";
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
    text.erase(at, folder.size());
  }
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text;
}

std::string Mistake(const std::string& more, const std::string& table = Table()) {
  const ConfigFile file(ConfigText(more));
  file.Write("data.csv", Csv());
  file.Write("lens.csv", table);
  return MistakeOf(file);
}

Record Loaded(const std::string& more) {
  const ConfigFile file(ConfigText(more));
  file.Write("data.csv", Csv());
  file.Write("lens.csv", Table());
  const Config config = LoadConfig(file.Path());
  return LoadRecord(*config.experiments.front().record, config.source.string(), 5);
}

TEST(KnownInstruments, FormulaAndTableGiveTheTrueSignalBack) {
  for (const std::string response : {"\"1 / (1 + s / (2 pi 120))\"", "lens.csv"}) {
    const Record record = Loaded("      heat_release_response: " + response + "\n");
    ASSERT_EQ(record.pressure.size(), record.heat_release.size());
    ASSERT_GT(record.pressure.size(), 0.95 * kSamples);
    // Between rows 2.5 Hz apart the table is a straight line.
    const double tolerance = response == "lens.csv" ? 1e-4 : 1e-6;
    for (std::size_t i = 0; i < record.pressure.size(); ++i) {
      ASSERT_NEAR(record.heat_release[i], record.pressure[i], tolerance) << response << " " << i;
    }
  }
}

TEST(KnownInstruments, ANumberIsAResponseToo) {
  const Record plain = Loaded("");
  const Record halved = Loaded("      pressure_response: 2\n");
  const std::size_t dropped = (plain.pressure.size() - halved.pressure.size()) / 2;
  for (std::size_t i = 0; i < halved.pressure.size(); ++i) {
    ASSERT_NEAR(halved.pressure[i], plain.pressure[i + dropped] / 2.0, 1e-4) << i;
    ASSERT_EQ(halved.heat_release[i], plain.heat_release[i + dropped]) << i;
  }
}

TEST(KnownInstruments, ALeakOfPressureIsTakenOutBeforeTheResponse) {
  const Record plain = Loaded("");
  const Record record =
      Loaded("      pressure_in_heat_release: 0.25\n      heat_release_response: 2\n");
  const std::size_t dropped = (plain.pressure.size() - record.pressure.size()) / 2;
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    const double p = plain.pressure[i + dropped];
    ASSERT_EQ(record.pressure[i], p) << i;
    ASSERT_NEAR(record.heat_release[i], (plain.heat_release[i + dropped] - 0.25 * p) / 2.0, 1e-4)
        << i;
  }
}

TEST(KnownInstruments, WithoutTheKeysNoBitChanges) {
  const Record plain = Loaded("");
  const Record zero = Loaded("      delay_s: 0\n");
  ASSERT_EQ(plain.pressure.size(), static_cast<std::size_t>(kSamples));
  EXPECT_EQ(zero.pressure, plain.pressure);
  EXPECT_EQ(zero.heat_release, plain.heat_release);
}

TEST(KnownInstrumentsMistakes, OfTheConfigNameFileLineAndKey) {
  const std::string at = "experiments[0].record.";
  EXPECT_THAT(Mistake("      pressure_response: 1 / (1 + x)\n"),
              HasSubstr("config.yaml:8: " + at +
                        "pressure_response: at character 10: unknown name x, expected s, f_hz, j"));
  EXPECT_THAT(Mistake("      heat_release_response: 1 / (1 + s\n"),
              HasSubstr("config.yaml:8: " + at + "heat_release_response: at character 11: "));
  EXPECT_THAT(Mistake("      heat_release_response: s / 2 pi\n"),
              HasSubstr("can be read in two ways, expected * or ( )"));
  EXPECT_THAT(Mistake("      pressure_response: absent.csv\n"),
              HasSubstr("config.yaml:8: " + at + "pressure_response: there is no file"));
  EXPECT_THAT(Mistake("      pressure_respons: 1\n"),
              HasSubstr("config.yaml:8: " + at + "pressure_respons: is not a known key"));
  EXPECT_THAT(Mistake("      delay_ms: 1\n"),
              HasSubstr("config.yaml:8: " + at + "delay_ms: is not a known key"));
  EXPECT_THAT(Mistake("      delay_s: soon\n"), HasSubstr("config.yaml:8: " + at + "delay_s: "));
  EXPECT_THAT(Mistake("      delay_s: 0.5\n"),
              HasSubstr("config.yaml:8: delay_s: 0.5 s, expected at most a fiftieth of the "
                        "record's 4 s"));
  EXPECT_THAT(Mistake("      pressure_response: 1 / (s - s)\n"),
              HasSubstr("config.yaml:8: pressure_response: has no finite value at "));
  EXPECT_THAT(Mistake("      heat_release_response: 0 s\n"),
              HasSubstr("config.yaml:8: heat_release_response: is zero at every frequency"));
  EXPECT_THAT(Mistake("      pressure_response: 1e-29\n      pressure_scale: 1e10\n"),
              HasSubstr("config.yaml:8: pressure_response: leaves a signal from "));
  EXPECT_THAT(Mistake("      pressure_in_heat_release: 1e30\n      pressure_scale: 100\n"),
              HasSubstr("config.yaml:8: pressure_in_heat_release: leaves a signal from "));
  EXPECT_THAT(Mistake("      pressure_in_heat_release: some\n"),
              HasSubstr("config.yaml:8: " + at + "pressure_in_heat_release: "));
}

TEST(KnownInstrumentsMistakes, OfATableNameItsFileLineAndColumn) {
  const std::string key = "      heat_release_response: lens.csv\n";
  const auto with = [&](int line, const std::string& text) {
    return Mistake(key,
                   Table([&](int at, const std::string& was) { return at == line ? text : was; }));
  };
  EXPECT_EQ(Mistake(key), "no mistake");
  EXPECT_EQ(with(7, "nan,0.99,-5"),
            "lens.csv:7: frequency_hz: nan, expected a finite number, 0 or of magnitude from 1e-30 "
            "to 1e30");
  EXPECT_THAT(with(7, "12.5,nan,-5"), HasSubstr("lens.csv:7: magnitude: nan, expected"));
  EXPECT_THAT(with(7, "12.5,0.99,inf"), HasSubstr("lens.csv:7: phase_deg: inf, expected"));
  EXPECT_EQ(with(7, "10,0.99,-5"),
            "lens.csv:7: frequency_hz: 10, expected frequencies that increase: more than the 10 "
            "before it");
  EXPECT_EQ(with(2, "-1,1,0"),
            "lens.csv:2: frequency_hz: -1, expected a frequency of 0 Hz or more");
  EXPECT_EQ(with(7, "12.5,0,-5"), "lens.csv:7: magnitude: 0, expected a magnitude above 0");
  EXPECT_THAT(with(7, "12.5,x,-5"), HasSubstr("lens.csv:7: magnitude: "));
  EXPECT_THAT(Mistake(key, "frequency_hz,magnitude\n1,1\n2,1\n"),
              HasSubstr("lens.csv:1: phase_deg: no such column"));
  EXPECT_THAT(Mistake(key, "frequency_hz,magnitude,phase_deg\n1,1,0\n"),
              HasSubstr("lens.csv:2: 1 rows, expected at least 2"));
  EXPECT_THAT(Mistake(key, ""), HasSubstr("lens.csv:1: an empty file"));
}

TEST(KnownInstrumentsMistakes, OfHeatReleaseWithoutItsColumn) {
  for (const char* const key : {"heat_release_response", "delay_s", "pressure_in_heat_release"}) {
    const ConfigFile file(
        "experiments:\n  - name: exp1\n    phi: 0.56\n    record:\n"
        "      file: data.csv\n      sampling_hz: 5000\n      " +
        std::string(key) + ": 0.001\n");
    file.Write("data.csv", Csv());
    EXPECT_EQ(MistakeOf(file),
              "config.yaml:7: experiments[0].record." + std::string(key) +
                  ": has no heat_release to act on, expected the column of it too");
  }
}

}  // namespace
}  // namespace howl::known_instruments_test
