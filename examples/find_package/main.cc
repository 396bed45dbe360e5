// Fits the published limit cycles of test R228 (Savaresi, Bitmead and Dunstan, 2001) and prints the
// loop at each: acoustics N s / (s^2 + 2 omega xi s + omega^2), delay tau, and the loop gain.
#include <cstdio>

#include "estimation/family/problem/membership.h"
#include "estimation/fit/joint_fit.h"

int main() {
  // name, equivalence ratio, frequency in Hz, phase from q to p in degrees, |p| / |q|, Phi'(0)
  const howl::JointProblem problem({{"exp1", 0.56, 219.9, -5.74, 12.14, -0.703e-4},
                                    {"exp2", 0.53, 209.1, -9.44, 13.15, -0.707e-4},
                                    {"exp3", 0.51, 205.7, -14.35, 14.79, -0.670e-4}},
                                   howl::DefaultModelSpec(), howl::DefaultResidualSet());
  const int starts_seed = 1, threads = 1;
  const howl::JointFit fit = howl::SolveJoint(problem, {}, starts_seed, threads);
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    const howl::LoopModel& model = fit.models[i];
    const howl::Experiment& experiment = problem.experiments()[i];
    std::printf("%s: omega %.1f Hz, tau %.3f ms, loop gain %.3f\n", experiment.name.c_str(),
                model.omega_hz, 1e3 * model.tau_s,
                howl::ComputeErrors(experiment, model).loop_gain);
  }
  std::printf("%d directions determined of %zu parameters\n", fit.identifiability.rank,
              fit.free_names.size());
  return fit.converged ? 0 : 1;
}
