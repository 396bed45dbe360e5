// Looking into records of which nothing is known: columns, time and its unit, p and q.
#include <cstdlib>
#include <numbers>

#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/inspect/column_words.h"
#include "io/inspect/init_config.h"
#include "io/inspect/record_look.h"
#include "io/inspect/role_guess.h"
#include "io/records/columns/number_text.h"
#include "tests/io/record_files.h"

namespace howl::inspect_test {
namespace {

TEST(Inspect, NamesOfColumns) {
  const std::pair<const char*, ColumnMeaning> names[] = {
      {"t", ColumnMeaning::kTime},
      {"Time (ms)", ColumnMeaning::kTime},
      {"time_s", ColumnMeaning::kTime},
      {"p", ColumnMeaning::kPressure},
      {"P1 [Pa]", ColumnMeaning::kPressure},
      {"p_pa", ColumnMeaning::kPressure},
      {"pressureInlet", ColumnMeaning::kPressure},
      {"Dynamic Pressure", ColumnMeaning::kPressure},
      {"ai3 (mbar)", ColumnMeaning::kPressure},
      {"p'", ColumnMeaning::kPressure},
      {"q_kw", ColumnMeaning::kHeatRelease},
      {"heat release", ColumnMeaning::kHeatRelease},
      {"HRR", ColumnMeaning::kHeatRelease},
      {"OH*", ColumnMeaning::kHeatRelease},
      {"CH* intensity [V]", ColumnMeaning::kHeatRelease},
      {"PMT (V)", ColumnMeaning::kHeatRelease},
      {"T_air [K]", ColumnMeaning::kTime},  // by its name alone; its values say it is none
      {"temperature", ColumnMeaning::kOther},
      // Numbered channels say nothing.
      {"CH1", ColumnMeaning::kNone},
      {"ch 2", ColumnMeaning::kNone},
      {"Untitled 1", ColumnMeaning::kNone},
      {"dev1/ai0", ColumnMeaning::kNone},
      {"Voltage_0 (V)", ColumnMeaning::kNone},
      {"", ColumnMeaning::kNone}};
  for (const auto& [name, meaning] : names) EXPECT_EQ(MeaningOf(name).meaning, meaning) << name;
}

struct Columns {
  std::string head;
  double step = 1e-4;  // of the first column
  double start = 0.0;
  bool swapped = false;  // q before p
};

// p swings about zero and q about 2, both at 200 Hz if the steps are of 0.1 ms.
std::string Text(const Columns& columns) {
  std::string text = columns.head;
  for (int i = 0; i < 4000; ++i) {
    const double phase = 2.0 * std::numbers::pi * 0.02 * i;
    const std::string p = NumberText(std::sin(phase) + 0.01 * std::sin(7.7 * i));
    const std::string q = NumberText(2.0 + 0.5 * std::sin(phase + 0.8) + 0.01 * std::sin(3.3 * i));
    text += NumberText(columns.start + columns.step * i, 12) + " " +
            (columns.swapped ? q + " " + p : p + " " + q) + "\n";
  }
  return text;
}

RoleGuess Roles(const RecordLook& look) {
  const RecordLook* const one = &look;
  return GuessRoles(std::span(&one, 1));
}

TEST(Inspect, WithoutAHeaderByValues) {
  const TemporaryFolder folder;
  for (const bool swapped : {false, true}) {
    const RecordLook look =
        LookAtRecord(folder.Write("a.txt", Text({.head = "", .start = 3.5e9, .swapped = swapped})));
    EXPECT_EQ(look.time.column, 0U);
    EXPECT_EQ(look.time.unit_s, 1.0);
    EXPECT_EQ(look.time.sampling_hz, 10000.0);
    const RoleGuess roles = Roles(look);
    EXPECT_EQ(roles.pressure, swapped ? 2U : 1U);
    EXPECT_EQ(roles.heat_release, swapped ? 1U : 2U);
    EXPECT_TRUE(roles.is_sure);
    EXPECT_THAT(roles.heat_release_reason, testing::HasSubstr("keeps a mean"));
  }
}

TEST(Inspect, TheUnitOfTimeByTheRateThatItGives) {
  const TemporaryFolder folder;
  const auto unit = [&](const Columns& columns) {
    return LookAtRecord(folder.Write("a.txt", Text(columns))).time;
  };
  EXPECT_EQ(unit({.head = "", .step = 1e-4}).unit_s, 1.0);
  EXPECT_EQ(unit({.head = "", .step = 0.1}).unit_s, 1e-3);
  EXPECT_EQ(unit({.head = "", .step = 50.0}).unit_s, 1e-6);
  // The name is asked first: 5 kHz in a header that says us, though ms would be usual too.
  const TimeGuess named = unit({.head = "t[us] p q\n", .step = 200.0});
  EXPECT_EQ(named.unit_s, 1e-6);
  EXPECT_TRUE(named.unit_is_named);
  EXPECT_EQ(named.sampling_hz, 5000.0);
  // A count of samples is no time.
  EXPECT_FALSE(unit({.head = "", .step = 1.0}).column);
}

TEST(Inspect, NamesComeBeforeValues) {
  const TemporaryFolder folder;
  // The header calls the column that keeps a mean pressure.
  const RecordLook look =
      LookAtRecord(folder.Write("a.txt", Text({.head = "time PMT Pressure\n"})));
  const RoleGuess roles = Roles(look);
  EXPECT_EQ(roles.pressure, 2U);
  EXPECT_EQ(roles.heat_release, 1U);
  EXPECT_THAT(roles.pressure_reason, testing::HasSubstr("\"Pressure\""));
}

TEST(Inspect, SaysWhereNothingTellsPFromQ) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    text += NumberText(std::sin(0.3 * i)) + "," + NumberText(std::cos(0.3 * i)) + "\n";
  }
  const RecordLook look = LookAtRecord(folder.Write("a.csv", text));
  const RoleGuess roles = Roles(look);
  EXPECT_EQ(roles.pressure, 0U);
  EXPECT_EQ(roles.heat_release, 1U);
  EXPECT_FALSE(roles.is_sure);
  EXPECT_THAT(roles.pressure_reason, testing::StartsWith("NOT SURE"));
  EXPECT_FALSE(look.time.sampling_hz);
}

TEST(Inspect, AMatFileSaysItsRateInAVariable) {
  const TemporaryFolder folder;
  mat_t* const mat = Mat_CreateVer((folder / "a.mat").c_str(), nullptr, MAT_FT_MAT5);
  std::vector<double> p, q;
  for (int i = 0; i < 500; ++i) {
    p.push_back(std::sin(0.3 * i));
    q.push_back(2.0 + std::cos(0.3 * i));
  }
  AddMatVariable(mat, "PMT", 1, 500, q);
  AddMatVariable(mat, "Fs", 1, 1, {5000.0});
  AddMatVariable(mat, "P_pa", 500, 1, p);
  Mat_Close(mat);
  const std::vector<RecordLook> looks = {LookAtRecord(folder / "a.mat")};
  const InitConfig config = WriteInitConfig(looks, {});
  EXPECT_THAT(config.text,
              testing::HasSubstr("pressure: P_pa, heat_release: PMT, sampling_hz: 5000}"));
}

TEST(Inspect, TheConfigIsReadBackAsItWasMeant) {
  const TemporaryFolder folder;
  std::string decimal = Text({.head = "", .step = 0.1});
  std::ranges::replace(decimal, '.', ',');
  std::filesystem::create_directory(folder / "b");
  const std::vector<RecordLook> looks = {
      LookAtRecord(folder.Write("1.txt", decimal)),
      LookAtRecord(folder.Write("b/1.txt", "made by hand: 2015\n" + Text({.head = "t p' q'\n"}))),
      LookAtRecord(folder.Write("lines.txt", Text({.head = ""})))};
  InitOptions options{.folder = folder.path(), .operating_parameter = "air_slpm"};
  EXPECT_EQ(WriteInitConfig(looks, options).left_open, 3U);
  options.values = {"400", "450.5", "500"};
  const InitConfig written = WriteInitConfig(looks, options);
  EXPECT_EQ(written.left_open, 0U);
  const Config config = LoadConfig(folder.Write("rig.yaml", written.text));
  ASSERT_EQ(config.experiments.size(), 3U);
  EXPECT_EQ(config.operating_parameter, "air_slpm");
  EXPECT_EQ(config.experiments[1].experiment.phi, 450.5);
  EXPECT_EQ(config.experiments[1].experiment.name, "b_1");
  EXPECT_EQ(config.experiments[2].experiment.name, "record_lines");  // lines.csv is a result
  const RecordSpec& first = *config.experiments[0].record;
  EXPECT_TRUE(first.dialect.decimal_comma);
  EXPECT_EQ(first.time_unit_s, 1e-3);
  EXPECT_EQ(config.experiments[1].record->dialect.skip_rows, 1);
  EXPECT_EQ(config.experiments[1].record->pressure, "p'");
  for (const ExperimentConfig& each : config.experiments) {
    EXPECT_EQ(LoadRecord(*each.record, "rig.yaml", each.record_line).sampling_hz, 10000.0);
  }
}

TEST(Inspect, ColumnsMayHaveNamesThatYamlTakesForSomethingElse) {
  const TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 60; ++i) rows += std::to_string(i % 7) + "," + std::to_string(i % 5) + "\n";
  for (const std::string name : {"null", "true", "~", "a: b", "#p", "- p", "1,2"}) {
    const std::vector<RecordLook> looks = {
        LookAtRecord(folder.Write("r.csv", "\"" + name + "\",q\n" + rows))};
    const InitConfig written =
        WriteInitConfig(looks, {.folder = folder.path(), .values = {"1"}, .sampling_hz = 5000.0});
    const Config config = LoadConfig(folder.Write("rig.yaml", written.text));
    EXPECT_EQ(config.experiments[0].record->pressure, name) << written.text;
  }
}

TEST(Inspect, MeasuredRecordsComeOutRight) {
  const char* const data = std::getenv("HOWL_DATA");
  if (data == nullptr) GTEST_SKIP() << "HOWL_DATA is not set";
  const std::filesystem::path combustor = std::filesystem::path(data) / "turbulent_combustor";
  const std::filesystem::path rijke = std::filesystem::path(data) / "rijke_tube";
  std::vector<RecordLook> looks;
  for (const auto& entry : std::filesystem::directory_iterator(combustor)) {
    if (entry.path().extension() == ".gz") looks.push_back(LookAtRecord(entry.path()));
  }
  ASSERT_EQ(looks.size(), 13U);
  for (const RecordLook& look : looks) {  // each by itself, from noise to a strong cycle
    const RoleGuess roles = Roles(look);
    EXPECT_EQ(look.time.column, 0U) << look.file;
    EXPECT_EQ(look.time.unit_s, 1.0) << look.file;
    EXPECT_EQ(look.time.sampling_hz, 10000.0) << look.file;
    EXPECT_EQ(roles.heat_release, 1U) << look.file;
    EXPECT_EQ(roles.pressure, 2U) << look.file;
    EXPECT_TRUE(roles.is_sure) << look.file;
  }
  for (const char* name : {"quasi_static/2.txt.gz", "quasi_static/19.txt.gz", "ramps/14.txt.gz"}) {
    const RecordLook look = LookAtRecord(rijke / name);
    const RoleGuess roles = Roles(look);
    EXPECT_EQ(look.time.sampling_hz, 10000.0) << name;
    EXPECT_EQ(roles.pressure, 1U) << name;
    EXPECT_FALSE(roles.heat_release) << name;
  }
}

}  // namespace
}  // namespace howl::inspect_test
