// run.json, schema howl.run/1: the runs in an output folder, so that a report can find the config.
//
//   {"schema": "howl.run/1", "config": "/path/of/r228.yaml", "config_text": "...",
//    "commands": {"fit": {"seed": 1, "version": "0.1.0"}, ...}}
//
// Commands that ran another config in the same folder before are forgotten.
#ifndef HOWL_IO_REPORT_RUN_FILE_H_
#define HOWL_IO_REPORT_RUN_FILE_H_

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace howl {

struct RunFile {
  struct Entry {
    std::uint64_t seed = 0;
    std::string version;
  };
  std::filesystem::path config;  // absolute
  std::string config_text;
  std::map<std::string, Entry> commands;
};

// Throws std::runtime_error saying what is wrong with it.
RunFile ReadRunFile(const std::filesystem::path& folder);

// Adds one command to folder/run.json.
void NoteRun(const std::filesystem::path& folder, const std::filesystem::path& config,
             const std::string& command, std::uint64_t seed);

}  // namespace howl

#endif  // HOWL_IO_REPORT_RUN_FILE_H_
