// Every mistake gives one line that names the data's file and line.
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <random>
#include <thread>

#include "tests/io/record_files.h"

namespace howl::records_error_test {
namespace {

constexpr int kSamples = 10000;

// t,p,q at 1 kHz, the header in line 1: row i in line i + 2.
std::string Csv(const std::function<std::string(int, std::string)>& change = nullptr,
                int samples = kSamples) {
  std::string text = "t,p,q\n";
  char line[100];
  for (int i = 0; i < samples; ++i) {
    std::snprintf(line, sizeof(line), "%.3f,%.6f,%.6f", i * 1e-3, std::sin(0.7 * i),
                  std::cos(0.7 * i));
    text += (change ? change(i + 2, line) : std::string(line)) + "\n";
  }
  return text;
}

std::string CsvWithLine(int line, const std::string& text) {
  return Csv([&](int at, const std::string& was) { return at == line ? text : was; });
}

class Errors : public testing::Test {
 protected:
  RecordSpec Spec(const std::string& bytes) {
    return {.file = folder_.Write("data.csv", bytes),
            .heat_release = "q",
            .time = "t",
            .sampling_hz = 1000.0};
  }
  std::string ErrorOfBytes(const std::string& bytes) { return ErrorOf(Spec(bytes)); }
  TemporaryFolder folder_;
};

TEST_F(Errors, TheUnchangedFileIsGood) {
  EXPECT_EQ(ErrorOfBytes(Csv()), "no error");
  RecordSpec spec = Spec(Csv());
  spec.sampling_hz.reset();
  EXPECT_EQ(LoadRecord(spec, "rig.yaml", 7).sampling_hz, 1000.0);
}

// An earlier stage was 8 KiB ahead of the reader.
TEST_F(Errors, APipeGivesAllItsRows) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string text = Csv();
  text.erase(0, text.find('\n') + 1);  // numbered columns
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << text; });
  const RecordSpec spec{
      .file = pipe, .pressure = "2", .heat_release = "3", .time = "1", .sampling_hz = 1000.0};
  const Record record = LoadRecord(spec, "rig.yaml", 7);
  writer.join();
  EXPECT_EQ(record.pressure.size(), static_cast<std::size_t>(kSamples));
  EXPECT_NEAR(record.pressure[1], std::sin(0.7), 1e-6);
}

// matio fills what is missing with what it finds behind it.
TEST_F(Errors, MatlabDimensionsOtherThanTheNumbers) {
  const std::filesystem::path file = folder_ / "a.mat";
  const RecordSpec spec{.file = file, .heat_release = "q", .sampling_hz = 1000.0};
  for (const matio_compression packing : {MAT_COMPRESSION_ZLIB, MAT_COMPRESSION_NONE}) {
    mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
    for (const char* const name : {"p", "q"}) {
      std::vector<double> values(48);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 7);
      AddMatVariable(mat, name, values.size(), 1, values, packing);
    }
    Mat_Close(mat);
    EXPECT_EQ(ErrorOf(spec), "no error");
  }
  const std::string bytes = ReadBytes(file);
  const std::size_t at = bytes.find(std::string("\x30\0\0\0\x01\0\0\0", 8));
  ASSERT_NE(at, std::string::npos);
  for (const int rows : {64, 32}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(rows);
    folder_.Write("a.mat", damaged);
    EXPECT_EQ(ErrorOf(spec), "a.mat: p: has 48 numbers, expected " + std::to_string(rows) +
                                 " x 1 by its dimensions: damaged");
  }
}

TEST_F(Errors, NotFinite) {
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(9000, "8.998,nan,0.5")),
            "data.csv:9000: p: nan, expected a finite number");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(9000, "8.998,0.5,-Inf")),
            "data.csv:9000: q: -inf, expected a finite number");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(9000, "8.998,0.5,1e999")),
            "data.csv:9000: q: inf, expected a finite number");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(9000, "NaN,0.5,1")),
            "data.csv:9000: t: nan, expected a finite time in s");
  RecordSpec spec = Spec(CsvWithLine(9000, "8.998,nan,0.5"));
  spec.duration_s = 8.0;  // what is not asked for is not judged
  EXPECT_EQ(ErrorOf(spec), "no error");
}

TEST_F(Errors, LinesAreCountedThroughCommentsAndBlankStarts) {
  const std::string text = Csv([](int at, const std::string& was) {
    if (at == 100) return "# stop\n# go\n" + was;
    return at == 5000 ? "4.998,nan,0" : was;
  });
  EXPECT_EQ(ErrorOfBytes("# rig\n\n" + text), "data.csv:5004: p: nan, expected a finite number");
}

TEST_F(Errors, RaggedRows) {
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(77, "0.075,1.0")),
            "data.csv:77: a row of 2 columns, expected 3 (t, p, q)");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(77, "0.075,1.0,2.0,3.0")),
            "data.csv:77: a row of 4 columns, expected 3 (t, p, q)");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(77, "")),
            "data.csv:77: a blank line inside the data, expected a row");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(2, "0,1.0")),
            "data.csv:2: a row of 2 columns, expected 3 (t, p, q)");
  std::string cut = Csv();
  cut.resize(cut.size() - 12);
  EXPECT_EQ(ErrorOfBytes(cut), "data.csv:10001: a row of 2 columns, expected 3 (t, p, q)");
}

TEST_F(Errors, TextInANumber) {
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(1234, "1.232,0.5,0.1V")),
            "data.csv:1234: q: '0.1V', expected a number");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(1234, "1.232,,0.1")),
            "data.csv:1234: p: empty, expected a number");
  EXPECT_EQ(ErrorOfBytes(CsvWithLine(1234, "1.232,1.2.3,0.1")),
            "data.csv:1234: p: '1.2.3', expected a number");
  RecordSpec spec{.file = folder_.Write("data.csv", "1,abc\n2,3\n"), .pressure = "2"};
  spec.sampling_hz = 1.0;
  EXPECT_EQ(ErrorOf(spec), "data.csv:1: column 2: 'abc', expected a number");
  spec.file = folder_.Write("data.csv", "1;2,5\n2;3,5\n");
  EXPECT_EQ(ErrorOf(spec), "data.csv:1: column 2: '2,5', expected a number with a decimal point");
}

TEST_F(Errors, FewSamplesAndEmptyFiles) {
  EXPECT_EQ(ErrorOfBytes(Csv(nullptr, 31)), "data.csv:32: 31 samples, expected at least 32");
  EXPECT_EQ(ErrorOfBytes(Csv(nullptr, 1)), "data.csv:2: 1 samples, expected at least 32");
  EXPECT_EQ(ErrorOfBytes(Csv(nullptr, 32)), "no error");
  EXPECT_EQ(ErrorOfBytes(Csv(nullptr, 0)), "data.csv:1: no rows of numbers, expected at least 32");
  EXPECT_EQ(ErrorOfBytes(""), "data.csv:1: an empty file, expected columns of numbers");
  EXPECT_EQ(ErrorOfBytes("\n\n"), "data.csv:2: no rows of numbers, expected at least 32");
  RecordSpec spec = Spec("");
  spec.file = WriteGzip(folder_ / "data.csv", "");
  EXPECT_EQ(ErrorOf(spec), "data.csv:1: an empty file, expected columns of numbers");
}

TEST_F(Errors, ConstantSignal) {
  std::string text = "p\n";
  for (int i = 0; i < 100; ++i) text += "0.25\n";
  EXPECT_EQ(ErrorOf({.file = folder_.Write("data.csv", text), .sampling_hz = 1.0}),
            "data.csv:2: p: constant at 0.25 in all 100 samples, expected a signal");
}

TEST_F(Errors, MissingColumns) {
  RecordSpec spec = Spec("# rig\n" + Csv());
  spec.pressure = "P";
  EXPECT_EQ(ErrorOf(spec),
            "data.csv:2: P: no such column, expected one of t, p, q, or a number from 1 to 3");
  spec.pressure = "4";
  EXPECT_EQ(
      ErrorOf(spec),
      "data.csv:2: column 4: no such column, expected one of t, p, q, or a number from 1 to 3");
  spec.pressure = "3";
  EXPECT_EQ(ErrorOf(spec), "data.csv:2: q: the same column is asked for twice");
  const std::string no_header = Csv().substr(6);
  EXPECT_EQ(ErrorOfBytes(no_header),
            "data.csv:1: p: the file has no header, expected a number from 1 to 3");
  EXPECT_EQ(ErrorOfBytes("t,p,p" + Csv().substr(5)),
            "data.csv:1: p: more than one column has this name, expected a number from 1 to 3");
}

TEST_F(Errors, DamagedGzip) {
  RecordSpec spec = Spec("");
  const std::string packed = ReadBytes(WriteGzip(folder_ / "data.csv", Csv()));
  for (const std::size_t left : {packed.size() / 2, packed.size() - 1, std::size_t{12}}) {
    folder_.Write("data.csv", packed.substr(0, left));
    EXPECT_THAT(ErrorOf(spec),
                testing::MatchesRegex("data\\.csv:[0-9]+: truncated gzip, expected its end"));
  }
  std::string flipped = packed;
  for (int i = 0; i < 64; ++i) flipped[packed.size() / 2 + static_cast<std::size_t>(i)] ^= 0x5a;
  folder_.Write("data.csv", flipped);
  EXPECT_THAT(ErrorOf(spec), testing::HasSubstr("data.csv:"));
  flipped = packed;
  flipped[packed.size() - 6] ^= 1;  // the checksum
  folder_.Write("data.csv", flipped);
  EXPECT_THAT(ErrorOf(spec), testing::HasSubstr("damaged gzip data (incorrect data check)"));
}

TEST_F(Errors, BinaryAndForeignFiles) {
  std::string bytes(3000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 37 % 251);
  const std::string expected = "binary data, expected text (plain or gzip), MATLAB .mat or HDF5";
  EXPECT_EQ(ErrorOfBytes(bytes), "data.csv:1: " + expected);
  RecordSpec spec = Spec("");
  spec.file = WriteGzip(folder_ / "data.csv", bytes);
  EXPECT_EQ(ErrorOf(spec), "data.csv:1: " + expected);
  EXPECT_THAT(ErrorOfBytes("PK\x03\x04....."), testing::HasSubstr("data.csv: a zip archive"));
  EXPECT_THAT(ErrorOfBytes("\xff\xfe"
                           "1"),
              testing::HasSubstr("data.csv:1: UTF-16 text that ends within a character"));
}

TEST_F(Errors, OldMacLineEnds) {
  std::string text = Csv();
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_THAT(ErrorOfBytes(text), testing::StartsWith("data.csv:1: a carriage return inside"));
}

// Whatever happens to the bytes, the answer is a record of finite numbers or one line of text.
TEST_F(Errors, AnyDamageGivesARecordOrOneLine) {
  std::mt19937 random(11);
  const std::string good = Csv(nullptr, 40);
  WriteGzip(folder_ / "good.gz", good);
  const std::string packed = ReadBytes(folder_ / "good.gz");
  const std::string marks = ",;\t \n\r#%\"'.eE+-0123456789nanif\xff";
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = i % 4 == 0 ? packed : good;
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < changes; ++k) {
      const std::size_t at = random() % bytes.size();
      const char mark = i % 4 == 0 ? static_cast<char>(random()) : marks[random() % marks.size()];
      switch (random() % 4) {
        case 0:
          bytes.erase(at, 1 + random() % 40);
          break;
        case 1:
          bytes.insert(at, 1 + random() % 3, mark);
          break;
        default:
          bytes[at] = mark;
      }
      if (bytes.empty()) bytes = "1";
    }
    RecordSpec spec = Spec(bytes);
    if (random() % 2 == 0) spec.time.reset();
    try {
      const Record record = LoadRecord(spec, "rig.yaml", 7);
      ASSERT_EQ(record.pressure.size(), record.heat_release.size());
      for (std::size_t k = 0; k < record.pressure.size(); ++k) {
        ASSERT_TRUE(std::isfinite(record.pressure[k]) && std::isfinite(record.heat_release[k]));
      }
    } catch (const UserError& error) {
      ++refused;
      const std::string text = error.what();
      ASSERT_THAT(text, testing::HasSubstr("data.csv:"));
      ASSERT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST_F(Errors, PlacesThatAreNoFile) {
  EXPECT_EQ(ErrorOf({.file = folder_ / "absent.csv", .sampling_hz = 1.0}),
            "absent.csv: cannot open: No such file or directory");
  EXPECT_THAT(ErrorOf({.file = folder_.path(), .sampling_hz = 1.0}),
              testing::HasSubstr("a folder, expected a file"));
}

TEST_F(Errors, WhatWasAskedFor) {
  RecordSpec spec = Spec(Csv());
  spec.start_s = 10.0;
  EXPECT_EQ(ErrorOf(spec), "rig.yaml:7: start_s: 10 s, expected less than the record's 10 s");
  spec.start_s = 4.0;
  spec.duration_s = 6.1;
  EXPECT_EQ(ErrorOf(spec),
            "rig.yaml:7: duration_s: 6.1 s from start_s 4 s, expected to end within the record's "
            "10 s");
  spec.duration_s = 6.0;
  EXPECT_EQ(ErrorOf(spec), "no error");
  spec.duration_s = 0.01;
  EXPECT_EQ(ErrorOf(spec), "rig.yaml:7: duration_s: leaves 10 samples, expected at least 32");
  spec = Spec(Csv());
  spec.pressure_scale = 0.0;
  EXPECT_EQ(ErrorOf(spec), "rig.yaml:7: pressure_scale: 0, expected a finite number other than 0");
  spec = Spec(Csv());
  spec.time.reset();
  spec.sampling_hz.reset();
  EXPECT_EQ(ErrorOf(spec), "rig.yaml:7: sampling_hz: missing, expected it or a time column");
}

class ArrayErrors : public testing::Test {
 protected:
  std::string Error(const std::string& file, const std::string& column) {
    return ErrorOf({.file = folder_ / file, .pressure = column, .sampling_hz = 1.0});
  }
  static std::vector<double> Wave(std::size_t n) {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = std::sin(0.3 * static_cast<double>(i));
    return values;
  }
  TemporaryFolder folder_;
};

TEST_F(ArrayErrors, Mat) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    std::filesystem::remove(folder_ / "a.mat");
    mat_t* mat = Mat_CreateVer((folder_ / "a.mat").c_str(), nullptr, version);
    std::vector<double> wave = Wave(100);
    wave[89] = std::nan("");
    AddMatVariable(mat, "p", 100, 1, wave);
    AddMatVariable(mat, "q", 99, 1, Wave(99));
    AddMatVariable(mat, "m", 100, 2, Wave(200));
    std::vector<double> imaginary = Wave(100);
    mat_complex_split_t split = {wave.data(), imaginary.data()};
    std::size_t sizes[2] = {100, 1};
    matvar_t* variable =
        Mat_VarCreate("z", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sizes, &split, MAT_F_COMPLEX);
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
    std::string note = "note";
    std::size_t note_sizes[2] = {1, 4};
    variable = Mat_VarCreate("s", MAT_C_CHAR, MAT_T_UTF8, 2, note_sizes, note.data(), 0);
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
    Mat_Close(mat);
    EXPECT_EQ(Error("a.mat", "x"),
              "a.mat: x: no such variable, expected one of m (100 x 2), p (100 x 1), q (99 x 1), "
              "s (text), z (complex)");
    EXPECT_EQ(Error("a.mat", "z"), "a.mat: z: complex, expected real numbers");
    EXPECT_EQ(Error("a.mat", "s"), "a.mat: s: text, expected real numbers");
    EXPECT_EQ(Error("a.mat", "m"), "a.mat: m: a 100 x 2 matrix, expected m:K with K from 1 to 2");
    EXPECT_EQ(Error("a.mat", "3"),
              "a.mat: column 3: no such column, expected 1 to 2 of m (100 x 2)");
    EXPECT_EQ(Error("a.mat", "p"), "a.mat: p: sample 90: nan, expected a finite number");
    EXPECT_EQ(ErrorOf({.file = folder_ / "a.mat", .heat_release = "q", .sampling_hz = 1.0}),
              "a.mat: q: 99 samples, expected 100 as in p");
    EXPECT_EQ(Error("a.mat", "m:2"), "no error");
    const std::string bytes = ReadBytes(folder_ / "a.mat");
    folder_.Write("cut.mat", bytes.substr(0, 1500));
    for (const char* name : {"q", "m:2"}) {
      EXPECT_EQ(Error("cut.mat", name),
                version == MAT_FT_MAT5
                    ? "cut.mat: a truncated MATLAB file of 1500 bytes, expected 1832 or more"
                    : "cut.mat: no variables, expected some: an empty or a truncated file");
    }
  }
}

TEST_F(ArrayErrors, Hdf5) {
  const hid_t file = H5Fcreate((folder_ / "a.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  std::vector<double> wave = Wave(100);
  wave[89] = HUGE_VAL;
  AddDataset(file, "/run/p", {100}, wave);
  AddDataset(file, "/run/q", {99}, Wave(99));
  AddDataset(file, "/m", {100, 2}, Wave(200));
  AddDataset(file, "/n", {100, 2}, Wave(200));
  AddDataset(file, "/cube", {10, 5, 2}, Wave(100));
  const hid_t complex = H5Tcreate(H5T_COMPOUND, 16);
  H5Tinsert(complex, "r", 0, H5T_NATIVE_DOUBLE);
  H5Tinsert(complex, "i", 8, H5T_NATIVE_DOUBLE);
  const hsize_t size = 100;
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  H5Dclose(H5Dcreate2(file, "/z", complex, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(space);
  H5Tclose(complex);
  H5Fclose(file);
  EXPECT_EQ(Error("a.h5", "x"),
            "a.h5: x: no such variable, expected one of cube (3 dimensions), m (100 x 2), n (100 x "
            "2), run/p (100 x 1), run/q (99 x 1), z (complex or compound)");
  EXPECT_EQ(Error("a.h5", "z"), "a.h5: z: complex or compound, expected real numbers");
  EXPECT_EQ(Error("a.h5", "cube"), "a.h5: cube: 3 dimensions, expected real numbers");
  EXPECT_THAT(Error("a.h5", "2"), testing::HasSubstr("more than one matrix, expected NAME:2 of"));
  EXPECT_EQ(Error("a.h5", "run/p"), "a.h5: run/p: sample 90: inf, expected a finite number");
  EXPECT_EQ(ErrorOf({.file = folder_ / "a.h5",
                     .pressure = "m:1",
                     .heat_release = "run/q",
                     .sampling_hz = 1.0}),
            "a.h5: run/q: 99 samples, expected 100 as in m:1");
  const std::string bytes = ReadBytes(folder_ / "a.h5");
  folder_.Write("cut.h5", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(Error("cut.h5", "run/p"), "cut.h5: truncated or damaged, expected an HDF5 file");
}

}  // namespace
}  // namespace howl::records_error_test
