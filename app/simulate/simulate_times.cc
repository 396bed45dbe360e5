#include "app/simulate/simulate_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "io/memory.h"
#include "io/records/records.h"
#include "io/user_error.h"

namespace howl {
namespace {

// Steps are counted in integers of 31 bits: of the delay, which effects may lengthen some eight
// times, and of a sample.
constexpr double kMostSteps = 1e8;
constexpr double kMostStepsInAll = 1e13;  // half a day at 190 million a second

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

void CheckSimulationTimes(const Config& config, const SimulationTimes& times,
                          std::span<const Experiment> experiments) {
  const LocatedMember* const simulate = config.tree.Find("simulate");
  const auto fail = [&](const char* key, const std::string& what) {
    const LocatedMember* const member = simulate ? simulate->value.Find(key) : nullptr;
    const int line = member ? member->key_line : simulate ? simulate->key_line : 1;
    throw UserError(config.source.string(), line, std::string("simulate.") + key, what);
  };
  const auto highest = std::max_element(
      experiments.begin(), experiments.end(),
      [](const Experiment& a, const Experiment& b) { return a.frequency_hz < b.frequency_hz; });
  if (!(times.sampling_hz > 2.0 * highest->frequency_hz)) {
    fail("sampling_hz", Short(times.sampling_hz) + " Hz does not show the cycle of " +
                            highest->name + " at " + Short(highest->frequency_hz) +
                            " Hz, expected more than twice its frequency");
  }
  const double samples = times.duration_s * times.sampling_hz;
  if (!(samples >= static_cast<double>(kFewestSamples))) {
    fail("duration_s", Short(times.duration_s) + " s at " + Short(times.sampling_hz) +
                           " Hz leaves " + Short(std::round(samples)) +
                           " samples, expected at least " + std::to_string(kFewestSamples));
  }
  // p and q of all records are held.
  const double bytes = 2.0 * sizeof(double) * samples * static_cast<double>(experiments.size());
  const double memory = MemoryBytes();
  if (bytes > memory) {
    fail("duration_s", Short(samples) + " samples in each of " +
                           std::to_string(experiments.size()) + " records need " +
                           Short(bytes * 1e-9) + " GB of memory, expected at most " +
                           Short(memory * 1e-9) + ": a shorter duration_s or a lower sampling_hz");
  }
}

void CheckInternalRate(const Config& config, const SimulationTimes& times,
                       const Experiment& experiment, const RigParameters& rig) {
  const double internal_hz = InternalRate(rig, times.sampling_hz);
  const double tau_s = rig.model.loop.tau_s;
  const LocatedMember* const simulate = config.tree.Find("simulate");
  const auto fail = [&](const std::string& what) {
    throw UserError(config.source.string(), simulate ? simulate->key_line : 1, "simulate",
                    experiment.name + " " + what);
  };
  const double of_delay = internal_hz * tau_s;
  const double of_sample = internal_hz / times.sampling_hz;
  if (!(std::max(of_delay, of_sample) <= kMostSteps)) {
    fail("takes " + Short(of_delay) + " steps for its delay of " + Short(tau_s) + " s and " +
         Short(of_sample) + " for a sample, expected at most " + Short(kMostSteps) +
         " of each: a sampling_hz nearer to its frequency");
  }
  const double steps = (times.duration_s + times.settle_s) * internal_hz;
  if (!(steps <= kMostStepsInAll)) {
    fail("takes " + Short(steps) + " steps of the scheme, expected at most " +
         Short(kMostStepsInAll) + ": a shorter duration_s or settle_s");
  }
}

}  // namespace howl
