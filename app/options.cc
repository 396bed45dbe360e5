#include "app/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <thread>

namespace howl {
namespace {

template <typename T>
T Parse(const std::string& name, const std::string& text, const std::string& expected) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError(name + ": " + text + ", expected " + expected);
  }
  return value;
}

int ParseCount(const std::string& name, const std::string& text, int min, int max) {
  const std::string expected =
      "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
  const int value = Parse<int>(name, text, expected);
  if (value < min || value > max) throw UsageError(name + ": " + text + ", expected " + expected);
  return value;
}

const OptionHelp* Find(const std::vector<OptionHelp>& options, const std::string& name) {
  const auto found = std::ranges::find(options, name, &OptionHelp::name);
  return found == options.end() ? nullptr : &*found;
}

void SetCommon(Options& options, const std::string& name, const std::string& value) {
  if (name == "--out") options.out = value;
  if (name == "--threads") options.threads = ParseCount(name, value, 1, 1024);
  if (name == "--seed") {
    options.seed = Parse<std::uint64_t>(name, value, "a whole number from 0 to 2^64 - 1");
  }
  if (name == "--quiet") options.quiet = true;
  if (name == "--help") options.help = true;
}

}  // namespace

std::optional<std::string> Options::Text(const std::string& name) const {
  const auto found = own.find(name);
  if (found == own.end()) return std::nullopt;
  return found->second;
}

std::optional<double> Options::Number(const std::string& name) const {
  const auto text = Text(name);
  if (!text) return std::nullopt;
  const double value = Parse<double>(name, *text, "a number");
  if (!std::isfinite(value)) throw UsageError(name + ": " + *text + ", expected a finite number");
  return value;
}

std::optional<int> Options::Count(const std::string& name, int min, int max) const {
  const auto text = Text(name);
  if (!text) return std::nullopt;
  return ParseCount(name, *text, min, max);
}

const std::vector<OptionHelp>& CommonOptions() {
  static const std::vector<OptionHelp> options = {
      {"--out", "DIR", "folder for the output files (default: out/ and the config's name)"},
      {"--threads", "N", "threads (default: all cores); the answer does not depend on it"},
      {"--seed", "S", "seed of every random draw (default: 1)"},
      {"--quiet", "", "print nothing but errors"},
      {"--help", "", "explain the command"}};
  return options;
}

Options ParseOptions(const std::vector<std::string>& words, const std::vector<OptionHelp>& own) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string name = words[i];
    if (!name.starts_with("--")) {
      if (!options.config.empty()) {
        throw UsageError(name + ": a second config, expected one, after " +
                         options.config.string());
      }
      options.config = name;
      continue;
    }
    std::optional<std::string> value;
    if (const std::size_t equals = name.find('='); equals != std::string::npos) {
      value = name.substr(equals + 1);
      name.resize(equals);
    }
    const OptionHelp* common = Find(CommonOptions(), name);
    const OptionHelp* option = common != nullptr ? common : Find(own, name);
    if (option == nullptr) {
      throw UsageError(name + ": no such option, expected one that --help lists");
    }
    if (option->value.empty() && value) {
      throw UsageError(name + ": takes no value, got " + *value);
    }
    if (!option->value.empty() && !value) {
      if (i + 1 == words.size())
        throw UsageError(name + ": expected " + option->value + " after it");
      value = words[++i];
    }
    if (common != nullptr) {
      SetCommon(options, name, value.value_or(""));
    } else {
      options.own[name] = value.value_or("");
    }
  }
  if (options.threads == 0) {
    options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  if (options.out.empty()) options.out = std::filesystem::path("out") / options.config.stem();
  return options;
}

}  // namespace howl
