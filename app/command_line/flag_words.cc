#include "app/command_line/flag_words.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <sstream>

namespace howl {

std::string CanonicalFlag(const std::string& flag) {
  std::string name = flag.substr(std::min(flag.find_first_not_of('-'), flag.size()));
  std::ranges::replace(name, '-', '_');
  return name;
}

std::string DashedFlag(const std::string& name) {
  return (name.starts_with("--") ? "" : name.starts_with('-') ? "-" : "--") + name;
}

const OptionHelp* FindOption(const std::vector<OptionHelp>& options, const std::string& flag) {
  const auto found = std::ranges::find_if(options, [&](const OptionHelp& each) {
    return CanonicalFlag(each.name) == CanonicalFlag(flag);
  });
  return found == options.end() ? nullptr : &*found;
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

std::string JoinedValues(const OptionHelp& flag, const std::string& value) {
  if (!flag.value.ends_with("...")) return value;
  const std::string before =
      gflags::GetCommandLineFlagInfoOrDie(CanonicalFlag(flag.name).c_str()).current_value;
  return before.empty() ? value : before + "," + value;
}

std::string ExpectedValue(const OptionHelp& flag) {
  if (flag.value.empty()) return "true, false or nothing";
  if (flag.name == "--threads") return "a whole number from 1 to 1024";
  if (flag.name == "--seed") return "a whole number from 0 to 2^64 - 1";
  if (flag.name == "--v") return "a whole number";
  return flag.value;
}

}  // namespace howl
