#include "estimation/analysis/instruments/instrument_response.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "model/numerics/formula_complex.h"
#include "model/numerics/formula_products.h"

namespace howl {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"s", "f_hz", "j"};
constexpr std::size_t kDeepest = 64;
constexpr double kHalfTurnDeg = 180.0;

}  // namespace

std::optional<InstrumentResponse> InstrumentResponse::Parse(std::string_view text,
                                                            FormulaError& error) {
  const FormulaNames names = [](const std::string& owner, const std::string& name) -> FormulaName {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (owner.empty() && found != kNames.end()) {
      return {static_cast<std::size_t>(found - kNames.begin()), ""};
    }
    return {std::nullopt, "unknown name " + (owner.empty() ? name : owner + "." + name) +
                              ", expected s, f_hz, j, pi or a function"};
  };
  InstrumentResponse response;
  auto tokens = ParseFormulaWithProducts(text, names, error);
  if (!tokens) return std::nullopt;
  if (FormulaDepth(*tokens) > kDeepest) {
    error = {0, "has too many open operations, expected a shorter formula"};
    return std::nullopt;
  }
  response.tokens_ = std::move(*tokens);
  return response;
}

InstrumentResponse InstrumentResponse::OfTable(std::vector<double> frequency_hz,
                                               const std::vector<double>& magnitude,
                                               const std::vector<double>& phase_deg) {
  CHECK_GE(frequency_hz.size(), 2U);
  CHECK_EQ(frequency_hz.size(), magnitude.size());
  CHECK_EQ(frequency_hz.size(), phase_deg.size());
  InstrumentResponse response;
  response.frequency_hz_ = std::move(frequency_hz);
  double unwrapped_deg = phase_deg.front();
  for (std::size_t i = 0; i < magnitude.size(); ++i) {
    CHECK_GT(magnitude[i], 0.0);
    if (i > 0) {
      unwrapped_deg += std::remainder(phase_deg[i] - phase_deg[i - 1], 2.0 * kHalfTurnDeg);
    }
    response.log_magnitude_.push_back(std::log(magnitude[i]));
    response.phase_rad_.push_back(unwrapped_deg * std::numbers::pi / kHalfTurnDeg);
  }
  return response;
}

std::complex<double> InstrumentResponse::At(double frequency_hz) const {
  if (!tokens_.empty()) {
    const std::array<std::complex<double>, kNames.size()> values = {
        std::complex<double>(0.0, 2.0 * std::numbers::pi * frequency_hz), frequency_hz,
        std::complex<double>(0.0, 1.0)};
    std::array<std::complex<double>, kDeepest> stack;
    return EvaluateFormula<FormulaComplex>(
        std::span<const FormulaToken>(tokens_), [&](std::size_t slot) { return values[slot]; },
        stack.data());
  }
  const auto above = std::upper_bound(frequency_hz_.begin(), frequency_hz_.end(), frequency_hz);
  if (above == frequency_hz_.begin()) {
    return std::polar(std::exp(log_magnitude_.front()), phase_rad_.front());
  }
  if (above == frequency_hz_.end()) {
    return std::polar(std::exp(log_magnitude_.back()), phase_rad_.back());
  }
  const auto high = static_cast<std::size_t>(above - frequency_hz_.begin());
  const std::size_t low = high - 1;
  const double way =
      (frequency_hz - frequency_hz_[low]) / (frequency_hz_[high] - frequency_hz_[low]);
  return std::polar(std::exp(std::lerp(log_magnitude_[low], log_magnitude_[high], way)),
                    std::lerp(phase_rad_[low], phase_rad_[high], way));
}

std::optional<InstrumentResponse::Band> InstrumentResponse::TableBand() const {
  if (!tokens_.empty()) return std::nullopt;
  return Band{frequency_hz_.front(), frequency_hz_.back()};
}

}  // namespace howl
