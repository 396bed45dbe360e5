// Runs the program as a user does: exit status, standard output and standard error.
#ifndef HOWL_TESTS_APP_PROGRAM_H_
#define HOWL_TESTS_APP_PROGRAM_H_

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>

namespace howl {

// A folder of its own for each test, removed with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string form = (std::filesystem::temp_directory_path() / "howl_test_XXXXXX").string();
    path_ = mkdtemp(form.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path Write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  return content.str();
}

struct ProgramResult {
  int status = -1;
  std::string out;
  std::string err;
};

// `arguments` go through the shell.
inline ProgramResult RunHowl(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command = std::string(HOWL_PROGRAM) + " " + arguments + " >" +
                              (folder.path() / "out").string() + " 2>" +
                              (folder.path() / "err").string();
  const int raw = std::system(command.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, ReadFile(folder.path() / "out"),
          ReadFile(folder.path() / "err")};
}

// Starts the program and does not wait for it; it and what it starts are a process group, which has
// the number that is returned. `arguments` go through the shell.
inline pid_t StartHowl(const std::string& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  setpgid(0, 0);
  const std::string line = "exec " + std::string(HOWL_PROGRAM) + " " + arguments;
  execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
  _exit(127);
}

// True once `holds`, false after a minute.
inline bool WaitUntil(const std::function<bool()>& holds) {
  for (int i = 0; i < 12000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

inline std::string Config(const std::string& name) {
  return std::string(HOWL_SOURCE_DIR) + "/configs/" + name + ".yaml";
}

}  // namespace howl

#endif  // HOWL_TESTS_APP_PROGRAM_H_
