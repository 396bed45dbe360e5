// Configs, records and results that someone made to do harm: nothing is run, nothing is written
// outside of --out, nothing of the environment is told but what the config names, and a small file
// takes little time and memory.
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/faults/faults.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

constexpr const char* kSecret = "HOWL_SECRET=value_of_the_secret ";

class Hostile : public Faults {
 protected:
  // The small problem with a first experiment of this name and a title that has it too.
  void WriteNamed(const std::string& name) {
    Json config = {
        {"title", "${HOWL_SECRET}"},
        {"experiments",
         {{{"name", name}, {"phi", 0.56}, {"frequency_hz", 212}, {"phase_deg", -8}, {"gain", 12}},
          {{"name", "e2"},
           {"phi", 0.60},
           {"frequency_hz", 214},
           {"phase_deg", -10},
           {"gain", 11}}}},
        {"simulate", {{"duration_s", 0.5}, {"sampling_hz", 5000}}},
        {"family", {{"members", 3}, {"width", 0.3}}}};
    folder_.Write("rig.yaml", config.dump());  // JSON is YAML
  }
  // What is in the folder beside the config and the output.
  std::size_t Others(const std::string& out) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      count += name != out && name != "rig.yaml" ? 1 : 0;
    }
    return count;
  }
};

TEST_F(Hostile, NamesThatArePathsOrMarkupAreRefused) {
  for (const char* const name :
       {"a/b", "../up", "/abs", "it's", "say \"a\"", "two\nlines", "<script>x</script>", "a,b",
        "{/Symbol a}", ".hidden", "a\\b", "system('touch ran')", "a${HOWL_SECRET}", "tab\there",
        "esc\x1b[2J"}) {
    WriteNamed(name);
    const ProgramResult run = RunShell(kSecret + Howl("simulate", "out"));
    EXPECT_EQ(run.status, 2) << name;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("experiments[0].name: "));
    EXPECT_THAT(run.err, Not(HasSubstr("value_of_the_secret")));
    EXPECT_EQ(Others("out"), 0U) << name;
    EXPECT_FALSE(fs::exists(Path("out"))) << name;
  }
}

// All that a name may have goes through the commands, gnuplot and the page.
TEST_F(Hostile, NamesThatAreAllowedDoNothing) {
  WriteNamed("%s%n%d");
  Json config = Json::parse(ReadFile(Path("rig.yaml")));
  for (const char* const name : {"`touch ran`", "$(touch ran)", "@{x}^2_{y}", "-x", "]]>", "#c",
                                 "a&b;c", "*", "\u202eabc"}) {
    config["experiments"].push_back(config["experiments"][0]);
    config["experiments"].back()["name"] = name;
  }
  const std::string at = "cd " + folder_.path().string() + "; " + kSecret;
  for (const char* const command : {"family", "fit", "simulate"}) {
    const ProgramResult run = RunShell(at + Howl(command, "out"));
    EXPECT_EQ(run.status, 0) << run.err;
    folder_.Write("rig.yaml", config.dump());  // the family is of two experiments, to be quick
  }
  const ProgramResult report = RunShell(at + HOWL_PROGRAM + " report " + Path("out").string());
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_THAT(report.out, Not(HasSubstr("could not draw")));
  EXPECT_EQ(Others("out"), 0U);
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(Path("out"))) {
    if (entry.is_regular_file()) all += ReadFile(entry.path());
  }
  EXPECT_THAT(all, HasSubstr("touch ran"));
  EXPECT_THAT(all, Not(HasSubstr("value_of_the_secret")));
}

TEST_F(Hostile, ResultsAreTextOnThePage) {
  WriteNamed("e1");
  for (const char* const command : {"fit", "simulate"}) {
    ASSERT_EQ(RunShell(Howl(command, "out")).status, 0);
  }
  const std::string evil = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'";
  Json solution = Json::parse(ReadFile(Path("out") / "solution.json"));
  solution["experiments"][0]["name"] = evil;
  solution["termination"] = evil;
  folder_.Write("out/solution.json", solution.dump());
  Json run = Json::parse(ReadFile(Path("out") / "run.json"));
  run["config_text"] = "title: \"" + evil.substr(0, evil.size() - 2) + "\"\n" +
                       run["config_text"].get<std::string>();
  run["config"] = "/gone/" + evil;
  run["commands"][evil] = {{"seed", 1}, {"version", evil}};
  folder_.Write("out/run.json", run.dump());
  ASSERT_EQ(RunShell(std::string(HOWL_PROGRAM) + " report " + Path("out").string()).status, 0);
  const std::string page = ReadFile(Path("out") / "report.html");
  EXPECT_THAT(page, HasSubstr("alert(1)"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
}

TEST_F(Hostile, AVariableOfTheEnvironmentIsReadWhereTheConfigNamesAFileAlone) {
  folder_.Write(
      "rig.yaml",
      "title: \"${HOWL_SECRET}\"\n"
      "experiments: [{name: e1, phi: 0.5, record: {file: \"${HOWL_SECRET}/r.csv\", pressure: "
      "\"${HOWL_SECRET}\", sampling_hz: 5000}}]\n");
  const ProgramResult run = RunShell(kSecret + Howl("analyse", "out"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("there is no file \"${HOWL_SECRET}/r.csv\""));
  EXPECT_THAT(run.err, Not(HasSubstr("value_of_the_secret")));
}

// A small file that asks for much: refused within a second or two and a little memory.
class Bomb : public Hostile {
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

TEST_F(Bomb, OfNesting) {
  folder_.Write("rig.yaml", "experiments: " + std::string(1000, '[') + std::string(1000, ']'));
  ExpectRefused("check", "nested more than");
  std::string maps = "experiments:\n";
  for (int i = 0; i < 400; ++i) maps += std::string(static_cast<std::size_t>(i), ' ') + " a:\n";
  folder_.Write("rig.yaml", maps);
  ExpectRefused("check", "nested more than");
}

TEST_F(Bomb, OfLines) {
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
  const auto make = [&](std::vector<hsize_t> sizes, std::vector<hsize_t> chunk) {
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
}  // namespace howl
