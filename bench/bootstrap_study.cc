// Whether the bootstrap's p-values are those of rigs with no effect (null_rig.h): for the best
// candidate they should be uniform. Prints each rig's gain and p-value, and how many lie below some
// levels, with 95 % intervals (Wilson).
//
//   bootstrap_study RIGS REPLICATES SEED [EFFECT...]      the catalogue: these effects; none: all
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/null_rig.h"
#include "estimation/parallel.h"
#include "model/effects/catalogue.h"
#include "trial/tally.h"

int main(int argc, char** argv) {
  using namespace howl;
  if (argc < 4) {
    std::fprintf(stderr, "usage: bootstrap_study RIGS REPLICATES SEED [EFFECT...]\n");
    return 2;
  }
  const auto rigs = static_cast<std::size_t>(std::atoi(argv[1]));
  const auto seed = static_cast<std::uint64_t>(std::atoll(argv[3]));
  const std::vector<std::string> kept(argv + 4, argv + argc);
  DiagnosisOptions options;
  options.bootstrap = static_cast<std::size_t>(std::atoi(argv[2]));
  options.threads = 1;
  for (const EffectPointer& effect : Catalogue()) {
    const std::string id(effect->id());
    if (!kept.empty() && std::find(kept.begin(), kept.end(), id) == kept.end()) {
      options.withheld.push_back(id);
    }
  }
  std::vector<double> p_value(rigs);
  RunUnits(rigs, 0, [&](std::size_t i) {
    const NullRig rig = DrawNullRig(DeriveSeed(seed, i));
    const Diagnosis found = Diagnose(Recorded(rig), options);
    const Candidate& best = found.candidates.at(0);
    p_value[i] = best.p_value;
    std::printf("%4zu %s: %s gain %.1f, noise at most %.1f, p %.3f\n", i, rig.text.c_str(),
                best.effect.c_str(), best.gain, found.bootstrap_gains.back(), best.p_value);
    std::fflush(stdout);
  });
  for (const double level : {0.05, 0.1, 0.2, 0.5, 0.8}) {
    Tally below;
    for (const double p : p_value) below.Count(p <= level + 1e-12);
    std::printf("p <= %.2f: %d of %d (95 %%: %.3f to %.3f)\n", level, below.right, below.total,
                below.Low(), below.High());
  }
  return 0;
}
