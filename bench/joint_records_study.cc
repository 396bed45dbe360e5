// What each structure of the loop is worth on measured records of several operating points:
//
//   [STRUCTURES="complex residues,acoustics' lines"] [FLAME_INPUT=velocity]
//     joint_records_study CONFIG [EXPERIMENT ...]
//
// FLAME_INPUT: pressure_rate, pressure or velocity.
// A row for each structure, from the paper's loop on: nats of the density of each point's record by
// the law that the other points give, summed, above the paper's loop; on how many points it is
// better than the structure before; and the delays. Then each structure's modes, delay and levels
// of noise over the points, with the law's mean and spread.
#include <glog/logging.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "bench/load_rig.h"
#include "bench/record_structures.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "estimation/joint_records/records_fit.h"
#include "io/config/reading/config_reading.h"

namespace howl {
namespace {

double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
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
                mode.omega * record.scale.cycle_hz, half(structure.ratio ? 0 : k), mode.xi,
                half(structure.Frequencies() + (structure.own_damping ? k : 0)), mode.a, mode.b);
  }
  std::printf(" | tau %.3f ms +-%.1f%%",
              1e3 * point.path.tau / (2.0 * std::numbers::pi * record.scale.cycle_hz),
              half(structure.Delay()));
  if (structure.Delays() > 1) std::printf(" rho %.2f", point.path.rho);
  for (Eigen::Index h = 0; h < point.acoustic_lines.size(); ++h) {
    std::printf("%s %.2f@%.0f", h ? "" : " | d", std::abs(point.acoustic_lines[h]),
                180.0 / std::numbers::pi * std::arg(point.acoustic_lines[h]));
  }
  for (Eigen::Index h = 0; h < point.flame_lines.size(); ++h) {
    std::printf("%s %.2f@%.0f", h ? "" : " | e", std::abs(point.flame_lines[h]),
                180.0 / std::numbers::pi * std::arg(point.flame_lines[h]));
  }
  std::printf("%s\n", fit.converged ? "" : " (not converged)");
}

FlameInput InputAsked() {
  const char* const asked = std::getenv("FLAME_INPUT");
  const std::string input = asked ? asked : "pressure_rate";
  if (input == "pressure") return FlameInput::kPressure;
  if (input == "velocity") return FlameInput::kVelocity;
  CHECK_EQ(input, "pressure_rate");
  return FlameInput::kPressureRate;
}

int Run(int argc, char** argv) {
  const Config config = LoadConfig(argv[1]);
  const MeasuredRig rig = LoadRig(config, {argv + 2, argv + argc});
  const std::vector<CutRecord> cuts = MakeCutRecords(rig);
  std::vector<OperatingPoint> points(rig.size());
  tbb::parallel_for(std::size_t{0}, rig.size(), [&](std::size_t e) {
    points[e] = {rig[e].phi,
                 MakeRecordSpectra(rig[e].record, cuts[e].at.cycle_frequency_hz, InputAsked())};
  });
  std::vector<double> first;
  std::vector<double> before;
  RecordsFit poorer;
  const char* const only = std::getenv("STRUCTURES");
  for (const NamedStructure& each : RecordStructures()) {
    if (only && std::string(only).find(each.name) == std::string::npos) continue;
    const double begun = Seconds();
    RecordsFit fit = FitRecords(points, each.structure, {}, first.empty() ? nullptr : &poorer);
    const double fitted = Seconds();
    const std::vector<double> density = LeftOutDensities(points, fit);
    if (first.empty()) first = before = density;
    double sum = 0.0;
    std::size_t better = 0;
    for (std::size_t e = 0; e < density.size(); ++e) {
      sum += density[e] - first[e];
      if (density[e] > before[e]) ++better;
    }
    std::printf("%-18s left out %9.1f  better on %zu of %zu  fit %.0f s, left out %.0f s\n",
                each.name.c_str(), sum, better, density.size(), fitted - begun, Seconds() - fitted);
    for (std::size_t e = 0; e < points.size(); ++e) {
      std::printf("  %9.1f %9.1f", density[e], density[e] - first[e]);
      PrintPoint(rig[e].name, each.structure, points[e].record, fit.points[e]);
    }
    std::fflush(stdout);
    before = density;
    poorer = std::move(fit);
  }
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) { return howl::Run(argc, argv); }
