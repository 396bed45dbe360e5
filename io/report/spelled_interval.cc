#include "io/report/spelled_interval.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "estimation/analysis/spectra/half_width.h"
#include "io/report/script.h"

namespace howl {
namespace {

constexpr int kLeastPlainPower = -3;  // 0.0012, but 1.2 · 10⁻⁴
constexpr int kMostPlainPower = 4;
constexpr double kOneDigitFrom = 3.5;

// The power of ten of the first digit.
int PowerOf(double value) {
  return value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
}

std::string Rounded(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::max(decimals, 0), value);
  const std::string out = text;
  return out.front() == '-' ? "−" + out.substr(1) : out;
}

std::string Raised(int power) {
  static constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = power < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(power))) out += kRaised[digit - '0'];
  return out;
}

}  // namespace

std::string SpelledInterval(const Estimate& estimate, double scale, int digits) {
  const double value = scale * estimate.value;
  const double half = std::abs(scale) * HalfWidth95(estimate);
  if (!std::isfinite(value) || !std::isfinite(half) || half == 0.0) return Spelled(value, digits);
  const int first = PowerOf(std::max(std::abs(value), half));
  const int power = first < kLeastPlainPower || first > kMostPlainPower ? first : 0;
  const double unit = std::pow(10.0, power);
  const int leading = PowerOf(half / unit);
  const bool one_digit = half / unit >= kOneDigitFrom * std::pow(10.0, leading);
  const int decimals = (one_digit ? 0 : 1) - leading;
  std::string out = Rounded(value / unit, decimals) + " ± " + Rounded(half / unit, decimals);
  if (power == 0) return out;
  return "(" + out + ") · 10" + Raised(power);
}

}  // namespace howl
