#include <glog/logging.h>

#include <cmath>
#include <string>

#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/inspect/init_config.h"
#include "io/inspect/record_look.h"
#include "io/records/record_faults.h"
#include "io/records/records.h"
#include "io/records/response_table.h"
#include "tests/fuzz/target.h"

namespace howl {
namespace {

void ExpectFinite(const std::vector<double>& samples) {
  for (const double sample : samples) CHECK(std::isfinite(sample));
}

void Load(const RecordSpec& spec) {
  Answered([&] {
    const Record record = LoadRecord(spec, "config.yaml", 3);
    CHECK_GE(record.pressure.size(), kFewestSamples);
    CHECK(std::isfinite(record.sampling_hz) && record.sampling_hz > 0.0);
    ExpectFinite(record.pressure);
    ExpectFinite(record.heat_release);
  });
}

// As howl init looks at it, and as configs name its columns.
void ReadRecord(std::string_view input) {
  const std::filesystem::path file = InputFile(input);
  TextDialect dialect;
  Answered([&] {
    const RecordLook look = LookAtRecord(file);
    dialect = look.dialect;
    (void)look.Layout();
  });
  RecordSpec by_name{.file = file, .heat_release = "q", .sampling_hz = 5000.0};
  Load(by_name);
  RecordSpec by_number{.file = file,
                       .dialect = dialect,
                       .pressure = "2",
                       .heat_release = "3",
                       .time = "1",
                       .duration_s = 0.004};
  Load(by_number);
  Answered([&] { (void)ReadResponseTable(file); });
}

// The bytes by which a format is recognised are put in their place: what is fuzzed is its reader.
std::function<void(std::string_view)> WithMagic(const std::string& magic, std::size_t at = 0) {
  return [magic, at](std::string_view input) {
    std::string bytes(input);
    if (bytes.size() < at + magic.size()) bytes.resize(at + magic.size());
    bytes.replace(at, magic.size(), magic);
    ReadRecord(bytes);
  };
}

// All faults of a record, as howl check tells them.
void Faults(std::string_view input) {
  const RecordSpec spec{.file = InputFile(input),
                        .pressure = "p",
                        .heat_release = "q",
                        .time = "t",
                        .start_s = 0.002,
                        .duration_s = 0.1};
  const RecordReading reading = ReadRecordOn(spec, "config.yaml", 3);
  CHECK(reading.record || !reading.faults.empty());
  for (const UserError& fault : reading.faults) CheckIsOneLine(fault.what());
}

// What howl init writes, its FILL_INs given, is a config.
void Init(std::string_view input) {
  const std::filesystem::path file = ScratchFolder() / "init.csv";
  std::filesystem::rename(InputFile(input), file);
  Answered([&] {
    const std::vector<RecordLook> looks = {LookAtRecord(file)};
    const InitConfig written = WriteInitConfig(
        looks, {.folder = ScratchFolder(), .values = {"0.5"}, .sampling_hz = 5000.0});
    CHECK_EQ(written.left_open, 0U);
    try {
      (void)LoadConfig(InputFile(written.text));
    } catch (const UserError& error) {
      LOG(FATAL) << error.what() << "\n" << written.text;
    }
  });
}

}  // namespace

std::vector<FuzzTarget> RecordTargets() {
  return {{"text", ReadRecord},
          {"gzip", WithMagic("\x1f\x8b\x08")},
          {"mat5", WithMagic("MATLAB 5.0 MAT-file")},
          {"mat73", WithMagic("\x89HDF\r\n\x1a\n", 512)},
          {"faults", Faults},
          {"init", Init},
          {"hdf5", WithMagic("\x89HDF\r\n\x1a\n")}};
}

}  // namespace howl
