// The rows of the coverage table: kinds of records, with their parameters drawn anew for each
// record, and the tally of what the estimates and intervals make of them.
#ifndef HOWL_TESTS_ESTIMATION_ANALYSIS_COVERAGE_ROWS_H_
#define HOWL_TESTS_ESTIMATION_ANALYSIS_COVERAGE_ROWS_H_

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "model/numerics/units.h"
#include "tests/estimation/analysis/synthetic_record.h"

namespace howl::fixtures {

struct CoverageRow {
  std::string name;
  SyntheticOptions options;
};

inline std::vector<CoverageRow> CoverageRows() {
  return {
      {"long", {.loop_gain = 1.25}},
      {"short", {.samples = 2000, .loop_gain = 1.25}},
      {"noisy", {.loop_gain = 1.25, .noise = 1.0}},
      {"coloured noise", {.loop_gain = 1.25, .noise = 0.3, .noise_pole = 0.95}},
      {"near-harmonic line 3.03", {.loop_gain = 1.25, .second_harmonic = 0.2, .line_ratio = 3.03}},
      {"non-harmonic line 1.21", {.noise = 0.2, .second_harmonic = 0.2, .line_ratio = 1.21}},
      {"diffusing 1/s", {.loop_gain = 1.25, .diffusion_rad2_per_s = 1.0}},
      {"diffusing 10/s", {.diffusion_rad2_per_s = 10.0, .noise = 0.2, .noise_pole = 0.9}},
      {"breathing", {.diffusion_rad2_per_s = 2.0, .breathing = 0.25, .noise = 0.2}},
      {"short, diffusing", {.samples = 3000, .diffusion_rad2_per_s = 2.0, .noise = 0.2}},
  };
}

enum Quantity { kFrequency, kPhase, kGain, kTau, kSlope, kLine, kQuantities };
inline constexpr std::array kQuantityNames = {"frequency", "phase", "gain", "tau", "slope", "line"};

struct Tally {
  int count = 0, covered = 0;
  double error = 0.0, squared_error = 0.0, std = 0.0;

  void Add(const Estimate& estimate, double truth) {
    const double e = estimate.value - truth;
    ++count;
    covered += std::abs(e) <= kNormal95 * estimate.std ? 1 : 0;
    error += e;
    squared_error += e * e;
    std += estimate.std;
  }
  double Coverage() const { return count > 0 ? static_cast<double>(covered) / count : NAN; }
  double Bias() const { return error / count; }
  double Rms() const { return std::sqrt(squared_error / count); }
  double MeanStd() const { return std / count; }
};

struct RowResult {
  std::array<Tally, kQuantities> tally;
  double paper_phase_rms_deg = 0.0;
  int lines_missed = 0, cycles_missed = 0;
};

inline RowResult RunCoverageRow(const CoverageRow& row, int records, std::uint64_t seed) {
  RowResult result;
  double paper_squares = 0.0;
  for (int i = 0; i < records; ++i) {
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    SyntheticOptions o = row.options;
    o.frequency_hz = uniform(180.0, 220.0);
    o.phase_deg = uniform(-45.0, 20.0);
    o.gain = uniform(10.0, 20.0);
    const SyntheticRecord truth = Synthesise(o, random());
    const Analysis first = AnalyseRecord(truth.record);
    const Characteristics& c = first.characteristics;
    if (c.state == CycleState::kNoLimitCycle) {
      ++result.cycles_missed;
      continue;
    }
    Analysis analysis = first;
    const Estimate tau_s = DelayOnBranch({c.frequency_hz, c.phase_deg}, 0);
    AddFlame(truth.record, tau_s, {}, &analysis);
    result.tally[kFrequency].Add(c.frequency_hz, o.frequency_hz);
    result.tally[kPhase].Add({WrapDeg(c.phase_deg.value - o.phase_deg), c.phase_deg.std}, 0.0);
    result.tally[kGain].Add({c.gain.value / o.gain, c.gain.std / o.gain}, 1.0);
    result.tally[kTau].Add({tau_s.value / truth.tau_s, tau_s.std / truth.tau_s}, 1.0);
    const Estimate& slope = analysis.flame_curve->slope;
    // A second harmonic that was added to q beside the flame's answer leaves no true slope.
    if (o.second_harmonic == 0.0) {
      result.tally[kSlope].Add(
          {slope.value / truth.flame_slope, slope.std / std::abs(truth.flame_slope)}, 1.0);
    }
    if (o.line_ratio > 0.0) {
      const SpectralLine* found = nullptr;
      for (const SpectralLine& line : analysis.lines) {
        if (std::abs(line.frequency_hz.value - truth.line_hz) < 2.0) found = &line;
      }
      if (found == nullptr) {
        ++result.lines_missed;
      } else {
        result.tally[kLine].Add(found->frequency_hz, truth.line_hz);
      }
    }
    const Characteristics by_paper =
        PaperCharacteristics(RemoveMean(truth.record.pressure),
                             RemoveMean(truth.record.heat_release), o.sampling_hz, 20.0, 2000.0);
    paper_squares += std::pow(WrapDeg(by_paper.phase_deg.value - o.phase_deg), 2);
  }
  result.paper_phase_rms_deg = std::sqrt(paper_squares / records);
  return result;
}

}  // namespace howl::fixtures

#endif  // HOWL_TESTS_ESTIMATION_ANALYSIS_COVERAGE_ROWS_H_
