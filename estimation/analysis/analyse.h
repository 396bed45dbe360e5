// Computes from one experiment's record, or several, what the paper has in tables 2 and 3 and in
// figures 4, 6, 7 and 10: the characteristics with their uncertainty, which fit and family start
// from.
#ifndef HOWL_ESTIMATION_ANALYSIS_ANALYSE_H_
#define HOWL_ESTIMATION_ANALYSIS_ANALYSE_H_

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/cycle/cycle_band.h"
#include "estimation/analysis/cycle/growth.h"
#include "estimation/analysis/flame/flame_curve.h"
#include "estimation/analysis/loop/delay.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/analysis/loop/loop_gain_reason.h"
#include "estimation/analysis/loop/vanishing_phi.h"
#include "estimation/analysis/oscillations/notch.h"
#include "estimation/analysis/oscillations/oscillations.h"
#include "estimation/analysis/spectra/lines.h"
#include "estimation/analysis/spectra/record.h"
#include "estimation/analysis/transfer/transfer.h"
#include "estimation/residual_spec.h"

namespace howl {

struct AnalysisOptions {
  CharacteristicsOptions characteristics;
  LineOptions lines;
  FlameCurveOptions flame_curve;
  TransferOptions transfer;
  // The model whose acoustics are fitted to the transfer; it must be the one that fit and family
  // use. Without a model no transfer is fitted.
  std::optional<ModelSpec> model;
  double transfer_min_harmonic = 1.0 / 11.0;  // lowest of its points: 20 Hz at the paper's 220 Hz
  double second_mode_share_max = kSecondModeShareMax;  // FirstModeCarries; infinite: not asked
  std::optional<int> delay_branch;                     // else by consistency
  int threads = 0;                                     // 0: all
};

// The analysis of one record. Results that need q are absent for a pressure-only record, and
// results that need a limit cycle are absent without one.
struct Analysis {
  std::string name;
  double phi = 0.0;
  double sampling_hz = 0.0, duration_s = 0.0;
  Characteristics characteristics;
  std::vector<SpectralLine> lines;
  std::vector<Oscillation> oscillations;  // the cycle and those beside it, the strongest first
  std::vector<Notch> slow_notches;        // slow oscillations that the flame curve is read without
  std::optional<Estimate> tau_s;
  std::optional<FlameCurve> flame_curve;
  std::optional<Estimate> loop_gain;
  std::optional<LowLoopGain> low_loop_gain;  // in a cycle, below one beyond its error: why
  std::optional<Transfer> transfer;
  std::optional<TransferFit> transfer_fit;
  std::optional<Growth> growth;  // of a pressure-only record whose envelope grows out of noise
  bool has_heat_release = false;
};

struct AnalysisSet {
  std::vector<Analysis> analyses;
  DelayChoice delay;           // its tau_s: one for each analysis with a cycle and q, in order
  VanishingPhi vanishing_phi;  // from stationary experiments with a loop gain
};

struct NamedRecord {
  std::string name;
  double phi = 0.0;
  Record record;
  std::optional<CycleBand> cycle_hz;  // where its cycle is; absent: the strongest peak is taken
};

// Analyses what one record gives by itself: everything but delay, flame curve and loop gain, which
// need the delay's branch. The cycle is the strongest peak of p in the search range. Where that is
// no limit cycle by itself, or `cycle_hz` picks one of several oscillations, it is read beside the
// others (oscillations.h).
Analysis AnalyseRecord(const Record& record, const AnalysisOptions& options = {},
                       const std::optional<CycleBand>& cycle_hz = std::nullopt);

// Adds the delay and what follows from it.
void AddFlame(const Record& record, const Estimate& tau_s, const AnalysisOptions& options,
              Analysis* analysis);

// Analyses all records in parallel; the answer does not depend on the number of threads, and
// nothing is random.
AnalysisSet AnalyseRecords(std::span<const NamedRecord> records,
                           const AnalysisOptions& options = {});

// The experiment that fit and family start from; absent without a limit cycle or without q.
std::optional<Experiment> ToExperiment(const Analysis& analysis);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_ANALYSE_H_
