// The falsification test: a model (one LoopModel for each experiment) is a member of the family of
// unfalsified models when no condition rejects it. With z = G(j 2 pi f) at the limit-cycle
// frequency f of each experiment, the conditions are
//
//   gain_tolerance             | |z| / gain - 1 |        <= tolerance      (5a), (5c)
//   phase_tolerance_deg        | arg z - phase |         <= tolerance      (5a), (5c)
//   loop_phase_tolerance_deg   | arg L - 180 degrees |   <= tolerance      (1a)
//   loop_gain_min              |L Phi'(0)|               >= minimum        (1b), reliable ones:
//                              of the steepest slope that the data allow (Experiment's
//                              SteepestSlope)
//   second_crossing_tolerance_deg  the same as (1a) at every observed line
//   omega_spread_max           max omega / min omega - 1 <= maximum        over experiments
//   xi_max                     xi                        <= maximum
//   xi_increasing              xi does not fall as phi grows
//   second_mode_share_max      |M U_r| / |N U_1| at f    <= maximum        (5b): the second mode
//                              hardly matters at the limit cycle (two modes)
//   second_crossing_gain_min   |L Phi'(0)| at every observed line >= minimum   (1b) at the second
//                              crossing (two modes, reliable experiments with a flame slope)
//   transfer_distance_max      distance of (omega, xi, N, M) from the broadband q-to-p transfer, in
//                              standard deviations of one number
//                              (estimation/analysis/transfer/transfer_ellipsoid.h): experiments
//                              whose record has one
//
// An infinite tolerance or maximum, or a minimum of zero, switches its condition off.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBERSHIP_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBERSHIP_H_

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "estimation/residual_spec.h"

namespace howl {

enum class Condition {
  kGain,
  kPhase,
  kLoopPhase,
  kLoopGain,
  kSecondCrossing,
  kOmegaSpread,
  kXiMax,
  kXiIncreasing,
  kTransfer,
  kSecondModeShare,
  kSecondCrossingGain,
};

inline constexpr std::array kConditions = {Condition::kGain,
                                           Condition::kPhase,
                                           Condition::kLoopPhase,
                                           Condition::kLoopGain,
                                           Condition::kSecondCrossing,
                                           Condition::kOmegaSpread,
                                           Condition::kXiMax,
                                           Condition::kXiIncreasing,
                                           Condition::kTransfer,
                                           Condition::kSecondModeShare,
                                           Condition::kSecondCrossingGain};
inline constexpr std::size_t kNumConditions = kConditions.size();

// The condition's key in a config's `family: test:`.
constexpr std::string_view ConditionName(Condition condition) {
  constexpr std::array<std::string_view, kNumConditions> kNames = {"gain_tolerance",
                                                                   "phase_tolerance_deg",
                                                                   "loop_phase_tolerance_deg",
                                                                   "loop_gain_min",
                                                                   "second_crossing_tolerance_deg",
                                                                   "omega_spread_max",
                                                                   "xi_max",
                                                                   "xi_increasing",
                                                                   "transfer_distance_max",
                                                                   "second_mode_share_max",
                                                                   "second_crossing_gain_min"};
  return kNames[static_cast<std::size_t>(condition)];
}

struct MembershipTest {
  double gain_tolerance = 0.01;
  double phase_tolerance_deg = 0.5;
  double loop_phase_tolerance_deg = 1.0;
  double loop_gain_min = 1.0;
  double second_crossing_tolerance_deg = 10.0;
  double omega_spread_max = 0.25;
  double xi_max = 0.3;
  bool xi_increasing = true;
  // The squared distance of a true model is chi-square with four degrees of freedom at most: it is
  // beyond 4 with a probability of 0.3 % an experiment, 2 % over six of them.
  double transfer_distance_max = 4.0;
  // estimation/residual_spec.h says where these two come from.
  double second_mode_share_max = kSecondModeShareMax;
  double second_crossing_gain_min = 1.0;
};

// The errors of one experiment's model against the data; zero is a perfect fit.
struct ExperimentErrors {
  double gain_error = 0.0;            // |z| / gain - 1
  double phase_error_deg = 0.0;       // arg z - phase, wrapped
  double loop_phase_error_deg = 0.0;  // arg L - 180 degrees, wrapped
  // |L Phi'(0)| with the slope's estimate, and with the steepest that the data allow; NaN where no
  // slope is known.
  double loop_gain = std::numeric_limits<double>::quiet_NaN();
  double largest_loop_gain = std::numeric_limits<double>::quiet_NaN();
  double second_crossing_error_deg = 0.0;  // largest over the lines; zero without lines
  double transfer_distance = 0.0;          // zero without a transfer
  double second_mode_share = 0.0;          // |M U_r| / |N U_1| at the limit cycle
  // Smallest |L Phi'(0)| over the lines; NaN without lines, or where the slope is not known.
  double second_crossing_gain = std::numeric_limits<double>::quiet_NaN();
};

// Errors in the full form (5a); with M = 0 it is the reduced form (5c).
ExperimentErrors ComputeErrors(const Experiment& experiment, const LoopModel& model);

// True where second_crossing_gain_min applies to the experiment: like loop_gain_min, to reliable
// ones alone.
bool TestsLineGain(const Experiment& experiment, const MembershipTest& test);

// Smallest |L Phi'(0)| over the experiment's lines; NaN without lines or without a flame slope.
double SecondCrossingGain(const Experiment& experiment, const LoopParameters<double>& loop);

// Tests second_mode_share_max and second_crossing_gain_min alone, for a model with two modes; its
// tau does not matter.
bool KeepsSecondMode(const Experiment& experiment, const LoopModel& model,
                     const MembershipTest& test);

// A set of Conditions.
class ConditionSet {
 public:
  void Insert(Condition condition) { bits_ |= 1u << static_cast<unsigned>(condition); }
  bool Contains(Condition condition) const {
    return (bits_ >> static_cast<unsigned>(condition)) & 1u;
  }
  bool IsEmpty() const { return bits_ == 0; }

 private:
  unsigned bits_ = 0;
};

// The conditions that reject the model; empty for a member. models[i] belongs to experiments[i].
ConditionSet Falsify(std::span<const Experiment> experiments, std::span<const LoopModel> models,
                     const MembershipTest& test);

inline bool IsMember(std::span<const Experiment> experiments, std::span<const LoopModel> models,
                     const MembershipTest& test) {
  return Falsify(experiments, models, test).IsEmpty();
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBERSHIP_H_
