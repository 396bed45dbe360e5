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

double ParseNumber(const std::string& whole, const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UsageError("--at: " + whole +
                     ", expected a number or FROM:TO:STEP, such as 0.5:0.7:0.01");
  }
  return value;
}

void CheckCount(double count) {
  if (count <= static_cast<double>(kMostAskedPoints)) return;
  throw UsageError("--at: more than " + std::to_string(kMostAskedPoints) +
                   " points, expected fewer, or a longer step");
}

}  // namespace

std::vector<double> ParseAskedPoints(const std::string& text) {
  std::vector<double> points;
  for (const std::string& item : Split(text, ',')) {
    const std::vector<std::string> parts = Split(item, ':');
    const double from = ParseNumber(item, parts[0]);
    if (parts.size() == 1) {
      points.push_back(from);
      CheckCount(static_cast<double>(points.size()));
      continue;
    }
    if (parts.size() != 3) ParseNumber(item, item);
    const double to = ParseNumber(item, parts[1]);
    const double step = ParseNumber(item, parts[2]);
    if (!(step > 0.0)) throw UsageError("--at: " + item + ", expected a step above zero");
    if (to < from) throw UsageError("--at: " + item + ", expected FROM below TO");
    const double steps = std::floor((to - from) / step * (1.0 + kRounding) + kRounding);
    CheckCount(static_cast<double>(points.size()) + steps + 1.0);
    for (double k = 0.0; k <= steps; k += 1.0) points.push_back(from + k * step);
  }
  return points;
}

}  // namespace howl
