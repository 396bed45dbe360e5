// The unit of a time column: by its name, or by a sampling rate beside it.
#include "io/records/columns/time_unit.h"

#include <utility>

#include "tests/io/record_files.h"

namespace howl::time_unit_test {
namespace {

TEST(TimeUnit, NamesEndWithTheirUnit) {
  const std::pair<const char*, double> known[] = {
      {"time_ms", 1e-3},  {"t [ms]", 1e-3}, {"Time (us)", 1e-6},   {"time/s", 1.0},
      {"TIME_MS", 1e-3},  {"t_us", 1e-6},   {"t [ s ]", 1.0},      {"Time (sec)", 1.0},
      {"clock.ns", 1e-9}, {"t, ms", 1e-3},  {"t [\u00b5s]", 1e-6}, {"time (milliseconds)", 1e-3}};
  for (const auto& [name, unit_s] : known) {
    EXPECT_EQ(TimeUnitOfName(name), unit_s) << name;
  }
  // A unit that is none of time's, or a name that only ends like one.
  for (const char* name :
       {"t", "time", "times", "ms", "alarms", "p_kPa", "time_stamp", "t []", ""}) {
    EXPECT_EQ(TimeUnitOfName(name), std::nullopt) << name;
  }
}

TEST(TimeUnit, ARateWithTheTimesTells) {
  EXPECT_EQ(TimeUnitOfRates(5.0, 5000.0, 0.01), 1e-3);
  EXPECT_EQ(TimeUnitOfRates(0.0501, 50000.0, 0.01), 1e-6);
  EXPECT_EQ(TimeUnitOfRates(5000.0, 5000.0, 0.01), 1.0);
  EXPECT_EQ(TimeUnitOfRates(2500.0, 5000.0, 0.01), std::nullopt);
}

// p at 12.8 kHz, times in a unit of `per_second`, printed to 7 significant digits.
class TimeUnits : public testing::Test {
 protected:
  RecordSpec Spec(const std::string& header, double per_second, const std::string& time) {
    std::string text = header;
    char line[64];
    for (int i = 0; i < 4000; ++i) {
      std::snprintf(line, sizeof line, "%.7g,%d\n", i / 12800.0 * per_second, i % 17);
      text += line;
    }
    return {.file = folder_.Write("data.csv", text), .time = time};
  }
  TemporaryFolder folder_;
};

TEST_F(TimeUnits, TheHeaderIsBelievedByNameAndByNumber) {
  for (const char* time : {"t [ms]", "1"}) {
    const RecordSpec spec = Spec("t [ms],p\n", 1e3, time);
    ASSERT_EQ(ErrorOf(spec), "no error") << time;
    EXPECT_NEAR(LoadRecord(spec, "rig.yaml", 7).sampling_hz, 12800.0, 0.1) << time;
  }
  RecordSpec part = Spec("t_us,p\n", 1e6, "t_us");
  part.start_s = 0.1;
  part.duration_s = 0.2;
  // Seven digits leave the end's place open by one sample.
  EXPECT_NEAR(static_cast<double>(LoadRecord(part, "rig.yaml", 7).pressure.size()), 2560.0, 1.0);
}

TEST_F(TimeUnits, WithoutANameTheyAreSeconds) {
  EXPECT_NEAR(LoadRecord(Spec("t,p\n", 1e3, "t"), "rig.yaml", 7).sampling_hz, 12.8, 1e-4);
  RecordSpec numbered = Spec("", 1e3, "1");
  numbered.pressure = "2";
  EXPECT_NEAR(LoadRecord(numbered, "rig.yaml", 7).sampling_hz, 12.8, 1e-4);
}

TEST_F(TimeUnits, ARateThatAgreesInMillisecondsIsOne) {
  RecordSpec spec = Spec("t,p\n", 1e3, "t");
  spec.sampling_hz = 12800.0;
  EXPECT_EQ(LoadRecord(spec, "rig.yaml", 7).sampling_hz, 12800.0);
  spec.sampling_hz = 10000.0;
  EXPECT_THAT(ErrorOf(spec), testing::HasSubstr("two sampling rates, 12.8 Hz by the times in s"));
}

TEST_F(TimeUnits, AFaultIsToldInSeconds) {
  std::string text = "t [ms],p\n";
  for (int i = 0; i < 100; ++i) {
    text += std::to_string(i < 50 ? i : i + 5) + "," + std::to_string(i % 7) + "\n";
  }
  const RecordSpec spec{.file = folder_.Write("gap.csv", text), .time = "t [ms]"};
  EXPECT_THAT(ErrorOf(spec), testing::HasSubstr("a time gap of 0.006 s, expected even steps of "
                                                "0.001 s"));
}

}  // namespace
}  // namespace howl::time_unit_test
