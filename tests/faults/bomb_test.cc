// Small files that ask for much: configs, gzip, HDF5.
#include <hdf5.h>
#include <sys/resource.h>

#include <vector>

#include "tests/faults/faults.h"

namespace howl::bomb_test {
namespace {

namespace fs = std::filesystem;

// A small file that asks for much: refused within a second or two and a little memory.
class Bomb : public Faults {
 protected:
  static constexpr double kMostSeconds = 5.0;
  static constexpr long kMostMegabytes = 1000;

  void ExpectRefused(const std::string& command, const std::string& what) {
    const auto used = [] {
      rusage all{};
      getrusage(RUSAGE_CHILDREN, &all);
      return all;
    };
    const auto cpu_seconds = [](const rusage& all) {
      return static_cast<double>(all.ru_utime.tv_sec + all.ru_stime.tv_sec) +
             1e-6 * static_cast<double>(all.ru_utime.tv_usec + all.ru_stime.tv_usec);
    };
    const rusage before = used();
    const ProgramResult run = RunShell(Howl(command, "out"));
    const rusage after = used();
    ExpectOneLine(run, what);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(cpu_seconds(after) - cpu_seconds(before), kMostSeconds);
    EXPECT_LT(after.ru_maxrss / 1000, kMostMegabytes);  // of the largest child so far, in kB
#endif
  }
  void RecordIs(const std::string& file) {
    folder_.Write("rig.yaml", "experiments: [{name: e1, phi: 0.5, record: {file: " + file +
                                  ", pressure: p, heat_release: q, sampling_hz: 5000}}]\n");
  }
};

TEST_F(Bomb, OfAliases) {
  std::string text = "a: &a [x, x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c <= 'z'; ++c) {
    const std::string before = "*" + std::string(1, static_cast<char>(c - 1));
    text += std::string(1, c) + ": &" + c + " [" + before;
    for (int i = 0; i < 9; ++i) text += ", " + before;
    text += "]\n";
  }
  folder_.Write("rig.yaml", text);
  ExpectRefused("check", "aliases make more than");
}

TEST_F(Bomb, OfAliasesOfOneLongText) {
  // 120000 values are allowed, and 4 kB of text: together they are half a gigabyte.
  std::string text = "a: &a " + std::string(4000, 'x') + "\nb:\n";
  for (int line = 0; line < 3; ++line) {
    text += "  - [";
    for (int i = 0; i < 40'000; ++i) text += "*a,";
    text += "]\n";
  }
  folder_.Write("rig.yaml", text);
  ExpectRefused("check", "aliases make more than 4 MB of text");
}

TEST_F(Bomb, OfKeys) {
  std::string some;
  std::string effect;
  for (int i = 0; i < 60'000; ++i) {
    const std::string key = "k" + std::to_string(i);
    some += "  " + key + ": 1\n";
    effect += "      " + key + ": []\n";
  }
  folder_.Write("rig.yaml", "a: &a\n" + some + "b:\n  <<: *a\n");
  ExpectRefused("check", "a mapping of more than 2000 keys");
  // The one mapping of a config whose keys are free.
  folder_.Write("rig.yaml", "effects:\n  - name: e\n    at: delay\n    parameters:\n" + effect);
  ExpectRefused("check", "a mapping of more than 2000 keys");
}

TEST_F(Bomb, OfUnknownKeys) {
  std::string text = "experiments:\n";
  for (int i = 0; i < 40; ++i) {
    text += "  - {";
    for (int k = 0; k < 1'900; ++k) text += "frequency_hz_" + std::to_string(k) + ": 1, ";
    text += "}\n";
  }
  folder_.Write("rig.yaml", text);
  ExpectRefused("fit", "is not a known key");
}

TEST_F(Bomb, OfAxes) {
  std::string text = "config: rig.yaml\ngrid:\n";
  for (int i = 0; i < 20; ++i) {
    text += "  a" + std::to_string(i) + ": {from: 1, to: 100000}\n";
  }
  folder_.Write("rig.yaml", text);
  ExpectRefused("campaign", "grid.a1: makes more than a million rigs");
}

TEST_F(Bomb, OfColumns) {
  const auto row = [](int columns) {
    std::string text = "1";
    for (int i = 1; i < columns; ++i) text += ",1";
    return text + "\n";
  };
  RecordIs("r.csv");
  folder_.Write("r.csv", row(10'000'000));
  ExpectRefused("analyse", "a line of more than 1 MiB");
  folder_.Write("r.csv", row(100'000) + row(100'000));
  ExpectRefused("analyse", "a row of 100000 columns, expected at most 5000");
}

TEST_F(Bomb, OfNesting) {
  folder_.Write("rig.yaml", "experiments: " + std::string(1000, '[') + std::string(1000, ']'));
  ExpectRefused("check", "nested more than");
  std::string maps = "experiments:\n";
  for (int i = 0; i < 400; ++i) maps += std::string(static_cast<std::size_t>(i), ' ') + " a:\n";
  folder_.Write("rig.yaml", maps);
  ExpectRefused("check", "nested more than");
}

TEST_F(Bomb, OfLines) {
  // NOLINTNEXTLINE(bugprone-string-constructor): a file as long as this is meant.
  folder_.Write("rig.yaml", std::string(30'000'000, '\n'));
  ExpectRefused("check", "larger than");
}

TEST_F(Bomb, OfGzip) {
  for (const char* const row : {"1,2", "", "%"}) {
    ASSERT_EQ(RunShell("(echo p,q; yes '" + std::string(row) + "' | head -c 300000000) | gzip >" +
                       Path("r.csv.gz").string())
                  .status,
              0);
    RecordIs("r.csv.gz");
    ExpectRefused("analyse", "unpacks to more than 200 times its size");
  }
}

class Hdf5File {
 public:
  explicit Hdf5File(const fs::path& path)
      : id_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~Hdf5File() { H5Fclose(id_); }
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  // A data set of which nothing is stored.
  void Add(const char* name, std::vector<hsize_t> sizes, std::vector<hsize_t> chunk) const {
    const int rank = static_cast<int>(sizes.size());
    const hid_t space = H5Screate_simple(rank, sizes.data(), nullptr);
    const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(plan, rank, chunk.data());
    H5Pset_deflate(plan, 9);
    H5Dclose(H5Dcreate2(id_, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, plan, H5P_DEFAULT));
    H5Pclose(plan);
    H5Sclose(space);
  }

 private:
  hid_t id_;
};

TEST_F(Bomb, OfHdf5) {
  constexpr hsize_t kMillion = 1'000'000;
  RecordIs("r.h5");
  const auto make = [&](const std::vector<hsize_t>& sizes, const std::vector<hsize_t>& chunk) {
    const Hdf5File file(Path("r.h5"));
    file.Add("p", sizes, chunk);
    file.Add("q", sizes, chunk);
  };
  // Many samples; samples that do not fit into any memory; few, in a chunk of gigabytes.
  make({100 * kMillion}, {1000});
  ExpectRefused("analyse", "unpacks to more than 200 times its size");
  make({1000 * kMillion * kMillion}, {1000});
  ExpectRefused("analyse", "do not fit into the memory");
  make({40 * kMillion}, {40 * kMillion});
  ExpectRefused("analyse", "unpacks to more than 200 times its size");
  // As many channels as samples.
  make({kMillion, kMillion}, {1000, 1000});
  const ProgramResult run =
      RunShell("cd " + folder_.path().string() + "; " + HOWL_PROGRAM + " init r.h5");
  ExpectOneLine(run, "has no column of numbers");
}

}  // namespace
}  // namespace howl::bomb_test
