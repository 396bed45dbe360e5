// What `fit` says of records of rigs that are known exactly (tests/estimation/fit_rows.h): for
// every parameter of every experiment the bias and the scatter of (ln fitted - ln true) / std, and
// the share of its 95 % intervals that hold the truth; beside it the same of the transfer's own
// fit, and the mean square distance of the truth in the transfer's ellipsoid over its degrees of
// freedom.
//
//   fit_study [DRAWS] [SEED] [SENSOR_NOISE [SENSOR_NOISE_OF_Q]]
//                      relative to the cycle's amplitude; 0.001 as in `simulate`
#include <cstdio>
#include <cstdlib>

#include "tests/estimation/fit_rows.h"

namespace howl::fixtures {
namespace {

void Print(const std::string& name, const FitScore& score) {
  const double mean = score.sum / score.count;
  std::printf("  %-26s %5d  bias %+6.2f std  scatter %5.2f std  covered %5.1f %%  std %.3g %%\n",
              name.c_str(), score.count, mean,
              std::sqrt(std::max(score.squares / score.count - mean * mean, 0.0)),
              100.0 * score.covered / score.count, 100.0 * score.std / score.count);
}

void Print(const StudiedRig& rig, int draws, const FitStudy& study) {
  std::printf("%s: %d draws, %d fits did not converge\n", rig.name, draws, study.not_converged);
  for (const auto& [name, score] : study.fit) Print("fit " + name, score);
  Print("fit, all", FitStudy::All(study.fit));
  for (const auto& [name, score] : study.transfer) Print("transfer " + name, score);
  Print("transfer, all", FitStudy::All(study.transfer));
  const int count = std::max(study.ellipsoids, 1);
  std::printf(
      "  truth's square distance over its degrees of freedom %.2f, beyond the default test: %d of "
      "%d; chi-square per degree %.2f\n",
      study.square_distance / count, study.beyond_default, study.ellipsoids,
      study.chi_square_per_dof / count);
  std::fflush(stdout);
}

}  // namespace
}  // namespace howl::fixtures

int main(int argc, char** argv) {
  using namespace howl::fixtures;
  const int draws = argc > 1 ? std::atoi(argv[1]) : 40;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const double noise_p = argc > 3 ? std::atof(argv[3]) : 0.001;
  const double noise_q = argc > 4 ? std::atof(argv[4]) : noise_p;
  for (const StudiedRig& rig : StudiedRigs()) {
    Print(rig, draws, StudyFits(rig, draws, seed, noise_p, noise_q));
  }
  return 0;
}
