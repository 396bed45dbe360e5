#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>

#include "io/config/schema/nearest_key.h"
#include "io/config/sections/config_sections.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

constexpr double kNullTolerance = 1e-12;
constexpr std::size_t kMostStarts = 64;

std::string Number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

double ReadNullValue(const ConfigCursor& parameter) {
  const ConfigCursor cursor = *parameter.Find("null_value");
  const LocatedNode& node = cursor.Node();
  if (node.kind == LocatedNode::Kind::kInteger || node.kind == LocatedNode::Kind::kNumber) {
    if (std::isnan(node.number)) cursor.Fail("is not a number, expected a number or inf");
    return node.number;
  }
  std::string word = node.text;
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool negative = word.starts_with("-");
  if (word.starts_with("-") || word.starts_with("+")) word.erase(0, 1);
  if (word.starts_with(".")) word.erase(0, 1);
  if (word != "inf" && word != "infinity" && word != "infinite") {
    cursor.Fail("\"" + node.text + "\" is text, expected a number or inf");
  }
  return std::numeric_limits<double>::infinity() * (negative ? -1.0 : 1.0);
}

// Two starts between the bounds, at a quarter and at three quarters of the way.
std::vector<double> DefaultStarts(const EffectParameter& p) {
  std::vector<double> starts;
  for (const double way : {0.25, 0.75}) {
    starts.push_back(p.scale == ParameterScale::kLogarithmic ? p.low * std::pow(p.high / p.low, way)
                                                             : p.low + way * (p.high - p.low));
  }
  return starts;
}

EffectParameter ReadParameter(const std::string& name, const ConfigCursor& cursor) {
  EffectParameter p;
  p.name = name;
  p.null_value = ReadNullValue(cursor);
  cursor.Read("low", p.low);
  cursor.Read("high", p.high);
  cursor.Read("unit", p.unit);
  if (!(p.low < p.high)) {
    cursor.Find("high")->Fail(Number(p.high) + " is not above low, expected low < high");
  }
  p.scale = std::isinf(p.null_value) && p.low > 0.0 ? ParameterScale::kLogarithmic
                                                    : ParameterScale::kLinear;
  if (const auto scale = cursor.Find("scale")) {
    p.scale =
        scale->Node().text == "linear" ? ParameterScale::kLinear : ParameterScale::kLogarithmic;
    if (p.scale == ParameterScale::kLogarithmic && !(p.low > 0.0)) {
      scale->Fail("cannot be logarithmic with low " + Number(p.low) + ", expected low above 0");
    }
  }
  p.starts = DefaultStarts(p);
  if (const auto starts = cursor.Find("starts")) {
    p.starts.clear();
    for (const ConfigCursor& item : starts->Items()) {
      const double start = item.Node().number;
      if (!(start >= p.low && start <= p.high)) {
        item.Fail(Number(start) + " is outside the bounds, expected a start from low to high");
      }
      p.starts.push_back(start);
    }
  }
  return p;
}

void CheckParameterName(const ConfigCursor& parameters, const std::string& name,
                        const EffectDeclaration& effect) {
  const bool is_name = std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
                       std::all_of(name.begin(), name.end(), [](char c) {
                         return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
                       });
  if (!is_name) parameters.FailAt(name, "cannot be a name, expected letters, digits and _");
  std::vector<std::string> taken = FixedNames(effect.place, effect.form);
  taken.insert(taken.end(), {"pi", "sqrt", "exp", "log", "sin", "cos", "abs"});
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    parameters.FailAt(name, "already means something else in formulas, expected another name");
  }
}

void ReadParameters(const ConfigCursor& cursor, EffectDeclaration& effect) {
  const auto parameters = cursor.Find("parameters");
  const bool some = parameters && !parameters->Node().members.empty();
  if (effect.form == DeclaredForm::kLine) {
    if (some) parameters->Fail("a line has no free parameters, expected line_hz alone");
    return;
  }
  if (!some) cursor.FailAt("parameters", "is missing, expected at least one free parameter");
  std::size_t starts = 1;
  for (const LocatedMember& member : parameters->Node().members) {
    CheckParameterName(*parameters, member.key, effect);
    effect.parameters.push_back(ReadParameter(member.key, *parameters->Find(member.key)));
    starts *= effect.parameters.back().starts.size();
  }
  if (starts > kMostStarts) {
    parameters->Fail("their starts make " + std::to_string(starts) + " combinations, expected " +
                     "at most " + std::to_string(kMostStarts));
  }
}

// Adds a suggestion for an unknown name at `position`, if there is one.
std::optional<std::string> NearestName(const std::string& text, std::size_t position,
                                       const EffectDeclaration& effect) {
  std::string word;
  for (std::size_t i = position; i < text.size(); ++i) {
    if (std::isalnum(static_cast<unsigned char>(text[i])) == 0 && text[i] != '_') break;
    word += text[i];
  }
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) return std::nullopt;
  std::vector<std::string> known = FixedNames(effect.place, effect.form);
  for (const EffectParameter& p : effect.parameters) known.push_back(p.name);
  return NearestKey(word, known);
}

DeclaredFormula ReadFormula(const ConfigCursor& cursor, const EffectDeclaration& effect,
                            std::set<std::string>& used) {
  const std::string& text = cursor.Node().text;
  FormulaError error;
  auto formula = DeclaredFormula::Parse(text, effect.place, effect.form, effect.parameters, error);
  if (!formula) {
    std::string message = error.message;
    if (const auto nearest = NearestName(text, error.position, effect)) {
      message += "; the nearest is " + *nearest;
    }
    cursor.Fail("at character " + std::to_string(error.position + 1) + ": " + message);
  }
  used.insert(formula->Names().begin(), formula->Names().end());
  return std::move(*formula);
}

void ReadFormulas(const ConfigCursor& cursor, const char* key, EffectDeclaration& effect) {
  const ConfigCursor form = *cursor.Find(key);
  std::set<std::string> used;
  if (form.Node().kind == LocatedNode::Kind::kMapping) {
    for (const ConfigCursor& item : form.Find("numerator")->Items()) {
      effect.numerator.push_back(ReadFormula(item, effect, used));
    }
    for (const ConfigCursor& item : form.Find("denominator")->Items()) {
      effect.denominator.push_back(ReadFormula(item, effect, used));
    }
  } else {
    effect.numerator.push_back(ReadFormula(form, effect, used));
  }
  for (const EffectParameter& parameter : effect.parameters) {
    if (used.contains(parameter.name)) continue;
    cursor.Find("parameters")
        ->FailAt(parameter.name, std::string("is not in the formula, expected it in ") + key);
  }
}

void CheckPlace(const ConfigCursor& cursor, const char* key, const EffectDeclaration& effect) {
  if (PlaceTakes(effect.place, effect.form)) return;
  const std::string place(LoopPlaceName(effect.place));
  switch (effect.form) {
    case DeclaredForm::kMap:
      cursor.FailAt(key, "cannot be at " + place +
                             ": inside the loop the flame's free characteristic absorbs it, "
                             "expected at: p_recorded or q_recorded");
    case DeclaredForm::kLine:
      cursor.FailAt(key,
                    "cannot be at " + place + ", expected at: source, p_recorded or q_recorded");
    case DeclaredForm::kTransfer:
    case DeclaredForm::kDelay:
      cursor.FailAt(key, "cannot be at " + place + ", expected " +
                             (effect.place == LoopPlace::kDelay ? "delay_factor" : "line_hz") +
                             " there, or another place");
  }
}

void CheckNull(const ConfigCursor& cursor, const char* key, const EffectDeclaration& declaration) {
  const DeclaredEffect effect(declaration);
  const bool map = declaration.form == DeclaredForm::kMap;
  const auto at = [&](double value) {
    return map ? "x = " + Number(value) : Number(value) + " Hz";
  };
  const DeclaredEffect::Distance null = effect.FromBase(NullValues(effect));
  if (!(null.distance <= kNullTolerance)) {
    std::string what = std::isnan(null.distance)
                           ? "has no value"
                           : "is " + Number(null.distance) + " away from the loop without it";
    cursor.FailAt(key, "with its parameters at null_value it " + what + " at " + at(null.at) +
                           ", expected " + (map ? "x itself" : "1") + " to within 1e-12");
  }
  if (map) return;
  std::vector<double> first;
  for (const EffectParameter& p : declaration.parameters) first.push_back(p.starts.front());
  const DeclaredEffect::Distance start = effect.FromBase(first);
  if (!std::isfinite(start.distance)) {
    cursor.FailAt(key, "has no finite value at " + at(start.at) +
                           " at the first starts of its parameters, expected one");
  }
}

void ReadForm(const ConfigCursor& cursor, EffectDeclaration& effect) {
  struct Known {
    const char* key;
    DeclaredForm form;
  };
  constexpr std::array<Known, 5> kForms = {{{"transfer", DeclaredForm::kTransfer},
                                            {"delay_s", DeclaredForm::kDelay},
                                            {"delay_factor", DeclaredForm::kDelay},
                                            {"static_map", DeclaredForm::kMap},
                                            {"line_hz", DeclaredForm::kLine}}};
  const Known* found = nullptr;
  for (const Known& known : kForms) {
    if (!cursor.Find(known.key)) continue;
    if (found) {
      cursor.FailAt(known.key, std::string("is given with ") + found->key +
                                   ", expected one of them in an effect");
    }
    found = &known;
  }
  if (!found) {
    cursor.Fail(
        "says nothing of what the effect does, expected one of transfer, delay_s, "
        "delay_factor, static_map, line_hz");
  }
  effect.form = found->form;
  const bool factor = std::string(found->key) == "delay_factor";
  if (factor != (effect.place == LoopPlace::kDelay) && effect.form == DeclaredForm::kDelay) {
    cursor.FailAt(found->key, factor ? "acts on the loop's delay, expected at: delay"
                                     : "cannot be at delay, expected delay_factor there, or at: "
                                       "flame_in, flame_out, acoustics, p_recorded or q_recorded");
  }
  CheckPlace(cursor, found->key, effect);
  ReadParameters(cursor, effect);
  if (effect.form == DeclaredForm::kLine) {
    const std::vector<ConfigCursor> ends = cursor.Find("line_hz")->Items();
    effect.line_low_hz = ends[0].Node().number;
    effect.line_high_hz = ends[1].Node().number;
    if (!(effect.line_low_hz < effect.line_high_hz)) {
      ends[1].Fail(Number(effect.line_high_hz) + " is not above the first, expected low < high");
    }
    return;
  }
  ReadFormulas(cursor, found->key, effect);
  CheckNull(cursor, found->key, effect);
}

void CheckName(const ConfigCursor& cursor, const std::string& name,
               std::map<std::string, int>& lines_of_names) {
  for (const EffectPointer& known : Catalogue()) {
    if (known->id() == name) {
      cursor.FailAt("name",
                    "\"" + name + "\" is an effect of the catalogue, expected another name");
    }
  }
  if (name == "none" || name == "unknown") {
    cursor.FailAt("name", "\"" + name + "\" is a verdict, expected another name");
  }
  const auto [earlier, is_new] = lines_of_names.try_emplace(name, cursor.Find("name")->Line());
  if (!is_new) {
    cursor.FailAt("name", "\"" + name + "\" is taken by the effect on line " +
                              std::to_string(earlier->second) + ", expected another name");
  }
}

}  // namespace

void ReadEffects(const ConfigCursor& root, Config& config) {
  const auto effects = root.Find("effects");
  if (!effects) return;
  std::map<std::string, int> lines_of_names;
  for (const ConfigCursor& cursor : effects->Items()) {
    EffectDeclaration effect;
    cursor.Read("name", effect.name);
    CheckName(cursor, effect.name, lines_of_names);
    for (const LoopPlace place : kLoopPlaces) {
      if (cursor.Find("at")->Node().text == LoopPlaceName(place)) effect.place = place;
    }
    ReadForm(cursor, effect);
    config.effects.push_back(std::move(effect));
  }
}

}  // namespace howl
