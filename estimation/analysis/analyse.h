// From one experiment's record, or several, to the paper's tables 2 and 3 and figures 4, 6, 7, 10:
// the characteristics with their uncertainty that fit and family run on.
#ifndef HOWL_ESTIMATION_ANALYSIS_ANALYSE_H_
#define HOWL_ESTIMATION_ANALYSIS_ANALYSE_H_

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimation/analysis/characteristics.h"
#include "estimation/analysis/delay.h"
#include "estimation/analysis/experiment.h"
#include "estimation/analysis/flame_curve.h"
#include "estimation/analysis/growth.h"
#include "estimation/analysis/lines.h"
#include "estimation/analysis/loop_gain_reason.h"
#include "estimation/analysis/record.h"
#include "estimation/analysis/transfer.h"
#include "estimation/analysis/vanishing_phi.h"
#include "estimation/residual_spec.h"

namespace howl {

struct AnalysisOptions {
  CharacteristicsOptions characteristics;
  LineOptions lines;
  FlameCurveOptions flame_curve;
  TransferOptions transfer;
  // Whose acoustics are fitted to the transfer: the model that fit and family are about, no other.
  // Without one no transfer is fitted.
  std::optional<ModelSpec> model;
  double transfer_min_harmonic = 1.0 / 11.0;  // lowest of its points: 20 Hz at the paper's 220 Hz
  double second_mode_share_max = kSecondModeShareMax;  // FirstModeCarries; infinite: not asked
  std::optional<int> delay_branch;                     // else by consistency
  int threads = 0;                                     // 0: all
};

// What needs q is absent for a pressure-only record; what needs a limit cycle is absent without
// one.
struct Analysis {
  std::string name;
  double phi = 0.0;
  double sampling_hz = 0.0, duration_s = 0.0;
  Characteristics characteristics;
  std::vector<SpectralLine> lines;
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
};

// What one record gives by itself: everything but delay, flame curve and loop gain, which need the
// delay's branch.
Analysis AnalyseRecord(const Record& record, const AnalysisOptions& options = {});

// Adds the delay and what follows from it.
void AddFlame(const Record& record, const Estimate& tau_s, const AnalysisOptions& options,
              Analysis* analysis);

// All records, in parallel; the answer does not depend on the number of threads. Nothing is random.
AnalysisSet AnalyseRecords(std::span<const NamedRecord> records,
                           const AnalysisOptions& options = {});

// What fit and family run on. Absent without a limit cycle or without q.
std::optional<Experiment> ToExperiment(const Analysis& analysis);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_ANALYSE_H_
