// What each structure of the loop is worth on measured records of several operating points:
//
//   [STRUCTURES="complex residues,acoustics' lines"] [FLAME_INPUTS=pressure,velocity]
//     joint_records_study CONFIG [EXPERIMENT ...]
//
// FLAME_INPUTS: of pressure_rate, pressure and velocity; all three where not given.
// A row for each structure and input, from the paper's loop on: nats of the density of each point's
// record by the law that the other points give, summed, above the paper's loop; on how many points
// it is better than the structure before; and each point's modes, delay, noise and errors, with
// their intervals. At the end a table of all: nats, and the gap to the free smooth transfers that
// each half of a record shows by itself (held_out_score.h), of what was fitted to the other half;
// then where the most likely of them still leaves most.
#include <glog/logging.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/asked.h"
#include "bench/load_rig.h"
#include "bench/loop_base.h"
#include "bench/record_structures.h"
#include "bench/rig_loop_records.h"
#include "bench/seconds.h"
#include "diagnosis/held_out/common_ceiling.h"
#include "diagnosis/held_out/octave_gaps.h"
#include "diagnosis/held_out/places_left.h"
#include "diagnosis/loop_budget/account/loop_held_out.h"
#include "estimation/joint_records/fitted_loop.h"
#include "estimation/joint_records/half_fits.h"
#include "estimation/joint_records/loop_names.h"
#include "estimation/joint_records/records_fit.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

constexpr std::array<FlameInput, 3> kInputs = {FlameInput::kPressureRate, FlameInput::kPressure,
                                               FlameInput::kVelocity};

struct Row {
  std::string structure;
  FlameInput input = FlameInput::kPressureRate;
  double nats = 0.0;
  HeldOutScore score;
};

// The source's level at twice the cycle's frequency, with the factor that bounds it at 95 %.
void PrintNoise(const FittedLoop& loop) {
  for (const FittedNoise& source : loop.noise) {
    std::size_t at = 0;
    while (at + 1 < source.frequency_hz.size() && source.frequency_hz[at] < 2.0 * loop.cycle_hz) {
      ++at;
    }
    std::printf(" | %s %.2g */%.2f", std::string(LoopNoiseName(source.source)).c_str(),
                source.psd[at], std::exp(1.96 * source.log_std[at]));
    if (source.ratio) std::printf(" p/q %.2f+-%.2f", source.ratio->value, 1.96 * source.ratio->std);
  }
}

void PrintPoint(const std::string& name, const PointStructure& structure,
                const RecordSpectra& record, const PointFit& fit) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), fit.parameters);
  const Eigen::MatrixXd covariance = fit.Covariance();
  const auto half = [&](Eigen::Index i) { return 196.0 * std::sqrt(covariance(i, i)); };
  std::printf("    %-5s %6.1f Hz ", name.c_str(), record.scale.cycle_hz);
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    const LoopMode& mode = point.modes[static_cast<std::size_t>(k)];
    std::printf(" | %6.1f +-%4.1f%% xi %.4f +-%3.0f%% a %6.3f b %6.3f",
                mode.omega * record.scale.cycle_hz, half(structure.Frequency(k)), mode.xi,
                half(structure.Frequencies() + structure.Damping(k)), mode.a, mode.b);
  }
  std::printf(" | tau %.3f ms +-%.1f%%", 1e3 * point.path.tau / record.scale.AngularFrequency(),
              half(structure.Delay()));
  if (structure.HasSpread()) std::printf(" rho %.2f", point.path.rho);
  if (structure.second_path) {
    std::printf(" share %.2f+-%.2f later %.3f ms", point.path.second->share,
                0.01 * half(structure.SecondPath()),
                1e3 * point.path.second->lambda / record.scale.AngularFrequency());
  }
  for (Eigen::Index h = 0; h < point.acoustic_lines.size(); ++h) {
    std::printf("%s %.2f@%.0f", h ? "" : " | d", std::abs(point.acoustic_lines[h]),
                180.0 / std::numbers::pi * std::arg(point.acoustic_lines[h]));
  }
  for (Eigen::Index h = 0; h < point.flame_lines.size(); ++h) {
    std::printf("%s %.2f@%.0f", h ? "" : " | e", std::abs(point.flame_lines[h]),
                180.0 / std::numbers::pi * std::arg(point.flame_lines[h]));
  }
  PrintNoise(FittedLoopOf(record, structure, fit));
  std::printf("%s\n", fit.converged ? "" : " (not converged)");
}

// A row a point: p from q, octave after octave, then q from p; gaps, with shares of 2 % and more.
void PrintOctaves(const std::vector<OctaveGap>& gaps) {
  std::string point;
  LoopBlock block = LoopBlock::kAcoustics;
  for (const OctaveGap& gap : gaps) {
    if (gap.experiment != point || gap.block != block) {
      std::printf("\n%-5s %s", gap.experiment.c_str(), LoopBlockName(gap.block).data());
      point = gap.experiment;
      block = gap.block;
    }
    std::printf(" | %.0f..%.0f %.2f", gap.low_hz, gap.high_hz, gap.gap);
    if (std::abs(gap.share) >= 0.02) std::printf(" (%.0f %%)", 100.0 * gap.share);
  }
  std::printf("\n");
}

void PrintTable(const LoopRecords& records, const std::vector<Row>& rows) {
  CommonCeiling ceiling;
  for (const Row& row : rows) ceiling.Lower(row.score);
  const Row* best = &rows[0];
  std::printf("| structure | flame's input | nats | gap | floor |\n|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    std::printf("| %s | %s | %.0f | %.3f | %.3f |\n", row.structure.c_str(),
                FlameInputName(row.input), row.nats, ceiling.Gap(row.score),
                ceiling.Against(row.score).Floor());
    if (row.nats > best->nats) best = &row;
  }
  const HeldOutScore left = ceiling.Against(best->score);
  PrintOctaves(GapsByOctave(records.names(), records.cycle_hz(), left));
  for (const Place& place : PlacesLeft(records.names(), left)) {
    std::printf("left: %s, %.0f to %.0f Hz, share %.2f at", LoopBlockName(place.block).data(),
                place.low_hz, place.high_hz, place.share);
    for (const std::string& name : place.experiments) std::printf(" %s", name.c_str());
    std::printf("\n");
  }
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1], LoopsTaken::kAny);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  const std::vector<LoopRecord> recorded_as = LoopRecordsOf(rig);
  const LoopRecords recorded(recorded_as, 0);
  std::vector<Row> rows;
  std::vector<double> first;
  for (const FlameInput input : kInputs) {
    if (!Asked("FLAME_INPUTS", FlameInputName(input))) continue;
    std::vector<double> before;
    RecordsFit poorer;
    for (const NamedStructure& each : RecordStructures()) {
      if (!Asked("STRUCTURES", each.name)) continue;
      const double begun = Seconds();
      LoopFit fit{{each.structure, input}, {}, {}};
      std::vector<OperatingPoint> points = recorded.Points(fit.model);
      fit.fit = FitRecords(points, each.structure, {}, before.empty() ? nullptr : &poorer);
      LoopRecords records = recorded;
      records.DriveWithout(fit.model, PressureNoiseOf(points, fit.fit, 0), PointsOf(recorded, fit),
                           0);
      fit.fit = FitDriven(fit.fit, {}, &points);
      FitWithHalves found = GoOnFromHalves(recorded_as, points, std::move(fit.fit), {});
      fit.fit = std::move(found.fit);
      fit.log_density = std::move(found.log_density);
      const double fitted = Seconds();
      if (first.empty()) first = fit.log_density;
      if (before.empty()) before = first;
      double sum = 0.0;
      std::size_t better = 0;
      for (std::size_t e = 0; e < first.size(); ++e) {
        sum += fit.log_density[e] - first[e];
        if (fit.log_density[e] > before[e]) ++better;
      }
      rows.push_back({each.name, input, sum, ScoreHeldOut(records, fit, "", {})});
      std::printf("%-18s %-13s left out %9.1f  better on %zu of %zu  fit %.0f s, left out %.0f s\n",
                  each.name.c_str(), FlameInputName(input), sum, better, first.size(),
                  fitted - begun, Seconds() - fitted);
      for (std::size_t e = 0; e < points.size(); ++e) {
        std::printf("  %9.1f %9.1f", fit.log_density[e], fit.log_density[e] - first[e]);
        PrintPoint(rig[e].name, each.structure, points[e].record, fit.fit.points[e]);
      }
      std::fflush(stdout);
      before = fit.log_density;
      poorer = std::move(fit.fit);
    }
  }
  PrintTable(recorded, rows);
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::KeepFreedMemory();
  return howl::Run(argc, argv);
}
