#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/effects/declared_effect.h"

namespace howl {
namespace {

constexpr std::size_t kDeepestFormula = 64;
constexpr double kLargestWholePower = 64.0;

// Real operands stay real: an infinite null value then gives zero or one, never NaN.
struct ComplexMath {
  static bool IsReal(Response a) { return a.imag() == 0.0; }
  static Response Scaled(double a, Response b) {
    return {a * b.real(), IsReal(b) ? 0.0 : a * b.imag()};
  }
  static Response Multiply(Response a, Response b) {
    if (IsReal(a)) return Scaled(a.real(), b);
    if (IsReal(b)) return Scaled(b.real(), a);
    return a * b;
  }
  static Response Divide(Response a, Response b) {
    if (IsReal(b)) return {a.real() / b.real(), IsReal(a) ? 0.0 : a.imag() / b.real()};
    return a / b;
  }
  static Response Power(Response a, Response b) {
    if (IsReal(b) && b.real() == std::round(b.real()) && std::abs(b.real()) <= kLargestWholePower) {
      Response product = 1.0;
      for (int i = 0; i < std::abs(static_cast<int>(b.real())); ++i) product = Multiply(product, a);
      return b.real() < 0.0 ? Divide(1.0, product) : product;
    }
    if (IsReal(a) && IsReal(b) && a.real() >= 0.0) return std::pow(a.real(), b.real());
    return std::pow(a, b);
  }
  static Response Root(Response a) {
    return IsReal(a) && a.real() >= 0.0 ? Response(std::sqrt(a.real())) : std::sqrt(a);
  }
  static Response Exponential(Response a) {
    return IsReal(a) ? Response(std::exp(a.real())) : std::exp(a);
  }
  static Response Logarithm(Response a) {
    return IsReal(a) && a.real() >= 0.0 ? Response(std::log(a.real())) : std::log(a);
  }
  static Response Sine(Response a) {
    return IsReal(a) ? Response(std::sin(a.real())) : std::sin(a);
  }
  static Response Cosine(Response a) {
    return IsReal(a) ? Response(std::cos(a.real())) : std::cos(a);
  }
  static Response Absolute(Response a) { return std::abs(a); }
};

}  // namespace

std::string_view LoopPlaceName(LoopPlace place) {
  switch (place) {
    case LoopPlace::kAcoustics:
      return "acoustics";
    case LoopPlace::kFlameIn:
      return "flame_in";
    case LoopPlace::kDelay:
      return "delay";
    case LoopPlace::kFlameOut:
      return "flame_out";
    case LoopPlace::kSource:
      return "source";
    case LoopPlace::kPressureRecorded:
      return "p_recorded";
    case LoopPlace::kHeatReleaseRecorded:
      break;
  }
  return "q_recorded";
}

bool PlaceTakes(LoopPlace place, DeclaredForm form) {
  const bool recorded =
      place == LoopPlace::kPressureRecorded || place == LoopPlace::kHeatReleaseRecorded;
  switch (form) {
    case DeclaredForm::kTransfer:
      return place != LoopPlace::kSource && place != LoopPlace::kDelay;
    case DeclaredForm::kDelay:
      return place != LoopPlace::kSource;
    case DeclaredForm::kMap:
      return recorded;
    case DeclaredForm::kLine:
      break;
  }
  return recorded || place == LoopPlace::kSource;
}

std::vector<std::string> FixedNames(LoopPlace place, DeclaredForm form) {
  if (form == DeclaredForm::kMap) return {"x"};
  std::vector<std::string> names = {"s", "f_hz", "j"};
  if (place == LoopPlace::kDelay) names.clear();
  if (place == LoopPlace::kAcoustics) {
    names.insert(names.end(), {"G", "omega_hz", "xi", "N", "M"});
  }
  if (place == LoopPlace::kFlameIn || place == LoopPlace::kDelay) {
    names.insert(names.end(), {"phi_position", "amplitude", "cycle_hz"});
  }
  return names;
}

std::optional<DeclaredFormula> DeclaredFormula::Parse(
    std::string_view text, LoopPlace place, DeclaredForm form,
    const std::vector<EffectParameter>& parameters, FormulaError& error) {
  std::vector<std::string> known = FixedNames(place, form);
  for (const EffectParameter& parameter : parameters) known.push_back(parameter.name);
  DeclaredFormula formula;
  const FormulaNames names = [&](const std::string& owner, const std::string& name) -> FormulaName {
    const auto found = std::find(known.begin(), known.end(), name);
    if (owner.empty() && found != known.end()) {
      formula.names_.push_back(name);
      return {static_cast<std::size_t>(found - known.begin()), ""};
    }
    std::string message =
        "unknown name " + (owner.empty() ? name : owner + "." + name) + ", expected ";
    for (const std::string& each : known) message += each + ", ";
    return {std::nullopt, message + "pi or a function"};
  };
  auto tokens = ParseFormula(text, names, error);
  if (!tokens) return std::nullopt;
  if (FormulaDepth(*tokens) > kDeepestFormula) {
    error = {0, "has too many open operations, expected a shorter formula"};
    return std::nullopt;
  }
  formula.tokens_ = std::move(*tokens);
  return formula;
}

Response DeclaredFormula::Evaluate(std::span<const Response> fixed, EffectValues x) const {
  std::array<Response, kDeepestFormula> stack;
  return EvaluateFormula<ComplexMath>(
      std::span<const FormulaToken>(tokens_),
      [&](std::size_t slot) {
        return slot < fixed.size() ? fixed[slot] : Response(x[slot - fixed.size()]);
      },
      stack.data());
}

}  // namespace howl
