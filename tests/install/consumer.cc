// Fits one published experiment with an installed howl.
#include <cmath>
#include <cstdio>

#include "estimation/fit/joint_fit.h"

int main() {
  howl::Experiment experiment;
  experiment.name = "exp1";
  experiment.phi = 0.56;
  experiment.frequency_hz = 219.9;
  experiment.phase_deg = -5.74;
  experiment.gain = 12.14;
  const howl::JointProblem problem({experiment}, howl::DefaultModelSpec(),
                                   howl::DefaultResidualSet());
  const howl::JointFit fit = howl::SolveJoint(problem, {}, 1, 1);
  // Equation (3) on this row gives 3.338 ms.
  const double tau_ms = 1e3 * fit.models.front().tau_s;
  std::printf("tau %.3f ms\n", tau_ms);
  return fit.converged && std::abs(tau_ms - 3.338) < 0.001 ? 0 : 1;
}
