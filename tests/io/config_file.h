// A config written to a folder of its own, gone with the object.
#ifndef HOWL_TESTS_IO_CONFIG_FILE_H_
#define HOWL_TESTS_IO_CONFIG_FILE_H_

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/user_error.h"

namespace howl {

class ConfigFile {
 public:
  explicit ConfigFile(const std::string& text)
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("howl_config_" + std::to_string(getpid()) + "_" + std::to_string(counter_++))) {
    std::filesystem::create_directories(folder_);
    Write("config.yaml", text);
  }
  ~ConfigFile() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;

  const std::filesystem::path& Folder() const { return folder_; }
  std::filesystem::path Path() const { return folder_ / "config.yaml"; }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  // The message of the mistake in the config; empty when it has none.
  std::string Mistake() const {
    try {
      LoadConfig(Path());
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }

 private:
  static inline int counter_ = 0;
  std::filesystem::path folder_;
};

}  // namespace howl

#endif  // HOWL_TESTS_IO_CONFIG_FILE_H_
