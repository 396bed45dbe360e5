// Which residuals a joint fit has, the weight of each, and on which experiments it acts. Their
// equations and defaults are in estimation/residuals/.
#ifndef HOWL_ESTIMATION_RESIDUAL_SPEC_H_
#define HOWL_ESTIMATION_RESIDUAL_SPEC_H_

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

// The registry: one line a residual, its identifier and its name in configs. All else that there is
// to say of a residual is the ResidualDefinition that its file in estimation/residuals/ gives
// (residuals/registry.h). Residuals are added to a problem, and reported, in this order.
#define HOWL_RESIDUALS(X)                     \
  X(GainEquality, gain_equality)              \
  X(PhaseEquality, phase_equality)            \
  X(LimitCycleGain, limit_cycle_gain)         \
  X(LimitCyclePhase, limit_cycle_phase)       \
  X(SecondCrossing, second_crossing)          \
  X(SecondModeMinor, second_mode_minor)       \
  X(SecondCrossingGain, second_crossing_gain) \
  X(DampingPrior, damping_prior)              \
  X(OmegaPrior, omega_prior)                  \
  X(TauPrior, tau_prior)                      \
  X(XiIncreasing, xi_increasing)              \
  X(Transfer, transfer)

#define HOWL_RESIDUAL_ENUMERATOR(identifier, name) k##identifier,
enum class ResidualKind { HOWL_RESIDUALS(HOWL_RESIDUAL_ENUMERATOR) };
#undef HOWL_RESIDUAL_ENUMERATOR

#define HOWL_RESIDUAL_KIND(identifier, name) ResidualKind::k##identifier,
inline constexpr std::array kResidualKinds = {HOWL_RESIDUALS(HOWL_RESIDUAL_KIND)};
#undef HOWL_RESIDUAL_KIND
inline constexpr std::size_t kNumResidualKinds = kResidualKinds.size();

// The names in configs.
constexpr std::string_view ResidualName(ResidualKind kind) {
#define HOWL_RESIDUAL_NAME(identifier, name) #name,
  constexpr std::array<std::string_view, kNumResidualKinds> kNames = {
      HOWL_RESIDUALS(HOWL_RESIDUAL_NAME)};
#undef HOWL_RESIDUAL_NAME
  return kNames[static_cast<std::size_t>(kind)];
}

// What the second mode may add at the limit cycle, relative to the first. The paper neglects it
// there, (5b). With its own figures (M / N up to 0.92, where both cycles of its section 4 coexist,
// omega 215 Hz, f 219.9 Hz) the share is 0.05 at xi = 0.2 and 0.09 at xi = 0.4; on the other
// branch, where the second mode carries the cycle, it is of the order of one.
inline constexpr double kSecondModeShareMax = 0.1;

// kAuto: the full form (5a) with two modes, the reduced form (5c) with one.
enum class EquationForm { kAuto, kFull, kReduced };

enum class LossKind { kNone, kHuber, kSoftL1, kCauchy, kTukey };

struct ResidualSpec {
  bool enabled = true;
  // Standard deviation of the residual's error, in the unit that its key tells (std_relative,
  // std_deg, std). Experiments that bring their own take its place.
  double std = 1.0;
  // The residual's second number, where its definition has one (xi_typical, share_max).
  double center = 0.0;
  double weight = 1.0;  // multiplies the squared residual
  LossKind loss = LossKind::kNone;
  double loss_scale = 1.0;               // in standard deviations
  std::vector<std::string> experiments;  // empty: all
  EquationForm form = EquationForm::kAuto;
};

struct ResidualSet {
  std::array<ResidualSpec, kNumResidualKinds> specs;
  // Multiplies the weight of every residual of an experiment marked `reliable: false`.
  double unreliable_weight = 0.25;

  ResidualSpec& operator[](ResidualKind kind) { return specs[static_cast<std::size_t>(kind)]; }
  const ResidualSpec& operator[](ResidualKind kind) const {
    return specs[static_cast<std::size_t>(kind)];
  }
};

// Every residual on, with the standard deviation of its definition.
ResidualSet DefaultResidualSet();

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUAL_SPEC_H_
