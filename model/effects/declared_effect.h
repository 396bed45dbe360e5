// Effects that a user states instead of programming: a formula at a named place of the loop
// (effect.h), with free parameters. With its parameters at their nulls it is bit for bit the base.
//
//   transfer   H(s; x) at the place: multiplies G, FlameIn, FlameOut or an instrument
//   delay      H = e^(-s d(x)) there; at the place "delay" a factor on tau instead
//   map        recorded signal = m(true signal; x), both without mean, at a recorded place
//   line       a coherent line between two frequencies, in a recorded signal or from a source
//
// Names in formulas: the parameters, pi, and
//   transfer    s (rad/s), f_hz, j; at acoustics also G, omega_hz, xi, N, M
//   flame_in, delay   besides phi_position (-1/2 ... 1/2), amplitude (over the mean), cycle_hz
//   map         x, the true signal
#ifndef HOWL_MODEL_EFFECTS_DECLARED_EFFECT_H_
#define HOWL_MODEL_EFFECTS_DECLARED_EFFECT_H_

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/effects/catalogue.h"
#include "model/numerics/formula.h"

namespace howl {

enum class LoopPlace : std::uint8_t {
  kAcoustics,
  kFlameIn,
  kDelay,
  kFlameOut,
  kSource,
  kPressureRecorded,
  kHeatReleaseRecorded
};
inline constexpr LoopPlace kLoopPlaces[] = {
    LoopPlace::kAcoustics,          LoopPlace::kFlameIn, LoopPlace::kDelay,
    LoopPlace::kFlameOut,           LoopPlace::kSource,  LoopPlace::kPressureRecorded,
    LoopPlace::kHeatReleaseRecorded};

// "flame_in", "p_recorded", ...
std::string_view LoopPlaceName(LoopPlace place);

enum class DeclaredForm : std::uint8_t { kTransfer, kDelay, kMap, kLine };

// Forms that the place can take; what cannot be is absorbed by the base, or has no estimator.
bool PlaceTakes(LoopPlace place, DeclaredForm form);

// A formula with the names of a place and a form.
class DeclaredFormula {
 public:
  static std::optional<DeclaredFormula> Parse(std::string_view text, LoopPlace place,
                                              DeclaredForm form,
                                              const std::vector<EffectParameter>& parameters,
                                              FormulaError& error);

  // fixed: values of the names of the place, in the order of FixedNames.
  Response Evaluate(std::span<const Response> fixed, EffectValues x) const;

  const std::vector<std::string>& Names() const { return names_; }  // that occur in it

 private:
  std::vector<FormulaToken> tokens_;
  std::vector<std::string> names_;
};

std::vector<std::string> FixedNames(LoopPlace place, DeclaredForm form);

struct EffectDeclaration {
  std::string name;
  LoopPlace place = LoopPlace::kHeatReleaseRecorded;
  DeclaredForm form = DeclaredForm::kTransfer;
  std::vector<EffectParameter> parameters;
  // Coefficients of falling powers of s. A formula alone is a numerator over {}, which is one.
  std::vector<DeclaredFormula> numerator;
  std::vector<DeclaredFormula> denominator;
  double line_low_hz = 0.0;  // of a line
  double line_high_hz = 0.0;
};

class DeclaredEffect final : public NamedEffect {
 public:
  explicit DeclaredEffect(EffectDeclaration declaration);

  EffectKind kind() const override;
  bool ChangesAcousticCut() const override;
  bool ChangesFlameCut() const override;
  bool ChangesFlameInput() const override;
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& /*at*/, EffectValues x) const override;
  Response PressureInstrument(double frequency_hz, EffectValues x) const override;
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override;
  Response FlameIn(double frequency_hz, const EffectContext& at, EffectValues x) const override;
  Response FlameOut(double frequency_hz, const EffectContext& /*at*/,
                    EffectValues x) const override;
  double DelayFactor(const EffectContext& at, EffectValues x) const override;
  bool RangesGoWithCycle() const override { return false; }

  // Whether it is a transfer function that is the same at all operating points, of an instrument or
  // of the flame.
  bool IsOneTransfer() const;

  const EffectDeclaration& declaration() const { return declaration_; }
  // The recorded signal of a map; not finite where the map has no value.
  double Map(double true_value, EffectValues x) const;

  // How far the formula at x is from the base, at most, and where: zero at the nulls, but for
  // rounding; NaN where it has no value.
  struct Distance {
    double distance = 0.0;
    double at = 0.0;  // Hz, or x of a map
  };
  Distance FromBase(EffectValues x) const;

 private:
  bool IsAt(LoopPlace place) const { return declaration_.place == place; }
  bool IsNull(EffectValues x) const;
  Response Value(std::span<const Response> fixed, EffectValues x) const;
  Response Formula(double frequency_hz, const howl::Acoustics<double>* acoustics, Response base,
                   const EffectContext* at, EffectValues x) const;

  EffectDeclaration declaration_;
  std::vector<double> null_;
};

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_DECLARED_EFFECT_H_
