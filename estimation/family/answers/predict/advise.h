// The effect of further experiments on the family: which members survive experiments that were
// made, and which experiment, not made yet, would remove most of the family.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_ADVISE_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_ADVISE_H_

#include <string>
#include <vector>

#include "estimation/family/answers/predict/predict.h"
#include "estimation/family/problem/problem.h"

namespace howl {

enum class Survival { kSurvives, kRejected, kUntested };

struct SurvivalCounts {
  std::size_t survive = 0;
  std::size_t rejected = 0;
  std::size_t untested = 0;
  std::array<std::size_t, kNumConditions> rejected_by{};  // a member may count under several
};

struct SurvivalResult {
  std::vector<Survival> of_member;
  SurvivalCounts counts;
};

// Each further experiment is compared with the member's model of the experiment with the same phi,
// else with the model interpolated in phi. Its gain, phase, loop phase, loop gain and lines are
// tested, with its own frequency. Further experiments outside the measured range of phi test
// nothing; a member that none tests is kUntested.
SurvivalResult TestFurther(const FamilyProblem& problem, std::span<const Member> members,
                           std::span<const Experiment> further);

// A measurement that could be made: a member's prediction of it, and the error that it would have.
struct Measurement {
  std::string name;
  std::string unit;
  double std = 1.0;
  MemberPredictor predictor;
};

struct Advice {
  std::string name;
  double std = 1.0;
  // Share of the family (of the members given, which should be uniform) that is expected to be
  // left: each member is taken as the truth in turn, its measurement is made with a normal error,
  // and those within `kept_within` standard deviations of it stay. 1: the measurement tells
  // nothing.
  double expected_remaining = 1.0;
  Range predicted{1.0, -1.0};  // over the members
};

// Sorted, the one that removes most first. Members for which a measurement has no value are neither
// taken as the truth nor removed by it.
std::vector<Advice> Advise(std::span<const Member> members,
                           std::span<const Measurement> measurements, double kept_within = 2.0);

struct MeasurementStds {
  double phase_deg = 0.5;
  double gain_relative = 0.01;
  double frequency_relative = 0.5 / 220.0;  // 0.5 Hz of the paper's 220 Hz
  double line_relative = 2.0 / 750.0;       // 2 Hz of the paper's 750 Hz
};

// The band in which the line that the paper observes near 750 Hz is looked for, in multiples of the
// limit cycle's frequency. It lies about the second mode, whose frequency is harmonic_ratio times
// the first's.
Range LineBand(double frequency_hz, double harmonic_ratio);

// The measurements that a rig offers: the limit cycle's frequency, and phase and gain of G there,
// at a phi half-way between each two neighbours; the transfer from q to p at a second frequency,
// half and 1.5 and twice the limit cycle's, of each experiment; the line of LineBand of each
// experiment. A growth rate needs the loop's poles: add a Measurement with a predictor for it.
std::vector<Measurement> DefaultMeasurements(const std::vector<Experiment>& experiments,
                                             double harmonic_ratio,
                                             const MeasurementStds& stds = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_ADVISE_H_
