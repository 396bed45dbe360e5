#include "model/effects/declared_effect.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace howl {
namespace {

constexpr std::size_t kMostFixed = 8;

LoopBlock BlockOf(const EffectDeclaration& declaration) {
  switch (declaration.place) {
    case LoopPlace::kAcoustics:
      return LoopBlock::kAcoustics;
    case LoopPlace::kFlameIn:
    case LoopPlace::kFlameOut:
      return declaration.form == DeclaredForm::kDelay ? LoopBlock::kDelay : LoopBlock::kFlame;
    case LoopPlace::kDelay:
      return LoopBlock::kDelay;
    case LoopPlace::kSource:
      return LoopBlock::kSource;
    case LoopPlace::kPressureRecorded:
      return LoopBlock::kPressureInstrument;
    case LoopPlace::kHeatReleaseRecorded:
      break;
  }
  return LoopBlock::kHeatReleaseInstrument;
}

}  // namespace

DeclaredEffect::DeclaredEffect(EffectDeclaration declaration)
    : NamedEffect(declaration.name, BlockOf(declaration), declaration.parameters),
      declaration_(std::move(declaration)),
      null_(NullValues(*this)) {
  CHECK(PlaceTakes(declaration_.place, declaration_.form)) << declaration_.name;
}

EffectKind DeclaredEffect::kind() const {
  switch (declaration_.form) {
    case DeclaredForm::kMap:
      return EffectKind::kDeclaredMap;
    case DeclaredForm::kLine:
      return EffectKind::kDeclaredLine;
    case DeclaredForm::kTransfer:
    case DeclaredForm::kDelay:
      break;
  }
  return EffectKind::kTransfer;
}

bool DeclaredEffect::ChangesAcousticCut() const {
  return IsAt(LoopPlace::kAcoustics) || IsAt(LoopPlace::kPressureRecorded) ||
         IsAt(LoopPlace::kHeatReleaseRecorded) || IsAt(LoopPlace::kSource);
}

bool DeclaredEffect::ChangesFlameCut() const {
  return !IsAt(LoopPlace::kAcoustics) && !IsAt(LoopPlace::kSource);
}

bool DeclaredEffect::ChangesFlameInput() const {
  return IsAt(LoopPlace::kFlameIn) || IsAt(LoopPlace::kPressureRecorded);
}

bool DeclaredEffect::IsOneTransfer() const {
  if (kind() != EffectKind::kTransfer) return false;
  if (IsAt(LoopPlace::kPressureRecorded) || IsAt(LoopPlace::kHeatReleaseRecorded)) return true;
  if (IsAt(LoopPlace::kFlameOut)) return declaration_.form == DeclaredForm::kTransfer;
  if (!IsAt(LoopPlace::kFlameIn)) return false;
  // At the delay all names but the parameters are those of an operating point.
  const std::vector<std::string> of_point = FixedNames(LoopPlace::kDelay, DeclaredForm::kDelay);
  const auto tells_points_apart = [&](const DeclaredFormula& formula) {
    return std::ranges::find_first_of(formula.Names(), of_point) != formula.Names().end();
  };
  return std::ranges::none_of(declaration_.numerator, tells_points_apart) &&
         std::ranges::none_of(declaration_.denominator, tells_points_apart);
}

bool DeclaredEffect::IsNull(EffectValues x) const {
  return std::equal(x.begin(), x.end(), null_.begin(), null_.end());
}

Response DeclaredEffect::Value(std::span<const Response> fixed, EffectValues x) const {
  const auto polynomial = [&](const std::vector<DeclaredFormula>& coefficients) {
    Response sum = 0.0;
    for (const DeclaredFormula& each : coefficients) {
      // Horner; the first name of a transfer is s.
      const Response coefficient = each.Evaluate(fixed, x);
      sum = &each == &coefficients.front() ? coefficient : sum * fixed[0] + coefficient;
    }
    return sum;
  };
  const Response top = polynomial(declaration_.numerator);
  return declaration_.denominator.empty() ? top : top / polynomial(declaration_.denominator);
}

Response DeclaredEffect::Formula(double frequency_hz, const howl::Acoustics<double>* acoustics,
                                 Response base, const EffectContext* at, EffectValues x) const {
  const Response s = LaplaceVariable(frequency_hz);
  std::array<Response, kMostFixed> fixed = {s, frequency_hz, Response(0.0, 1.0)};
  std::size_t count = 3;
  if (IsAt(LoopPlace::kDelay)) count = 0;
  if (acoustics) {
    for (const Response value : {base, Response(acoustics->omega_hz), Response(acoustics->xi),
                                 Response(acoustics->N), Response(acoustics->M)}) {
      fixed[count++] = value;
    }
  }
  if (at) {
    for (const double value : {at->phi_position, at->relative_amplitude, at->cycle_frequency_hz}) {
      fixed[count++] = value;
    }
  }
  const Response value = Value(std::span<const Response>(fixed.data(), count), x);
  if (declaration_.form != DeclaredForm::kDelay || IsAt(LoopPlace::kDelay)) return value;
  return std::exp(-s * value);
}

Response DeclaredEffect::Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                                   const EffectContext& at, EffectValues x) const {
  const Response base = Effect::Acoustics(acoustics, frequency_hz, at, x);
  if (!IsAt(LoopPlace::kAcoustics) || IsNull(x)) return base;
  return base * Formula(frequency_hz, &acoustics, base, nullptr, x);
}

Response DeclaredEffect::PressureInstrument(double frequency_hz, EffectValues x) const {
  if (!IsAt(LoopPlace::kPressureRecorded) || IsNull(x)) return 1.0;
  return Formula(frequency_hz, nullptr, 1.0, nullptr, x);
}

Response DeclaredEffect::HeatReleaseInstrument(double frequency_hz, EffectValues x) const {
  if (!IsAt(LoopPlace::kHeatReleaseRecorded) || IsNull(x)) return 1.0;
  return Formula(frequency_hz, nullptr, 1.0, nullptr, x);
}

Response DeclaredEffect::FlameIn(double frequency_hz, const EffectContext& at,
                                 EffectValues x) const {
  if (!IsAt(LoopPlace::kFlameIn) || IsNull(x)) return 1.0;
  return Formula(frequency_hz, nullptr, 1.0, &at, x);
}

Response DeclaredEffect::FlameOut(double frequency_hz, const EffectContext& /*at*/,
                                  EffectValues x) const {
  if (!IsAt(LoopPlace::kFlameOut) || IsNull(x)) return 1.0;
  return Formula(frequency_hz, nullptr, 1.0, nullptr, x);
}

double DeclaredEffect::DelayFactor(const EffectContext& at, EffectValues x) const {
  if (!IsAt(LoopPlace::kDelay) || IsNull(x)) return 1.0;
  return Formula(at.cycle_frequency_hz, nullptr, 1.0, &at, x).real();
}

double DeclaredEffect::Map(double true_value, EffectValues x) const {
  if (IsNull(x)) return true_value;
  const std::array<Response, 1> fixed = {true_value};
  return Value(fixed, x).real();
}

DeclaredEffect::Distance DeclaredEffect::FromBase(EffectValues x) const {
  Distance worst;
  const auto keep = [&](double error, double at) {
    if (std::isnan(worst.distance) || error <= worst.distance) return;
    worst = {error, at};
  };
  if (declaration_.form == DeclaredForm::kLine) return worst;
  if (declaration_.form == DeclaredForm::kMap) {
    for (const double value : {-1e3, -2.5, -1.0, -1e-3, 0.0, 1e-3, 0.7, 1.0, 3.0, 1e3}) {
      const std::array<Response, 1> fixed = {value};
      keep(std::abs(Value(fixed, x) - value) / std::max(1.0, std::abs(value)), value);
    }
    return worst;
  }
  const howl::Acoustics<double> acoustics{213.7, 0.17, 6609.0, 1900.0, kPaperHarmonicRatio};
  const bool context = IsAt(LoopPlace::kFlameIn) || IsAt(LoopPlace::kDelay);
  for (const double f : {1.0, 10.0, 33.3, 100.0, 213.7, 400.0, 700.0, 1500.0, 5000.0, 2e4}) {
    for (const EffectContext& at :
         {EffectContext{-0.5, 110.0, 0.6, 0.1}, EffectContext{0.31, 207.0, 1.2, 0.08}}) {
      const Response base = Effect::Acoustics(acoustics, f, at, x);
      const bool acoustic = IsAt(LoopPlace::kAcoustics);
      keep(std::abs(Formula(f, acoustic ? &acoustics : nullptr, base, context ? &at : nullptr, x) -
                    1.0),
           f);
    }
  }
  return worst;
}

}  // namespace howl
