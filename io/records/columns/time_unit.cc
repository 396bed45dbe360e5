#include "io/records/columns/time_unit.h"

#include <array>
#include <cmath>
#include <utility>

namespace howl {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 12> kUnits = {{{"s", 1.0},
                                                                         {"sec", 1.0},
                                                                         {"seconds", 1.0},
                                                                         {"ms", 1e-3},
                                                                         {"msec", 1e-3},
                                                                         {"milliseconds", 1e-3},
                                                                         {"us", 1e-6},
                                                                         {"usec", 1e-6},
                                                                         {"\u00b5s", 1e-6},
                                                                         {"\u03bcs", 1e-6},
                                                                         {"microseconds", 1e-6},
                                                                         {"ns", 1e-9}}};
constexpr std::string_view kBlanks = " \t";

// MS is a millisecond in a header of capitals, and megasiemens on no time axis.
bool SameUnit(std::string_view text, std::string_view unit) {
  if (text.size() != unit.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (lower != unit[i]) return false;
  }
  return true;
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

std::optional<double> TimeUnitOfName(std::string_view name) {
  name = Trimmed(name);
  if (name.empty()) return std::nullopt;
  std::string_view unit;
  const char last = name.back();
  if (last == ']' || last == ')' || last == '}') {
    const std::size_t open = name.find_last_of("[({");
    if (open == std::string_view::npos) return std::nullopt;
    unit = Trimmed(name.substr(open + 1, name.size() - open - 2));
  } else {
    const std::size_t before = name.find_last_of("_/,.- \t");
    if (before == std::string_view::npos) return std::nullopt;
    unit = name.substr(before + 1);
  }
  return SecondsOfUnit(unit);
}

std::optional<double> SecondsOfUnit(std::string_view unit) {
  for (const auto& [text, seconds] : kUnits) {
    if (SameUnit(unit, text)) return seconds;
  }
  return std::nullopt;
}

std::string_view UnitOfSeconds(double unit_s) {
  return unit_s == 1.0 ? "s" : unit_s == 1e-3 ? "ms" : unit_s == 1e-6 ? "us" : "ns";
}

std::optional<double> TimeUnitOfRates(double rate_by_times_hz, double sampling_hz,
                                      double tolerance) {
  for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
    if (std::abs(rate_by_times_hz / unit_s / sampling_hz - 1.0) <= tolerance) return unit_s;
  }
  return std::nullopt;
}

}  // namespace howl
