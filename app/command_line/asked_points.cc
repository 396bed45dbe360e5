#include "app/command_line/asked_points.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include "app/command_line/options.h"

namespace howl {
namespace {

// A last point that rounding puts a little beyond the end still belongs to the range.
constexpr double kRounding = 1e-9;

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  if (text.empty() || text.back() == at) parts.emplace_back();
  return parts;
}

double ParseNumber(const std::string& option, const std::string& whole, const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UsageError(option + ": " + whole +
                     ", expected a number or FROM:TO:STEP, such as 0.5:0.7:0.01");
  }
  return value;
}

void CheckCount(const std::string& option, double count, std::size_t most) {
  if (count <= static_cast<double>(most)) return;
  throw UsageError(option + ": more than " + std::to_string(most) +
                   " points, expected fewer, or a longer step");
}

}  // namespace

std::vector<double> ParseAskedPoints(const std::string& option, const std::string& text,
                                     std::size_t most) {
  std::vector<double> points;
  for (const std::string& item : Split(text, ',')) {
    const std::vector<std::string> parts = Split(item, ':');
    const double from = ParseNumber(option, item, parts[0]);
    if (parts.size() == 1) {
      points.push_back(from);
      CheckCount(option, static_cast<double>(points.size()), most);
      continue;
    }
    if (parts.size() != 3) ParseNumber(option, item, item);
    const double to = ParseNumber(option, item, parts[1]);
    const double step = ParseNumber(option, item, parts[2]);
    if (!(step > 0.0)) throw UsageError(option + ": " + item + ", expected a step above zero");
    if (to < from) throw UsageError(option + ": " + item + ", expected FROM below TO");
    const double steps = std::floor((to - from) / step * (1.0 + kRounding) + kRounding);
    CheckCount(option, static_cast<double>(points.size()) + steps + 1.0, most);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(steps); ++k) {
      points.push_back(from + static_cast<double>(k) * step);
    }
  }
  return points;
}

}  // namespace howl
