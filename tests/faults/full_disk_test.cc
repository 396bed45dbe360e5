// Disks that are full, from the first byte to the last: one line that names the file, only whole
// files, and the same bytes once there is room.
#include <map>

#include "tests/faults/faults.h"

namespace howl::full_disk_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A file system in memory of a given size; needs the right to mount one.
class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& folder) : folder_(folder) {
    fs::create_directory(folder);
    is_mounted_ = Run("mount -t tmpfs -o size=1m tmpfs " + folder_.string());
  }
  ~SmallDisk() {
    if (is_mounted_) Run("umount " + folder_.string());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_mounted() const { return is_mounted_; }
  void Resize(int kilobytes) const {
    ASSERT_TRUE(
        Run("mount -o remount,size=" + std::to_string(kilobytes) + "k " + folder_.string()));
  }

 private:
  static bool Run(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
  }
  fs::path folder_;
  bool is_mounted_ = false;
};

std::map<std::string, std::string> FilesIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).string()] = ReadFile(entry.path());
    }
  }
  return files;
}

class FullDisk : public Faults {
 protected:
  // Runs the command on disks of growing size until one is large enough.
  void ExpectAllOrNothing(const std::string& command, const std::string& options = "") {
    SCOPED_TRACE(command);
    ASSERT_EQ(RunShell(Howl(command, command + "_peace", options)).status, 0);
    const auto whole = FilesIn(Path(command + "_peace"));
    ASSERT_FALSE(whole.empty());
    const SmallDisk disk(Path(command + "_disk"));
    if (!disk.is_mounted()) GTEST_SKIP() << "no file system can be mounted here";
    const std::string out = command + "_disk/out";
    int refused = 0;
    for (int kilobytes = 4; kilobytes < 16384; kilobytes *= 2) {
      disk.Resize(kilobytes);
      const ProgramResult run = RunShell(Howl(command, out, options));
      if (run.status == 0) break;
      ++refused;
      ExpectOneLine(run, "No space left on device");
      EXPECT_THAT(run.err, HasSubstr(Path(out).string()));
      if (!fs::exists(Path(out))) continue;
      for (const auto& [name, bytes] : FilesIn(Path(out))) {
        if (name.ends_with(".state")) continue;  // what the next run goes on from
        EXPECT_TRUE(whole.contains(name)) << name;
        if (!whole.contains(name)) continue;
        EXPECT_EQ(bytes, whole.at(name)) << name;
      }
    }
    EXPECT_GT(refused, 0);
    EXPECT_EQ(FilesIn(Path(out)), whole);
  }
};

TEST_F(FullDisk, Fit) { ExpectAllOrNothing("fit"); }
TEST_F(FullDisk, Simulate) { ExpectAllOrNothing("simulate"); }
TEST_F(FullDisk, Family) { ExpectAllOrNothing("family", "--save-every 0.001"); }
TEST_F(FullDisk, Analyse) {
  ASSERT_EQ(RunShell(Howl("simulate", "records")).status, 0);
  config_ = (Path("records") / "records.yaml").string();
  ExpectAllOrNothing("analyse");
}
// The fault of a rig stands in its row; run again, the campaign has that rig again.
TEST_F(FullDisk, Campaign) {
  config_ = folder_
                .Write("campaign.yaml",
                       "configs: [rig.yaml]\ngrid: {\"experiments[0].gain\": [11, 12]}\n"
                       "commands: [simulate, fit]\n")
                .string();
  ASSERT_EQ(RunShell(Howl("campaign", "peace")).status, 0);
  const SmallDisk disk(Path("disk"));
  if (!disk.is_mounted()) GTEST_SKIP() << "no file system can be mounted here";
  disk.Resize(200);
  EXPECT_EQ(RunShell(Howl("campaign", "disk/out")).status, 1);
  EXPECT_THAT(ReadFile(Path("disk/out/campaign.csv")), HasSubstr("No space left on device"));
  disk.Resize(16384);
  EXPECT_EQ(RunShell(Howl("campaign", "disk/out")).status, 0);
  EXPECT_EQ(ReadFile(Path("disk/out/campaign.csv")), ReadFile(Path("peace/campaign.csv")));
}

// The limit of a file's size, as a quota is: no signal ends the program.
TEST_F(FullDisk, AFileThatMayNotGrow) {
  const ProgramResult run = RunShell("ulimit -f 8; exec " + Howl("simulate", "out"));
  ExpectOneLine(run, "exp1.csv: cannot be written: File too large");
  EXPECT_FALSE(fs::exists(Path("out")));
}

}  // namespace
}  // namespace howl::full_disk_test
