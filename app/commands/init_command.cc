#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "app/command_line/command.h"
#include "app/text/text_table.h"
#include "estimation/parallel.h"
#include "io/inspect/init_config.h"
#include "io/inspect/record_look.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

constexpr const char* kParameter = "--operating-parameter";
constexpr const char* kValues = "--values";
constexpr const char* kSamplingHz = "--sampling-hz";

bool IsKey(const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= 60 && is_letter(name.front()) &&
         std::ranges::all_of(
             name, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

InitOptions ReadOptions(const Options& options) {
  InitOptions init;
  if (options.out_is_given) init.folder = options.out.parent_path();
  if (init.folder.empty()) init.folder = ".";
  init.operating_parameter = options.Text(kParameter).value_or(init.operating_parameter);
  if (!IsKey(init.operating_parameter)) {
    throw UsageError(std::string(kParameter) + ": " + init.operating_parameter +
                     ", expected a key such as phi or air_slpm: letters, digits and _");
  }
  init.sampling_hz = options.Number(kSamplingHz);
  if (init.sampling_hz && !(*init.sampling_hz > 0.0)) {
    throw UsageError(std::string(kSamplingHz) + ": expected samples a second, above 0");
  }
  std::istringstream values(options.Text(kValues).value_or(""));
  for (std::string value; std::getline(values, value, ',');) {
    Options one;
    one.own[kValues] = value;
    (void)one.Number(kValues);
    init.values.push_back(value);
  }
  if (options.Has(kValues) && init.values.size() != options.files.size()) {
    throw UsageError(std::string(kValues) + ": " + std::to_string(init.values.size()) +
                     " values, expected one for each of " + std::to_string(options.files.size()) +
                     " files, in their order");
  }
  return init;
}

// A config that someone worked on is never lost to a guess.
void RequireNew(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;
  const bool is_folder = std::filesystem::is_directory(path, ignored);
  throw UserError(path.string(), 0, "--out",
                  is_folder ? "is a folder, expected the path of the config to be written"
                            : "is there already and is not overwritten, expected another path");
}

int RunInitCommand(const Options& options) {
  const InitOptions init = ReadOptions(options);
  if (options.out_is_given) RequireNew(options.out);
  std::vector<RecordLook> looks;
  for (const std::filesystem::path& file : options.files) looks.push_back(LookAtRecord(file));
  const InitConfig config = WriteInitConfig(looks, init);
  if (!options.out_is_given) {
    std::printf("%s", config.text.c_str());
    return kDone;
  }
  WriteWholeFile(options.out, config.text);
  if (options.quiet) return kDone;
  for (const std::string& line : config.columns) std::printf("%s\n", Wrapped(line, 4).c_str());
  std::printf("written: %s\n", options.out.c_str());
  if (config.left_open > 0) {
    std::printf("to do: replace FILL_IN in it (%zu places), then howl check %s\n", config.left_open,
                options.out.c_str());
  }
  return kDone;
}

}  // namespace

Command InitCommand() {
  return {"init",
          "look into records and write a config for them, with every guess explained",
          "Looks into the files of samples (text, MATLAB or HDF5, plain or gzip), one experiment\n"
          "each: finds the columns, time and its unit, the sampling rate, and what looks like p\n"
          "and like q, by names where there are names, else by values. Writes a config with each\n"
          "guess and its reason as a comment, to standard output or with --out CONFIG.yaml to a\n"
          "new file. FILL_IN stands where a number is missing: the operating parameter, and a\n"
          "sampling rate that no file states.",
          {{kParameter, "NAME", "key of the operating parameter, such as air_slpm (default: phi)"},
           {kValues, "V1,V2,...", "its values, one a file, in place of FILL_IN"},
           {kSamplingHz, "HZ", "samples a second, of files that do not tell theirs"}},
          RunInitCommand,
          false,
          "FILE..."};
}

}  // namespace howl
