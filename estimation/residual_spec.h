// Which residuals a joint fit has, the weight of each, and on which experiments it acts. The
// equations are in estimation/residuals/, one file each.
#ifndef HOWL_ESTIMATION_RESIDUAL_SPEC_H_
#define HOWL_ESTIMATION_RESIDUAL_SPEC_H_

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

enum class ResidualKind {
  kGainEquality,        // |G| = gain, (5a) or (5c)
  kPhaseEquality,       // arg G = phase, (5a) or (5c)
  kLimitCyclePhase,     // arg L = 180 degrees, (1a)
  kLimitCycleGain,      // |L Phi'(0)| > 1, (1b), one-sided
  kSecondCrossing,      // arg L = 180 degrees at an observed non-harmonic line
  kTransfer,            // G = H, the measured q-to-p transfer away from the limit cycle, (5a)
  kOmegaPrior,          // omega nearly constant over the experiments
  kXiIncreasing,        // xi does not fall as phi grows, one-sided
  kDampingPrior,        // xi small
  kTauPrior,            // tau nearly constant over the experiments
  kSecondModeMinor,     // |M U_r| / |N U_1| small at the limit cycle, (5b), one-sided
  kSecondCrossingGain,  // |L Phi'(0)| > 1 at an observed non-harmonic line, (1b), one-sided
};

inline constexpr std::array kResidualKinds = {
    ResidualKind::kGainEquality,    ResidualKind::kPhaseEquality,
    ResidualKind::kLimitCyclePhase, ResidualKind::kLimitCycleGain,
    ResidualKind::kSecondCrossing,  ResidualKind::kTransfer,
    ResidualKind::kOmegaPrior,      ResidualKind::kXiIncreasing,
    ResidualKind::kDampingPrior,    ResidualKind::kTauPrior,
    ResidualKind::kSecondModeMinor, ResidualKind::kSecondCrossingGain};
inline constexpr std::size_t kNumResidualKinds = kResidualKinds.size();
static_assert(
    [] {
      for (std::size_t i = 0; i < kNumResidualKinds; ++i) {
        if (static_cast<std::size_t>(kResidualKinds[i]) != i) return false;
      }
      return true;
    }(),
    "kResidualKinds lists the kinds in their order: names and specs are looked up by it");

// The names in configs.
constexpr std::string_view ResidualName(ResidualKind kind) {
  constexpr std::array<std::string_view, kNumResidualKinds> kNames = {
      "gain_equality",   "phase_equality", "limit_cycle_phase", "limit_cycle_gain",
      "second_crossing", "transfer",       "omega_prior",       "xi_increasing",
      "damping_prior",   "tau_prior",      "second_mode_minor", "second_crossing_gain"};
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
  // Standard deviation of the residual's error. Relative for gain, omega, tau and the damping
  // prior; degrees for phases; absolute for loop gains, the second mode's share and the order of
  // xi. For the transfer: of the
  // model itself, relative, on top of each point's own variance. Experiments that bring
  // their own take its place.
  double std = 1.0;
  // damping_prior: the damping ratio that counts as small; second_mode_minor: the share up to which
  // the second mode hardly matters.
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

// Documented defaults: every residual on.
ResidualSet DefaultResidualSet();

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUAL_SPEC_H_
