// What is believed of a flame's curve before a record is seen (flame_functions.h), and what follows
// for records:
//
//   flame_prior_study [RECORDS [CONFIG [EXPERIMENT ...]]]
//
// A row for each prior. On simulated records of a duct whose delay is one, each fitted from the
// truth, then with the flame driven by what its noise leaves of p: nats of evidence, on average,
// above the first row; nats of evidence for spread delays, which it has not, on average, and in
// what share of records they are more likely than one delay; and the delay's mean error and root
// mean square error, in its deviations. On a config's measured records: nats of evidence, and of
// the density of either half under the loop of the other, summed.
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "estimation/kept_memory.h"
#include "estimation/record_fit/loop/pressure_noise.h"
#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/starts/path_starts.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "io/config/reading/config_reading.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl {
namespace {

constexpr std::size_t kStarts = 6;
constexpr double kSeconds = 0.8;

struct Simulated {
  double evidence = 0.0;
  double for_spread = 0.0;
  double spread_share = 0.0;
  double delay_bias = 0.0;
  double delay_square = 0.0;
};

PointFit FitFrom(const RecordSpectra& record, const PointStructure& structure,
                 const LoopPoint& point) {
  return FitPoint(record, structure, PriorOf(structure, record), ToParameters(structure, point));
}

void Add(const FlamePrior& prior, double gain, std::uint64_t seed, double weight, Simulated* sum) {
  ModalLoop loop = DuctOfModes(2);
  loop.slope = gain / loop.Open(CycleFrequency(loop, 150.0, 300.0)).real();
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  RecordSpectra record = MakeRecordSpectra(SimulateModalLoop(loop, kSeconds, seed), cycle_hz,
                                           FlameInput::kPressureRate, prior);
  PointStructure structure;
  structure.modes = 2;
  structure.noise = LeastNoise();
  LoopPoint point = WithTruthOf(
      loop, record.scale, ToPoint(structure, record.flame.cols(), PriorOf(structure, record).mean));
  point.flame = PathStarts(record).Flame(point.path);
  const PointFit first = FitFrom(record, structure, point);
  record = DrivenWithout(std::move(record), PressureNoise(record, structure, first.parameters));
  const PointFit fit =
      FitFrom(record, structure, ToPoint(structure, record.flame.cols(), first.parameters));
  const Eigen::Index delay = structure.Delay();
  const double z = (fit.parameters[delay] - std::log(point.path.tau)) /
                   std::sqrt(fit.Covariance()(delay, delay));
  PointStructure spread = structure;
  spread.delay_spread = DelaySpread::kGamma;
  LoopPoint spread_point = ToPoint(structure, record.flame.cols(), fit.parameters);
  spread_point.path.spread = DelaySpread::kGamma;
  double evidence = -std::numeric_limits<double>::infinity();
  for (const double rho : {0.03, 0.1, 0.25}) {
    spread_point.path.rho = rho;
    evidence = std::max(evidence, FitFrom(record, spread, spread_point).log_evidence);
  }
  sum->evidence += weight * fit.log_evidence;
  sum->for_spread += weight * (evidence - fit.log_evidence);
  sum->spread_share += evidence > fit.log_evidence ? weight : 0.0;
  sum->delay_bias += weight * z;
  sum->delay_square += weight * z * z;
}

Simulated OnSimulated(const FlamePrior& prior, int records) {
  constexpr std::array kGains = {1.2, 1.5, 1.8, 3.0, 6.0};
  Simulated out;
  for (int i = 0; i < records; ++i) {
    const double gain = kGains[static_cast<std::size_t>(i) % kGains.size()];
    Add(prior, gain, 100 + static_cast<std::uint64_t>(i), 1.0 / records, &out);
  }
  return out;
}

struct Measured {
  double evidence = 0.0;
  double halves = 0.0;
};

Measured OnMeasured(const FlamePrior& prior, const Config& config, const MeasuredRig& rig) {
  const RecordLoopSpec spec = config.record_loop.value_or(RecordLoopSpec{});
  const PointStructure structure = StructureOf(spec, spec.modes);
  const std::array<MeasuredRig, 2> halves = {HalfOfRecords(rig, false), HalfOfRecords(rig, true)};
  const std::vector<CutRecord> cuts = MakeCutRecords(rig);
  std::vector<Measured> all(rig.size());
  tbb::parallel_for(std::size_t{0}, rig.size(), [&](std::size_t e) {
    const RecordSpectra whole =
        MakeRecordSpectra(rig[e].record, cuts[e].at.cycle_frequency_hz, spec.flame_input, prior);
    const PointPrior of_point = PriorOf(structure, whole);
    const PointFit fit =
        FitPoint(whole, structure, of_point, StartsOf(whole, structure, of_point, kStarts, 1));
    all[e].evidence = fit.log_evidence;
    for (const std::size_t half : {0, 1}) {
      const RecordSpectra here = MakeRecordSpectra(halves[half][e].record, whole);
      const RecordSpectra other = MakeRecordSpectra(halves[1 - half][e].record, whole);
      all[e].halves += LogLikelihood(
          other, structure, FitPoint(here, structure, of_point, fit.parameters).parameters);
    }
  });
  Measured sum;
  for (const Measured& each : all) {
    sum.evidence += each.evidence;
    sum.halves += each.halves;
  }
  return sum;
}

void Run(int argc, char** argv) {
  const int records = argc > 1 ? std::atoi(argv[1]) : 40;
  std::optional<Config> config;
  MeasuredRig rig;
  if (argc > 2) {
    config = LoadConfig(argv[2], LoopsTaken::kAny);
    rig = LoadRig(*config, {argv + 3, argv + argc});
  }
  std::optional<double> first;
  for (const FlamePrior& prior :
       {FlamePrior{}, FlamePrior{1.5, 1.0, 1.0}, FlamePrior{6.0, 1.0, 1.0},
        FlamePrior{3.0, 0.5, 1.0}, FlamePrior{3.0, 2.0, 1.0}, FlamePrior{3.0, 1.0, 0.5},
        FlamePrior{3.0, 1.0, 2.0}}) {
    const Simulated s = OnSimulated(prior, records);
    if (!first) first = s.evidence;
    std::printf(
        "slope %.1f, size %.1f, length %.1f: nats %+.1f, for spread delays %.1f (in %.2f), "
        "delay %+.2f, rms %.2f",
        prior.slope, prior.size, prior.length, s.evidence - *first, s.for_spread, s.spread_share,
        s.delay_bias, std::sqrt(s.delay_square));
    if (config) {
      const Measured m = OnMeasured(prior, *config, rig);
      std::printf("; measured: %.1f, halves %.1f", m.evidence, m.halves);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::KeepFreedMemory();
  howl::Run(argc, argv);
  return 0;
}
