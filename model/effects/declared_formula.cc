#include <algorithm>
#include <array>

#include "model/effects/declared_effect.h"
#include "model/numerics/formula_complex.h"

namespace howl {
namespace {

constexpr std::size_t kDeepestFormula = 64;

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
  return EvaluateFormula<FormulaComplex>(
      std::span<const FormulaToken>(tokens_),
      [&](std::size_t slot) {
        return slot < fixed.size() ? fixed[slot] : Response(x[slot - fixed.size()]);
      },
      stack.data());
}

}  // namespace howl
