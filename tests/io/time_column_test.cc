#include "io/records/columns/time_column.h"

#include <random>

#include "tests/io/record_files.h"

namespace howl::time_column_test {
namespace {

// p at 10 kHz beside times printed by `format` from `epoch`; `time_of` may bend them.
struct Case {
  const char* format = "%.6f";
  double epoch_s = 0.0;
  double sampling_hz = 10000.0;
  int samples = 30000;
};

class Times : public testing::Test {
 protected:
  template <typename TimeOf>
  RecordSpec Spec(const Case& c, TimeOf time_of) {
    std::string text = "t,p\n";
    char line[100];
    for (int i = 0; i < c.samples; ++i) {
      std::snprintf(line, sizeof(line), c.format, c.epoch_s + time_of(i));
      text += std::string(line) + "," + std::to_string(i % 17) + "\n";
    }
    return {.file = folder_.Write("data.csv", text), .time = "t"};
  }
  RecordSpec Even(const Case& c) {
    return Spec(c, [&](int i) { return i / c.sampling_hz; });
  }
  TemporaryFolder folder_;
};

TEST_F(Times, ResolutionIsNoJitter) {
  const Case cases[] = {{"%.6f", 0.0},
                        {"%.4f", 0.0},
                        {"%.17e", 3506505626.71},
                        {"%.6f", 3506505626.0},
                        {"%.5f", 3506505626.71},
                        {"%.4f", 3506505626.7},
                        {"%.3f", 3506505626.7},  // ten samples share each printed time
                        {"%g", 100.0},
                        {"%.9g", 0.0},
                        {"%.7e", 12.5},
                        {"%.6f", -1.5},
                        {"%.17g", 1.7e9, 51200.0},
                        {"%.6f", 1.7e9, 44100.0}};
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.format) + " from " + std::to_string(c.epoch_s));
    const RecordSpec spec = Even(c);
    ASSERT_EQ(ErrorOf(spec), "no error");
    const Record record = LoadRecord(spec, "rig.yaml", 7);
    EXPECT_EQ(record.pressure.size(), 30000U);
    EXPECT_NEAR(record.sampling_hz, c.sampling_hz, 1e-3 * c.sampling_hz);
    if (std::string(c.format) != "%g") {
      EXPECT_EQ(record.sampling_hz, c.sampling_hz);
    }
  }
}

TEST_F(Times, RateThatIsNoRoundNumber) {
  const double sampling_hz = 12345.678901;
  const RecordSpec spec = Even({"%.17g", 0.0, sampling_hz});
  EXPECT_NEAR(LoadRecord(spec, "rig.yaml", 7).sampling_hz, sampling_hz, 1e-9 * sampling_hz);
}

TEST_F(Times, Gap) {
  const auto gap = [](double missing) {
    return [missing](int i) { return (i + (i >= 8998 ? missing : 0.0)) * 1e-4; };
  };
  EXPECT_EQ(ErrorOf(Spec({"%.6f"}, gap(2500))),
            "data.csv:9000: t: a time gap of 0.25 s, expected even steps of 0.0001 s");
  EXPECT_EQ(ErrorOf(Spec({"%.6f"}, gap(1))),
            "data.csv:9000: t: a time gap of 0.0002 s, expected even steps of 0.0001 s");
  // One sample lost, at the resolution of an epoch time in a double.
  EXPECT_THAT(ErrorOf(Spec({"%.17e", 3506505626.71}, gap(1))),
              testing::StartsWith("data.csv:9000: t: a time gap of 0.0002"));
  // Ten samples share a printed time: a gap of 5 ms is still seen.
  EXPECT_THAT(ErrorOf(Spec({"%.3f", 3506505626.7}, gap(50))), testing::HasSubstr("a time gap of"));
  RecordSpec spec = Spec({"%.6f"}, gap(2500));
  spec.duration_s = 0.8;
  EXPECT_EQ(ErrorOf(spec), "no error");
  EXPECT_EQ(LoadRecord(spec, "rig.yaml", 7).pressure.size(), 8000U);
}

TEST_F(Times, BackwardsOrStanding) {
  EXPECT_EQ(ErrorOf(Spec({"%.6f"}, [](int i) { return (i < 8998 ? i : i - 5000) * 1e-4; })),
            "data.csv:9000: t: time goes backwards by a step of -0.5 s, expected even steps of "
            "0.0001 s");
  EXPECT_EQ(ErrorOf(Spec({"%.6f"}, [](int i) { return (i < 8998 ? i : i - 1) * 1e-4; })),
            "data.csv:9000: t: time stands still, a step of 0 s, expected even steps of 0.0001 s");
  EXPECT_EQ(ErrorOf(Spec({"%.6f"}, [](int) { return 1.0; })),
            "data.csv:2: t: the times do not grow, expected even steps in s");
}

TEST_F(Times, Jitter) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto jitter = [&](double share) {
    return [&, share](int i) { return (i + share * uniform(random)) * 1e-4; };
  };
  EXPECT_THAT(ErrorOf(Spec({"%.9f"}, jitter(0.2))), testing::HasSubstr("an uneven time step of"));
  EXPECT_EQ(ErrorOf(Spec({"%.9f"}, jitter(0.02))), "no error");
}

TEST_F(Times, TwoSamplingRates) {
  RecordSpec spec = Even({});
  spec.sampling_hz = 5000.0;
  EXPECT_EQ(ErrorOf(spec),
            "data.csv:2: t: two sampling rates, 10000 Hz by the times in s and 5000 Hz by "
            "sampling_hz (rig.yaml:7), expected one");
  spec.sampling_hz = 10001.0;  // two clocks
  EXPECT_EQ(LoadRecord(spec, "rig.yaml", 7).sampling_hz, 10001.0);
}

TEST(TimeResolution, OfDecimalAndSinglePrecisionTimes) {
  std::vector<double> decimal;
  std::vector<double> single;
  for (int i = 0; i < 5000; ++i) {
    decimal.push_back(3506505626.71 + std::round(i * 1.25) * 1e-4);
    single.push_back(static_cast<double>(static_cast<float>(100.0 + i * 1e-4)));
  }
  EXPECT_NEAR(TimeResolution(decimal), 1e-4, 1e-9);
  EXPECT_NEAR(TimeResolution(single), 100.5 * 1.19209e-7, 1e-9);
}

}  // namespace
}  // namespace howl::time_column_test
