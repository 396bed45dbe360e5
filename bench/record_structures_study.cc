// What each structure of the loop is worth on measured records, one operating point at a time:
//
//   record_structures_study CONFIG [EXPERIMENT ...]
//
// A row for each structure, from the paper's loop on, each with the one before in it: nats of
// evidence of whole records, and of the density of either half under the loop that was fitted to
// the other, both above the paper's loop and summed over the operating points; on how many of them
// the halves are better than with the structure before; and the delays.
#include <tbb/parallel_for.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "bench/load_rig.h"
#include "bench/record_structures.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "io/config/reading/config_reading.h"

namespace howl {
namespace {

constexpr std::size_t kStarts = 12;

struct Score {
  double evidence = 0.0;
  double halves = 0.0;
  double delay_of_period = 0.0;
};

PointFit Fit(const RecordSpectra& record, const PointStructure& structure) {
  const PointPrior prior = PriorOf(structure, record);
  return FitPoint(record, structure, prior, StartsOf(record, structure, prior, kStarts, 1));
}

Score ScoreOf(const Record& record, const std::array<Record, 2>& halves, double cycle_hz,
              const PointStructure& structure) {
  const RecordSpectra whole = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  Score out;
  const PointFit fit = Fit(whole, structure);
  out.evidence = fit.log_evidence;
  out.delay_of_period =
      ToPoint(structure, whole.flame.cols(), fit.parameters).path.tau / (2.0 * std::numbers::pi);
  const PointPrior prior = PriorOf(structure, whole);
  for (const std::size_t half : {0, 1}) {
    const RecordSpectra fitted = MakeRecordSpectra(halves[half], whole);
    const RecordSpectra other = MakeRecordSpectra(halves[1 - half], whole);
    const PointFit fit_of_half = FitPoint(fitted, structure, prior, fit.parameters);
    out.halves += LogLikelihood(other, structure, fit_of_half.parameters);
  }
  return out;
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1]);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  const MeasuredRig first_half = HalfOfRecords(rig, false);
  const MeasuredRig second_half = HalfOfRecords(rig, true);
  const std::vector<CutRecord> cuts = MakeCutRecords(rig);
  std::vector<Score> first;
  std::vector<Score> before;
  for (const NamedStructure& each : RecordStructures()) {
    std::vector<Score> scores(rig.size());
    tbb::parallel_for(std::size_t{0}, rig.size(), [&](std::size_t e) {
      scores[e] = ScoreOf(rig[e].record, {first_half[e].record, second_half[e].record},
                          cuts[e].at.cycle_frequency_hz, each.structure);
    });
    if (first.empty()) first = before = scores;
    Score sum;
    std::size_t better = 0;
    for (std::size_t e = 0; e < scores.size(); ++e) {
      sum.evidence += scores[e].evidence - first[e].evidence;
      sum.halves += scores[e].halves - first[e].halves;
      if (scores[e].halves > before[e].halves) ++better;
    }
    std::printf("%-18s evidence %9.1f  halves %9.1f  better on %zu of %zu  tau / T",
                each.name.c_str(), sum.evidence, sum.halves, better, scores.size());
    for (const Score& score : scores) std::printf(" %.3f", score.delay_of_period);
    std::printf("\n");
    std::fflush(stdout);
    before = std::move(scores);
  }
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) { return howl::Run(argc, argv); }
