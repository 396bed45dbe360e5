#include "app/command_line/command_line.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

#include "app/command_line/flag_words.h"
#include "io/config/schema/nearest_key.h"
#include "io/user_error.h"

DEFINE_string(out, "", "folder for the output files (default: out/ and the config's name)");
DEFINE_int32(threads, 0, "threads (default: all cores); the answer does not depend on it");
DEFINE_uint64(seed, 1, "seed of every random draw (default: 1)");
DEFINE_bool(quiet, false, "print nothing but errors");
DECLARE_bool(help);     // gflags' own
DECLARE_bool(version);  // too

namespace {

bool IsThreadCount(const char* /*flag*/, gflags::int32 threads) {
  return threads >= 1 && threads <= 1024;
}

}  // namespace

DEFINE_validator(threads, &IsThreadCount);

namespace howl {
namespace {

constexpr int kMostOpenFiles = 8;  // a flag file that names itself has no end

// Objects to which gflags' registry keeps pointers as long as the program runs.
struct OwnFlag {
  std::string name;
  std::string text;
  std::string file;
  std::string value;
  std::string default_value;
  bool on = false;
  bool default_on = false;
};

std::deque<OwnFlag>& OwnFlags() {
  static auto* const flags = new std::deque<OwnFlag>;
  return *flags;
}

std::string Described(const char* flag) {
  return gflags::GetCommandLineFlagInfoOrDie(flag).description;
}

}  // namespace

// The place of a flag: the command line, or a line of a file.
struct CommandLine::Place {
  std::string file;
  int line = 0;

  [[noreturn]] void Fail(const std::string& flag, const std::string& what) const {
    if (file.empty()) throw UsageError(flag + ": " + what);
    throw UserError(file, line, flag, what);
  }
};

const std::vector<OptionHelp>& CommonOptions() {
  static const std::vector<OptionHelp> options = {
      {"--out", "DIR", Described("out")},
      {"--threads", "N", Described("threads")},
      {"--seed", "S", Described("seed")},
      {"--quiet", "", Described("quiet")},
      {"--v", "LEVEL",
       "tell on standard error what a solver does: 1 what it found, 2 each start and bound"},
      {"--vmodule", "FILE=LEVEL", "the same for one source file, such as joint_fit=2; or several"},
      {"--flagfile", "FILE", "read options from a file, one --name=value a line"},
      {"--fromenv", "NAMES", "threads,out: from FLAGS_threads and FLAGS_out in the environment"},
      {"--tryfromenv", "NAMES", "the same, where they are there"},
      {"--undefok", "NAMES", "options that the command may lack (for a file shared by several)"},
      {"--version", "", "print the version"},
      {"--help", "", "explain the command"}};
  return options;
}

const Command& FindCommand(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : Commands()) {
    if (command.name == name) return command;
    names.push_back(command.name);
  }
  const std::optional<std::string> nearest = NearestKey(name, names, 1);
  throw UsageError(
      name + ": no such command, " +
      (nearest ? "did you mean " + *nearest + "?" : "expected one that howl --help lists"));
}

CommandLine::CommandLine(std::vector<std::string> words) : words_(std::move(words)) {
  for (const std::string& word : words_) {
    constexpr std::string_view kFlag = "--undefok=";
    if (word.starts_with(kFlag)) Read({}, word, [] { return std::nullopt; });
  }
}

std::optional<std::string> CommandLine::NextWord() {
  const FollowingWord following = [this]() -> std::optional<std::string> {
    if (next_ == words_.size()) return std::nullopt;
    return words_[next_++];
  };
  while (next_ < words_.size()) {
    const std::string& word = words_[next_++];
    if (!word.starts_with('-') || word == "-") return word;
    Read({}, word, following);
  }
  return std::nullopt;
}

void CommandLine::SetCommand(const Command& command) {
  command_ = &command;
  for (const OptionHelp& option : command.options) {
    OwnFlag& flag = OwnFlags().emplace_back();
    flag.name = CanonicalFlag(option.name);
    flag.text = option.text;
    flag.file = "howl " + command.name;
    if (option.value.empty()) {
      gflags::FlagRegisterer(flag.name.c_str(), flag.text.c_str(), flag.file.c_str(), &flag.on,
                             &flag.default_on);
    } else {
      gflags::FlagRegisterer(flag.name.c_str(), flag.text.c_str(), flag.file.c_str(), &flag.value,
                             &flag.default_value);
    }
  }
}

const OptionHelp* CommandLine::Find(const std::string& flag) const {
  if (const OptionHelp* common = FindOption(CommonOptions(), flag)) return common;
  return command_ == nullptr ? nullptr : FindOption(command_->options, flag);
}

void CommandLine::FailUnknown(const Place& place, const std::string& flag) const {
  const std::string whose = command_ == nullptr ? "howl" : "howl " + command_->name;
  for (const Command& other : Commands()) {
    if (FindOption(other.options, flag) == nullptr) continue;
    place.Fail(flag, command_ == nullptr
                         ? "an option of howl " + other.name + ", expected after the command"
                         : "no option of " + whose + ", but one of howl " + other.name);
  }
  std::vector<std::string> names;
  for (const OptionHelp& each : CommonOptions()) names.push_back(CanonicalFlag(each.name));
  if (command_ != nullptr) {
    for (const OptionHelp& each : command_->options) names.push_back(CanonicalFlag(each.name));
  }
  const std::optional<std::string> nearest = NearestKey(CanonicalFlag(flag), names, 1);
  place.Fail(flag, "no such option of " + whose + ", expected " +
                       (nearest ? "the nearest one, " + Find(*nearest)->name
                                : "one that " + whose + " --help lists"));
}

void CommandLine::Read(const Place& place, const std::string& word,
                       const FollowingWord& following) {
  std::string name = word;
  std::optional<std::string> value;
  if (const std::size_t equals = word.find('='); equals != std::string::npos) {
    name = word.substr(0, equals);
    value = word.substr(equals + 1);
  }
  name = DashedFlag(name == "-h" ? "help" : name);
  const OptionHelp* flag = Find(name);
  if (flag == nullptr && !value && CanonicalFlag(name).starts_with("no")) {
    flag = Find(CanonicalFlag(name).substr(2));
    if (flag != nullptr && flag->value.empty()) value = "false";
    if (!value) flag = nullptr;
  }
  if (flag == nullptr) {
    if (undefok_.contains(CanonicalFlag(name))) return;
    FailUnknown(place, name);
  }
  if (!value) value = flag->value.empty() ? "true" : following();
  if (!value) place.Fail(flag->name, "expected " + flag->value + " after it");
  Set(place, *flag, *value);
}

void CommandLine::Set(const Place& place, const OptionHelp& flag, const std::string& value) {
  if (flag.name == "--flagfile") {
    for (const std::string& path : SplitAtCommas(value)) ReadFile(place, path);
  } else if (flag.name == "--fromenv" || flag.name == "--tryfromenv") {
    ReadEnvironment(place, value, flag.name == "--tryfromenv");
  } else if (flag.name == "--undefok") {
    for (const std::string& name : SplitAtCommas(value)) undefok_.insert(CanonicalFlag(name));
  } else if (gflags::SetCommandLineOption(CanonicalFlag(flag.name).c_str(),
                                          JoinedValues(flag, value).c_str())
                 .empty()) {
    place.Fail(flag.name, value + ", expected " + ExpectedValue(flag));
  }
}

void CommandLine::ReadFile(const Place& place, const std::string& path) {
  std::ifstream file(path);
  if (!file) place.Fail("--flagfile", path + ": not readable, expected a file of options");
  if (++open_files_ > kMostOpenFiles) {
    place.Fail("--flagfile", path + ": names itself, or too many others, one within the other");
  }
  Place at{path, 0};
  for (std::string line; std::getline(file, line);) {
    ++at.line;
    const char* const kBlank = " \t\r";
    const std::size_t first = line.find_first_not_of(kBlank);
    if (first == std::string::npos || line[first] == '#') continue;
    line = line.substr(first, line.find_last_not_of(kBlank) + 1 - first);
    if (line[0] != '-') at.Fail(line, "expected --name=value, or a comment after #");
    // The form --name value is valid as well.
    const std::size_t blank = line.find_first_of(kBlank);
    const bool apart = blank < line.find('=');
    Read(at, apart ? line.substr(0, blank) : line, [&]() -> std::optional<std::string> {
      if (!apart) return std::nullopt;
      return line.substr(line.find_first_not_of(kBlank, blank));
    });
  }
  --open_files_;
}

void CommandLine::ReadEnvironment(const Place& place, const std::string& names,
                                  bool may_be_absent) {
  for (const std::string& name : SplitAtCommas(names)) {
    const OptionHelp* const flag = Find(DashedFlag(name));
    if (flag == nullptr) {
      if (undefok_.contains(CanonicalFlag(name))) continue;
      FailUnknown(place, DashedFlag(name));
    }
    const std::string variable = "FLAGS_" + CanonicalFlag(name);
    const char* const value = gflags::StringFromEnv(variable.c_str(), nullptr);
    if (value != nullptr) {
      Set(place, *flag, value);
    } else if (!may_be_absent) {
      place.Fail("--fromenv",
                 variable + " is not in the environment, expected " + ExpectedValue(*flag));
    }
  }
}

bool CommandLine::WantsHelp() const { return FLAGS_help; }
bool CommandLine::WantsVersion() const { return FLAGS_version; }

Options CommandLine::Finish(const std::vector<std::string>& operands) const {
  Options options;
  options.files.assign(operands.begin(), operands.end());
  const std::filesystem::path& config = options.files.front();
  options.config = config;
  options.out = FLAGS_out;
  options.out_is_given = !FLAGS_out.empty();
  if (FLAGS_out.empty()) {
    const std::filesystem::path name = config.stem();
    if (command_ != nullptr && command_->writes_results && (name == ".." || name == ".")) {
      throw UsageError("--out: " + config.string() +
                       " gives no name for a folder of results, expected --out DIR");
    }
    options.out = std::filesystem::path("out") / name;
  }
  options.threads = FLAGS_threads > 0
                        ? FLAGS_threads
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.seed = FLAGS_seed;
  options.quiet = FLAGS_quiet;
  if (command_ == nullptr) return options;
  for (const OptionHelp& option : command_->options) {
    const gflags::CommandLineFlagInfo flag =
        gflags::GetCommandLineFlagInfoOrDie(CanonicalFlag(option.name).c_str());
    const bool is_switch = option.value.empty();
    if (flag.is_default || (is_switch && flag.current_value != "true")) continue;
    options.own[option.name] = is_switch ? "" : flag.current_value;
  }
  return options;
}

}  // namespace howl
