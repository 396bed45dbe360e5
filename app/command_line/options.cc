#include "app/command_line/options.h"

#include <charconv>
#include <cmath>

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
  const std::string expected =
      "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
  const int value = Parse<int>(name, *text, expected);
  if (value < min || value > max) throw UsageError(name + ": " + *text + ", expected " + expected);
  return value;
}

}  // namespace howl
