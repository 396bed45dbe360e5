// Questions to the family's members once they are drawn: predictions that have no closed
// expression, further experiments, and which measurement would tell most.
#ifndef HOWL_APP_FAMILY_FAMILY_QUESTIONS_H_
#define HOWL_APP_FAMILY_FAMILY_QUESTIONS_H_

#include <span>
#include <vector>

#include "estimation/family/answers/predict/advise.h"
#include "io/config/simulation_spec.h"
#include "io/results/family/family_json.h"

namespace howl {

// Members evenly spaced in the list, which are a part of a uniform sample.
std::vector<Member> Thinned(std::span<const Member> members, std::size_t most);

// Of each experiment with a flame slope: growth rate of the rest state (1/s),
// gain margin (dB), phase margin (deg); with two modes the line near 750 Hz (Hz) and the loop's
// gain there. All sampled, over the members given.
// With a flame stated by the config, its slope at rest being the experiment's, also the amplitude
// of p in the limit cycle.
std::vector<ExperimentPrediction> PredictLoops(const FamilyProblem& problem,
                                               const SimulationSpec& simulation,
                                               std::span<const Member> members, int threads);

// DefaultMeasurements, and the growth rate of each experiment that has a flame slope.
std::vector<Advice> AdviseMeasurements(const FamilyProblem& problem,
                                       std::span<const Member> members);

}  // namespace howl

#endif  // HOWL_APP_FAMILY_FAMILY_QUESTIONS_H_
