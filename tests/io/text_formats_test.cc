// One record in every form that a reader takes gives the same bits.
#include <bit>
#include <charconv>
#include <cstring>
#include <functional>
#include <random>
#include <utility>

#include "io/records/columns/number_text.h"
#include "tests/io/record_files.h"

namespace howl::text_formats_test {
namespace {

constexpr std::size_t kRows = 400;
constexpr double kRateHz = 10000.0;

struct Samples {
  std::vector<double> t, p, q;
};

// Numbers of all magnitudes, with as many digits as a double has.
Samples MakeSamples() {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Samples samples;
  for (std::size_t i = 0; i < kRows; ++i) {
    samples.t.push_back(static_cast<double>(i) / kRateHz);
    samples.p.push_back(normal(random) * std::pow(10.0, normal(random)));
    samples.q.push_back(3.0 + normal(random));
  }
  return samples;
}

std::string Number(double value, bool comma = false) {
  std::string text = NumberText(value);
  if (comma && text.find('.') != std::string::npos) text[text.find('.')] = ',';
  return text;
}

std::string Table(const Samples& samples, const std::string& head, const std::string& separator,
                  bool comma = false, const std::string& line_end = "\n", double time_scale = 1.0) {
  std::string text = head;
  for (std::size_t i = 0; i < kRows; ++i) {
    text += Number(samples.t[i] * time_scale, comma) + separator + Number(samples.p[i], comma) +
            separator + Number(samples.q[i], comma) + line_end;
  }
  return text;
}

// Ascii alone.
std::string Utf16(const std::string& text, bool little_endian, bool mark) {
  std::string bytes = !mark ? "" : little_endian ? "\xff\xfe" : "\xfe\xff";
  for (const char c : text) {
    bytes += little_endian ? std::string({c, '\0'}) : std::string({'\0', c});
  }
  return bytes;
}

std::string Labview(const Samples& samples, bool comma, bool has_times) {
  std::string text =
      "LabVIEW Measurement\t\r\nWriter_Version\t2\r\nReader_Version\t2\r\n"
      "Separator\tTab\r\nDecimal_Separator\t";
  text += std::string(comma ? "," : ".") + "\r\nMulti_Headings\tYes\r\nX_Columns\t" +
          (has_times ? "One" : "No") +
          "\r\nTime_Pref\tAbsolute\r\nDate\t2015/02/09\r\n***End_of_Header***\t\r\n\t\r\n"
          "Channels\t2\t\t\r\nSamples\t400\t400\t\r\nX_Dimension\tTime\tTime\t\r\n"
          "X0\t0,0000000000000000E+0\t0,0000000000000000E+0\t\r\n"
          "Delta_X\t1.000000E-4\t1.000000E-4\t\r\n***End_of_Header***\t\t\t\r\n"
          "X_Value\tPressure\tPMT\tComment\r\n";
  for (std::size_t i = 0; i < kRows; ++i) {
    text += (has_times ? Number(samples.t[i], comma) : "") + "\t" + Number(samples.p[i], comma) +
            "\t" + Number(samples.q[i], comma) + (i == 0 ? "\tstarted by hand" : "") + "\r\n";
  }
  return text;
}

matvar_t* Column(const char* name, const std::vector<double>& values) {
  std::size_t sizes[2] = {values.size(), 1};
  return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sizes,
                       const_cast<double*>(values.data()), 0);
}

std::filesystem::path WriteStruct(const std::filesystem::path& path, const Samples& samples,
                                  mat_ft version, matio_compression packing) {
  mat_t* const mat = Mat_CreateVer(path.c_str(), nullptr, version);
  const char* inner_names[] = {"p", "q"};
  std::size_t one[2] = {1, 1};
  matvar_t* const inner = Mat_VarCreateStruct("run", 2, one, inner_names, 2);
  Mat_VarSetStructFieldByName(inner, "p", 0, Column("p", samples.p));
  Mat_VarSetStructFieldByName(inner, "q", 0, Column("q", samples.q));
  const char* names[] = {"t", "run"};
  matvar_t* const record = Mat_VarCreateStruct("rec", 2, one, names, 2);
  Mat_VarSetStructFieldByName(record, "t", 0, Column("t", samples.t));
  Mat_VarSetStructFieldByName(record, "run", 0, inner);
  EXPECT_EQ(Mat_VarWrite(mat, record, packing), 0);
  Mat_VarFree(record);
  Mat_Close(mat);
  return path;
}

struct Form {
  std::string name;
  std::function<RecordSpec(const TemporaryFolder&, const Samples&)> write;
};

RecordSpec Columns(std::filesystem::path file, const char* t = "1", const char* p = "2",
                   const char* q = "3") {
  RecordSpec spec;
  spec.file = std::move(file);
  spec.time = t;
  spec.pressure = p;
  spec.heat_release = q;
  return spec;
}

// How a program other than MATLAB writes a variable's class.
enum class ClassText { kWithoutZero, kOfVariableLength, kOnlyOneWithoutZero, kAbsent };

void WriteClass(hid_t object, const char* name, bool with_zero, bool variable_length) {
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, variable_length ? H5T_VARIABLE : std::strlen(name) + (with_zero ? 1 : 0));
  H5Tset_strpad(text, with_zero || variable_length ? H5T_STR_NULLTERM : H5T_STR_NULLPAD);
  const hid_t scalar = H5Screate(H5S_SCALAR);
  const hid_t own = H5Acreate2(object, "MATLAB_class", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
  const void* const value = variable_length ? static_cast<const void*>(&name) : name;
  EXPECT_GE(H5Awrite(own, text, value), 0);
  H5Aclose(own);
  H5Sclose(scalar);
  H5Tclose(text);
}

// As h5py and hdf5storage write it; the variables at the root, or the fields of a struct.
RecordSpec WriteForeignMatlab73(const TemporaryFolder& folder, const Samples& samples,
                                ClassText kind, bool is_struct) {
  constexpr hsize_t kHeaderBytes = 512;
  const std::string path = (folder / "a.mat").string();
  const hid_t how = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(how, kHeaderBytes);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, how, H5P_DEFAULT);
  H5Pclose(how);
  const std::string place = is_struct ? "rec/" : "";
  for (const auto& [name, values] :
       {std::pair("t", &samples.t), {"p", &samples.p}, {"q", &samples.q}}) {
    AddDataset(file, (place + name).c_str(), {1, kRows}, *values);
    const hid_t data = H5Dopen2(file, (place + name).c_str(), H5P_DEFAULT);
    const bool with_zero = kind == ClassText::kOnlyOneWithoutZero && *name != 'q';
    if (kind != ClassText::kAbsent)
      WriteClass(data, "double", with_zero, kind == ClassText::kOfVariableLength);
    H5Dclose(data);
  }
  if (is_struct && kind != ClassText::kAbsent) {
    const hid_t group = H5Gopen2(file, "rec", H5P_DEFAULT);
    WriteClass(group, "struct", false, kind == ClassText::kOfVariableLength);
    H5Gclose(group);
  }
  H5Fclose(file);
  std::string header = "MATLAB 7.3 MAT-file, by a test";
  header.resize(124, ' ');
  header += std::string("\x00\x02IM", 4);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << header;
  const std::string dotted = is_struct ? "rec." : "";
  return Columns(path, (dotted + "t").c_str(), (dotted + "p").c_str(), (dotted + "q").c_str());
}

std::vector<Form> Forms() {
  const auto text = [](std::string name, std::function<std::string(const Samples&)> content,
                       std::function<void(RecordSpec&)> state = {}) {
    return Form{std::move(name), [content = std::move(content), state = std::move(state)](
                                     const TemporaryFolder& folder, const Samples& samples) {
                  RecordSpec spec = Columns(folder.Write("data", content(samples)));
                  if (state) state(spec);
                  return spec;
                }};
  };
  const auto comma = [](RecordSpec& spec) { spec.dialect.decimal_comma = true; };
  const auto skip3 = [](RecordSpec& spec) { spec.dialect.skip_rows = 3; };
  std::vector<Form> forms = {
      text("white space", [](const Samples& s) { return Table(s, "", "  "); }),
      text("tabs, CRLF",
           [](const Samples& s) { return Table(s, "t\tp\tq\r\n", "\t", false, "\r\n"); }),
      text("commas", [](const Samples& s) { return Table(s, "t,p,q\n", ","); }),
      text(
          "semicolons, decimal commas",
          [](const Samples& s) { return Table(s, "t;p;q\n", ";", true); }, comma),
      text(
          "blanks, decimal commas", [](const Samples& s) { return Table(s, "", " ", true); },
          comma),
      text(
          "tabs, decimal commas",
          [](const Samples& s) { return Table(s, "t [s]\tp [Pa]\tq [V]\n", "\t", true); }, comma),
      text("units row", [](const Samples& s) { return Table(s, "t,p,q\ns,Pa,\n", ","); }),
      text("units row that has the unit of time",
           [](const Samples& s) { return Table(s, "t;p;q\n[ms];;V\n", ";", false, "\n", 1e3); }),
      text(
          "skipped rows",
          [](const Samples& s) {
            return Table(s, "Rig A, run 3\n2015-02-09;1\n\"x\"\nt p q\n", " ");
          },
          skip3),
      text(
          "time_unit", [](const Samples& s) { return Table(s, "t,p,q\n", ",", false, "\n", 1e3); },
          [](RecordSpec& spec) { spec.time_unit_s = 1e-3; }),
      text("UTF-16, little endian",
           [](const Samples& s) {
             return Utf16(Table(s, "t\tp\tq\r\n", "\t", false, "\r\n"), true, true);
           }),
      text("UTF-16, big endian",
           [](const Samples& s) { return Utf16(Table(s, "t,p,q\n", ","), false, true); }),
      text("UTF-16 without its mark",
           [](const Samples& s) { return Utf16(Table(s, "t,p,q\n", ","), true, false); }),
      text("LabVIEW", [](const Samples& s) { return Labview(s, false, true); }),
      text("LabVIEW, decimal commas", [](const Samples& s) { return Labview(s, true, true); }),
      text(
          "LabVIEW without times", [](const Samples& s) { return Labview(s, true, false); },
          [](RecordSpec& spec) {
            spec.time.reset();
            spec.sampling_hz = kRateHz;
            spec.pressure = "Pressure";
            spec.heat_release = "PMT";
          })};
  forms.push_back({"gzip", [](const TemporaryFolder& folder, const Samples& s) {
                     return Columns(WriteGzip(folder / "a.gz", Table(s, "", " ")));
                   }});
  forms.push_back({"UTF-16 in gzip", [](const TemporaryFolder& folder, const Samples& s) {
                     return Columns(
                         WriteGzip(folder / "a.gz", Utf16(Table(s, "", "\t"), true, true)));
                   }});
  for (const auto& [name, version, packing] :
       {std::tuple("MATLAB 5", MAT_FT_MAT5, MAT_COMPRESSION_NONE),
        std::tuple("MATLAB 5, packed", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB),
        std::tuple("MATLAB 7.3", MAT_FT_MAT73, MAT_COMPRESSION_NONE)}) {
    forms.push_back({name, [version = version, packing = packing](const TemporaryFolder& folder,
                                                                  const Samples& s) {
                       mat_t* const mat =
                           Mat_CreateVer((folder / "a.mat").c_str(), nullptr, version);
                       AddMatVariable(mat, "t", kRows, 1, s.t, packing);
                       AddMatVariable(mat, "p", 1, kRows, s.p, packing);
                       AddMatVariable(mat, "q", kRows, 1, s.q, packing);
                       Mat_Close(mat);
                       return Columns(folder / "a.mat", "t", "p", "q");
                     }});
    forms.push_back(
        {std::string(name) + ", a struct",
         [version = version, packing = packing](const TemporaryFolder& folder, const Samples& s) {
           return Columns(WriteStruct(folder / "a.mat", s, version, packing), "rec.t", "rec.run.p",
                          "rec.run.q");
         }});
  }
  forms.push_back({"HDF5", [](const TemporaryFolder& folder, const Samples& s) {
                     const hid_t file = H5Fcreate((folder / "a.h5").c_str(), H5F_ACC_TRUNC,
                                                  H5P_DEFAULT, H5P_DEFAULT);
                     AddDataset(file, "/t", {kRows}, s.t);
                     AddDataset(file, "/run/p", {kRows}, s.p);
                     AddDataset(file, "/run/q", {kRows, 1}, s.q);
                     H5Fclose(file);
                     return Columns(folder / "a.h5", "t", "run/p", "run/q");
                   }});
  for (const auto& [name, kind] : {std::pair("without a final zero", ClassText::kWithoutZero),
                                   {"of variable length", ClassText::kOfVariableLength},
                                   {"once without a final zero", ClassText::kOnlyOneWithoutZero},
                                   {"absent", ClassText::kAbsent}}) {
    for (const bool is_struct : {false, true}) {
      forms.push_back(
          {std::string("MATLAB 7.3, its class ") + name + (is_struct ? ", a struct" : ""),
           [kind = kind, is_struct](const TemporaryFolder& folder, const Samples& s) {
             return WriteForeignMatlab73(folder, s, kind, is_struct);
           }});
    }
  }
  return forms;
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

TEST(TextFormats, OneRecordGivesTheSameBitsInEveryForm) {
  const Samples samples = MakeSamples();
  for (const Form& form : Forms()) {
    const TemporaryFolder folder;
    const RecordSpec spec = form.write(folder, samples);
    ASSERT_EQ(ErrorOf(spec), "no error") << form.name;
    const Record record = LoadRecord(spec, "rig.yaml", 7);
    EXPECT_EQ(record.sampling_hz, kRateHz) << form.name;
    EXPECT_TRUE(SameBits(record.pressure, samples.p)) << form.name;
    EXPECT_TRUE(SameBits(record.heat_release, samples.q)) << form.name;
  }
}

TEST(TextFormats, AMessageSaysWhichKeyWouldMakeATableOfIt) {
  const Samples samples = MakeSamples();
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    return ErrorOf(Columns(folder.Write("a.csv", text)));
  };
  EXPECT_THAT(error(Table(samples, "t;p;q\n", ";", true)), testing::HasSubstr("decimal: \",\""));
  EXPECT_THAT(error(Table(samples, "", " ", true)), testing::HasSubstr("decimal: \",\""));
  EXPECT_THAT(error(Table(samples, "Rig A, run 3\nt p q\n", " ")),
              testing::HasSubstr("skip_rows: 1 in the record"));
  EXPECT_THAT(error(Table(samples, "t;p;q\n", " ")), testing::HasSubstr("skip_rows: 1"));
  // The other way round.
  RecordSpec spec = Columns(folder.Write("b.csv", Table(samples, "t;p;q\n", ",")));
  spec.dialect.decimal_comma = true;
  EXPECT_THAT(ErrorOf(spec), testing::HasSubstr("decimal: \".\""));
}

TEST(TextFormats, KeysOfTextAreNoneOfOtherFiles) {
  const Samples samples = MakeSamples();
  const TemporaryFolder folder;
  RecordSpec spec =
      Columns(WriteStruct(folder / "a.mat", samples, MAT_FT_MAT5, MAT_COMPRESSION_NONE), "rec.t",
              "rec.run.p", "rec.run.q");
  spec.dialect.skip_rows = 2;
  EXPECT_EQ(ErrorOf(spec),
            "a.mat: skip_rows: is of text files, and this is a MATLAB file, expected the record "
            "without it");
  spec.dialect = {};
  spec.pressure = "rec.p";
  EXPECT_THAT(ErrorOf(spec), testing::HasSubstr("rec.run.p (400 x 1)"));
}

TEST(TextFormats, SkippingMoreThanThereIsIsSaid) {
  const TemporaryFolder folder;
  RecordSpec spec = Columns(folder.Write("a.csv", "1 2 3\n4 5 6\n"));
  spec.dialect.skip_rows = 9;
  EXPECT_EQ(ErrorOf(spec), "a.csv: skip_rows: 9 leaves nothing of 2 lines, expected fewer");
}

}  // namespace
}  // namespace howl::text_formats_test
