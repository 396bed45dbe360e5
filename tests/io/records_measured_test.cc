// Measured records, where HOWL_DATA says they are.
#include <cstdlib>

#include "tests/io/record_files.h"

namespace howl::records_measured_test {
namespace {

class Measured : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("HOWL_DATA");
    if (folder == nullptr) GTEST_SKIP() << "HOWL_DATA is not set: no measured records";
    folder_ = folder;
  }
  std::filesystem::path folder_;
};

TEST_F(Measured, TurbulentCombustor) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "turbulent_combustor")) {
    if (entry.path().extension() != ".gz") continue;
    ++files;
    SCOPED_TRACE(entry.path());
    const RecordSpec spec{.file = entry.path(), .pressure = "3", .heat_release = "2", .time = "1"};
    ASSERT_EQ(ErrorOf(spec), "no error");
    const Record record = LoadRecord(spec, "rig.yaml", 7);
    EXPECT_EQ(record.sampling_hz, 10000.0);
    EXPECT_EQ(record.pressure.size(), 30000U);
    EXPECT_EQ(record.heat_release.size(), 30000U);
  }
  EXPECT_EQ(files, 13);
}

TEST_F(Measured, RijkeTube) {
  int files = 0;
  for (const char* part : {"quasi_static", "ramps"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "rijke_tube" / part)) {
      if (entry.path().extension() != ".gz") continue;
      ++files;
      SCOPED_TRACE(entry.path());
      const RecordSpec spec{
          .file = entry.path(), .pressure = "2", .time = "1", .pressure_scale = 1000.0 / 0.2175};
      ASSERT_EQ(ErrorOf(spec), "no error");
      EXPECT_EQ(LoadRecord(spec, "rig.yaml", 7).sampling_hz, 10000.0);
    }
  }
  EXPECT_EQ(files, 8);
}

}  // namespace
}  // namespace howl::records_measured_test
