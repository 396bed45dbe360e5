// Every format gives the same samples.

#include "tests/io/record_files.h"

namespace howl::records_format_test {
namespace {

constexpr std::size_t kSamples = 400;
constexpr double kSamplingHz = 5000.0;

double P(std::size_t i) { return 3.0 * std::sin(0.27 * static_cast<double>(i)) + 0.1; }
double Q(std::size_t i) { return 1e-3 * std::cos(0.27 * static_cast<double>(i)) - 7e-5; }

std::vector<double> Values(double (*f)(std::size_t)) {
  std::vector<double> values;
  for (std::size_t i = 0; i < kSamples; ++i) values.push_back(f(i));
  return values;
}

// Time, q, an unused column, p; each line between `begin` and `end`.
std::string Text(const std::string& separator, const std::string& end,
                 const std::string& begin = "") {
  std::string text;
  char line[200];
  for (std::size_t i = 0; i < kSamples; ++i) {
    std::snprintf(line, sizeof(line), "%.4f%s%.17g%s%zu%s%.17g",
                  static_cast<double>(i) / kSamplingHz, separator.c_str(), Q(i), separator.c_str(),
                  i, separator.c_str(), P(i));
    text += begin + line + end;
  }
  return text;
}

class Formats : public testing::Test {
 protected:
  void ExpectSamples(const RecordSpec& spec) {
    Record record;
    try {
      record = LoadRecord(spec, "rig.yaml", 7);
    } catch (const UserError& error) {
      FAIL() << error.what();
    }
    EXPECT_EQ(record.sampling_hz, kSamplingHz);
    EXPECT_EQ(record.pressure, Values(P)) << spec.file;
    EXPECT_EQ(record.heat_release, Values(Q)) << spec.file;
  }
  void ExpectByName(const std::filesystem::path& file) {
    ExpectSamples({.file = file, .pressure = "p", .heat_release = "q", .time = "t"});
  }
  void ExpectByNumber(const std::filesystem::path& file) {
    ExpectSamples({.file = file, .pressure = "4", .heat_release = "2", .time = "1"});
  }
  TemporaryFolder folder_;
};

TEST_F(Formats, CsvWithHeader) {
  for (const std::string separator : {",", ";", "\t", " ", ", ", "   "}) {
    const std::string header = "t" + separator + "q" + separator + "n" + separator + "p";
    for (const std::string end : {"\n", "\r\n"}) {
      ExpectByName(folder_.Write("a.csv", header + end + Text(separator, end)));
      ExpectByNumber(folder_.Write("b.csv", header + end + Text(separator, end)));
    }
  }
}

TEST_F(Formats, CsvWithoutHeader) {
  for (const std::string separator : {",", ";", "\t", " ", " ; ", "\t "}) {
    ExpectByNumber(folder_.Write("a.csv", Text(separator, "\n")));
  }
  ExpectByNumber(folder_.Write("a.txt", Text("  ", " \r\n", "  ")));
}

TEST_F(Formats, Furniture) {
  ExpectByName(folder_.Write("bom.csv", "\xef\xbb\xbft,q,n,p\r\n" + Text(",", "\r\n")));
  ExpectByName(folder_.Write("quoted.csv", "\"t\",\"q\",\"n\",\"p\"\n" + Text(",", "\n")));
  ExpectByName(folder_.Write("trailing.csv", "t,q,n,p,\n" + Text(",", ",\n")));
  ExpectByName(folder_.Write("trailing2.csv", "t,q,n,p\n" + Text(",", ", \r\n")));
  ExpectByName(folder_.Write("blank.csv", "\n\nt,q,n,p\n\n" + Text(",", "\n") + "\n  \r\n\n"));
  ExpectByName(folder_.Write("units.csv", "t,q,n,p\ns,W,-,Pa\n" + Text(",", "\n")));
  ExpectByName(folder_.Write("numpy.txt", "# run 12\n# t q n p\n" + Text(" ", "\n")));
  ExpectByName(
      folder_.Write("comments.csv", "% rig\nt,q,n,p\n# a\n" + Text(",", "\n") + "# the end"));
  ExpectByName(folder_.Write("between.csv", "t,q,n,p\n" + Text(",", "\n# note\n")));
  std::string cut = "t,q,n,p\n" + Text(",", "\n");
  cut.pop_back();
  ExpectByName(folder_.Write("no_last_line_end.csv", cut));
}

TEST_F(Formats, NamesWithBlanksAndChannelsByNumber) {
  folder_.Write("a.tsv", "Time (s)\tHeat release\tn\tPressure, Pa\n" + Text("\t", "\n"));
  ExpectSamples({.file = folder_ / "a.tsv",
                 .pressure = "Pressure, Pa",
                 .heat_release = "Heat release",
                 .time = "Time (s)"});
  for (const std::string separator : {",", ";", "\t", " "}) {
    const std::string header =
        "\"Time, s\"" + separator + "\"Q; W\"" + separator + "\"n\"" + separator + "\"p in Pa\"\n";
    folder_.Write("a.csv", header + Text(separator, "\n"));
    ExpectSamples({.file = folder_ / "a.csv",
                   .pressure = "p in Pa",
                   .heat_release = "Q; W",
                   .time = "Time, s"});
  }
  ExpectByNumber(folder_.Write("daq.csv", "time,2,3,4\n" + Text(",", "\n")));
}

TEST_F(Formats, GzipByContent) {
  const std::string text = "t,q,n,p\n" + Text(",", "\n");
  ExpectByName(WriteGzip(folder_ / "a.csv.gz", text));
  ExpectByName(WriteGzip(folder_ / "misnamed.csv", text));
  ExpectByName(folder_.Write("plain.gz", text));
  // Several members in a row, cut inside of a line, with padding behind.
  WriteGzip(folder_ / "members.gz", text.substr(0, 5001));
  WriteGzip(folder_ / "members.gz", text.substr(5001), "ab");
  ExpectByName(folder_ / "members.gz");
  ExpectByName(
      folder_.Write("padded.gz", ReadBytes(folder_ / "members.gz") + std::string(512, '\0')));
}

// Lines across the ends of blocks: far more than one block, and lines longer than a block.
TEST_F(Formats, LongFilesAndLongLines) {
  std::string text;
  std::vector<double> expected;
  for (int i = 0; i < 150000; ++i) {
    expected.push_back(i % 977 * 0.125 + 1e-3);
    char line[40];
    std::snprintf(line, sizeof(line), "%.17g\n", expected.back());
    text += line;
  }
  RecordSpec spec{
      .file = WriteGzip(folder_ / "long.gz", text), .pressure = "1", .sampling_hz = 1.0};
  EXPECT_EQ(LoadRecord(spec, "rig.yaml", 7).pressure, expected);
  text.clear();
  for (std::size_t i = 0; i < 40; ++i) {
    char line[40];
    std::snprintf(line, sizeof(line), ",%.17g\n", P(i));
    text += std::string(700000, 'x') + line;
  }
  spec.file = folder_.Write("wide.csv", "note,p\n" + text);
  spec.pressure = "p";
  const Record record = LoadRecord(spec, "rig.yaml", 7);
  ASSERT_EQ(record.pressure.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(record.pressure[i], P(i));
}

TEST_F(Formats, Mat) {
  std::vector<double> time;
  for (std::size_t i = 0; i < kSamples; ++i) time.push_back(static_cast<double>(i) / kSamplingHz);
  std::vector<double> matrix = time;
  for (const auto& column : {Values(Q), time, Values(P)}) {
    matrix.insert(matrix.end(), column.begin(), column.end());
  }
  std::vector<double> wide;  // 4 x n: channels along the rows
  for (std::size_t i = 0; i < kSamples; ++i) {
    wide.insert(wide.end(), {time[i], Q(i), 0.0, P(i)});
  }
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    for (const matio_compression packing : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
      const std::filesystem::path file = folder_ / "a.mat";
      std::filesystem::remove(file);
      mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
      AddMatVariable(mat, "t", kSamples, 1, time, packing);
      AddMatVariable(mat, "p", kSamples, 1, Values(P), packing);
      AddMatVariable(mat, "q", 1, kSamples, Values(Q), packing);
      AddMatVariable(mat, "all", kSamples, 4, matrix, packing);
      Mat_Close(mat);
      ExpectByName(file);
      ExpectByNumber(file);
      ExpectSamples({.file = file, .pressure = "all:4", .heat_release = "q", .time = "all:1"});
      mat = Mat_CreateVer((folder_ / "wide.mat").c_str(), nullptr, version);
      AddMatVariable(mat, "all", 4, kSamples, wide, packing);
      Mat_Close(mat);
      ExpectByNumber(folder_ / "wide.mat");
      std::filesystem::remove(folder_ / "wide.mat");
    }
  }
}

TEST_F(Formats, MatIntegersAndSinglePrecision) {
  std::vector<std::int16_t> counts;
  std::vector<float> volts;
  for (std::size_t i = 0; i < kSamples; ++i) {
    counts.push_back(static_cast<std::int16_t>(1000.0 * P(i)));
    volts.push_back(static_cast<float>(Q(i)));
  }
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    std::filesystem::remove(folder_ / "a.mat");
    mat_t* mat = Mat_CreateVer((folder_ / "a.mat").c_str(), nullptr, version);
    std::size_t sizes[2] = {kSamples, 1};
    matvar_t* variable = Mat_VarCreate("p", MAT_C_INT16, MAT_T_INT16, 2, sizes, counts.data(), 0);
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
    variable = Mat_VarCreate("q", MAT_C_SINGLE, MAT_T_SINGLE, 2, sizes, volts.data(), 0);
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
    // MATLAB 5 files hold doubles that are whole numbers as integers.
    const bool packed = version == MAT_FT_MAT5;
    variable = Mat_VarCreate("packed", MAT_C_DOUBLE, packed ? MAT_T_INT16 : MAT_T_DOUBLE, 2, sizes,
                             nullptr, 0);
    std::vector<double> doubles(counts.begin(), counts.end());
    variable->data = packed ? static_cast<void*>(counts.data()) : doubles.data();
    variable->data_size = packed ? 2 : 8;
    variable->nbytes = kSamples * static_cast<std::size_t>(variable->data_size);
    variable->mem_conserve = 1;
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_ZLIB);
    variable->data = nullptr;
    Mat_VarFree(variable);
    Mat_Close(mat);
    for (const char* name : {"p", "packed"}) {
      const RecordSpec spec{.file = folder_ / "a.mat", .pressure = name, .sampling_hz = 1.0};
      ASSERT_EQ(LoadRecord(spec, "rig.yaml", 7).pressure,
                std::vector<double>(counts.begin(), counts.end()));
    }
    const Record record = LoadRecord({.file = folder_ / "a.mat",
                                      .pressure = "p",
                                      .heat_release = "q",
                                      .sampling_hz = 1.0,
                                      .pressure_scale = 0.5},
                                     "rig.yaml", 7);
    for (std::size_t i = 0; i < kSamples; ++i) {
      ASSERT_EQ(record.pressure[i], 0.5 * counts[i]);
      ASSERT_EQ(record.heat_release[i], static_cast<double>(volts[i]));
    }
  }
}

TEST_F(Formats, Hdf5) {
  std::vector<double> time;
  std::vector<double> tall;
  std::vector<double> wide(4 * kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    time.push_back(static_cast<double>(i) / kSamplingHz);
    const double row[4] = {time[i], Q(i), 0.0, P(i)};
    tall.insert(tall.end(), row, row + 4);
    for (std::size_t c = 0; c < 4; ++c) wide[c * kSamples + i] = row[c];
  }
  const std::filesystem::path file = folder_ / "a.h5";
  hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  AddDataset(h5, "/rig/run1/p", {kSamples}, Values(P));
  AddDataset(h5, "/rig/run1/q", {kSamples, 1}, Values(Q));
  AddDataset(h5, "/t", {1, kSamples}, time);
  AddDataset(h5, "/tall", {kSamples, 4}, tall);
  H5Fclose(h5);
  ExpectSamples(
      {.file = file, .pressure = "/rig/run1/p", .heat_release = "rig/run1/q", .time = "t"});
  ExpectByNumber(file);
  ExpectSamples({.file = file, .pressure = "tall:4", .heat_release = "tall:2", .time = "/tall:1"});
  h5 = H5Fcreate((folder_ / "wide.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  AddDataset(h5, "/wide", {4, kSamples}, wide);
  H5Fclose(h5);
  ExpectByNumber(folder_ / "wide.h5");
}

TEST_F(Formats, PartAndScales) {
  const std::filesystem::path file = folder_.Write("a.csv", "t,q,n,p\n" + Text(",", "\n"));
  for (const bool with_time : {true, false}) {
    RecordSpec spec{.file = file,
                    .heat_release = "q",
                    .sampling_hz = kSamplingHz,
                    .pressure_scale = 4.0,
                    .heat_release_scale = -2.0,
                    .start_s = 0.02,
                    .duration_s = 0.05};
    if (with_time) spec.time = "t";
    const Record record = LoadRecord(spec, "rig.yaml", 7);
    ASSERT_EQ(record.pressure.size(), 250U);
    ASSERT_EQ(record.heat_release.size(), 250U);
    for (std::size_t i = 0; i < 250; ++i) {
      ASSERT_EQ(record.pressure[i], 4.0 * P(i + 100));
      ASSERT_EQ(record.heat_release[i], -2.0 * Q(i + 100));
    }
  }
}

TEST_F(Formats, WriterRoundTripsEveryBit) {
  Record record{.sampling_hz = 10.0};
  for (int i = 0; i < 20000; ++i) {
    record.pressure.push_back(std::exp(std::sin(1.7 * i) * 60.0) / 3.0);
    record.heat_release.push_back(-0.1 / (i + 1));
  }
  record.pressure[5] = 5e-324;
  record.pressure[6] = -9.9999999999999988e29;
  WriteRecordCsv(folder_ / "out.csv", record);
  const RecordSpec spec{.file = folder_ / "out.csv", .heat_release = "q", .sampling_hz = 10.0};
  const Record back = LoadRecord(spec, "rig.yaml", 7);
  EXPECT_EQ(back.pressure, record.pressure);
  EXPECT_EQ(back.heat_release, record.heat_release);
  record.heat_release.clear();
  WriteRecordCsv(folder_ / "out.csv", record);
  EXPECT_TRUE(ReadBytes(folder_ / "out.csv").starts_with("p\n"));
  EXPECT_EQ(LoadRecord({.file = folder_ / "out.csv", .sampling_hz = 10.0}, "rig.yaml", 7).pressure,
            record.pressure);
}

TEST_F(Formats, WriterLeavesNothingHalfDone) {
  Record record{.sampling_hz = 10.0, .pressure = {1.0, 2.0}};
  EXPECT_THROW(WriteRecordCsv("/proc/absent/out.csv", record), UserError);
  std::filesystem::create_directory(folder_ / "taken");
  EXPECT_THROW(WriteRecordCsv(folder_ / "taken", record), UserError);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

}  // namespace
}  // namespace howl::records_format_test
