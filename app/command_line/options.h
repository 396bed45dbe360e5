// The command line that the user typed: howl COMMAND CONFIG [--out DIR] [--threads N] [--seed S]
// [--quiet] ...
#ifndef HOWL_APP_COMMAND_LINE_OPTIONS_H_
#define HOWL_APP_COMMAND_LINE_OPTIONS_H_

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace howl {

// A mistake on the command line: one line on standard error, exit status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct OptionHelp {
  std::string name;  // "--sort"
  // "COLUMN"; empty for a switch. "PHI..." may be given several times: its values are joined by
  // commas.
  std::string value;
  std::string text;
};

struct Options {
  std::filesystem::path config;              // the first of `files`
  std::vector<std::filesystem::path> files;  // one, but for a command that takes several
  std::filesystem::path out;  // default: out/ and the config's name without its ending
  bool out_is_given = false;
  int threads = 0;  // at least 1
  std::uint64_t seed = 1;
  bool quiet = false;
  std::map<std::string, std::string> own;  // the command's own options; a switch maps to ""

  bool Has(const std::string& name) const { return own.contains(name); }
  std::optional<std::string> Text(const std::string& name) const;
  // Throw UsageError where the value is no number, or not in the range.
  std::optional<double> Number(const std::string& name) const;
  std::optional<int> Count(const std::string& name, int min, int max) const;
};

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_OPTIONS_H_
