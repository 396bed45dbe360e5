// All figures of the report, in its order. A new figure is one file in this folder, which defines
// its function, and its line in HOWL_FIGURES.
#ifndef HOWL_IO_REPORT_FIGURES_CATALOGUE_H_
#define HOWL_IO_REPORT_FIGURES_CATALOGUE_H_

#include <optional>
#include <string>
#include <vector>

#include "io/report/figure.h"
#include "io/report/report_input.h"

namespace howl {

// The registry: one line a figure, the function that draws it (RecordsFigure), the name of its
// files, the section of the page in which it stands (figure.h), and the figure of the paper
// that it answers to. The order is that of the page. What a figure needs its function asks of the
// input, and returns nothing where that is not there.
#define HOWL_FIGURES(X)                                     \
  X(Records, records, kData, "1")                           \
  X(Spectra, spectra, kData, "2")                           \
  X(Delay, delay, kData, "4")                               \
  X(FlameScatter, flame_scatter, kData, "5")                \
  X(FlameCurves, flame_curves, kData, "6")                  \
  X(LoopGain, loop_gain, kData, "7")                        \
  X(Lines, lines, kData, "10")                              \
  X(FamilyBode, bode_family, kModels, "8")                  \
  X(AllBode, bode_all, kModels, "9")                        \
  X(Transfer, transfer, kModels, "")                        \
  X(Nyquist, nyquist, kModels, "12")                        \
  X(SpectrumComparison, spectrum_comparison, kModels, "11") \
  X(OmegaSensitivity, sensitivity_omega, kModels, "13")     \
  X(DelaySensitivity, sensitivity_tau, kModels, "14")       \
  X(Bifurcation, bifurcation, kModels, "")                  \
  X(Tradeoff, tradeoff, kFamily, "")                        \
  X(Bounds, bounds, kFamily, "")                            \
  X(Prediction, prediction, kPrediction, "")                \
  X(StabilityMap, stability_map, kPrediction, "")           \
  X(GapMap, gap_map, kDiagnosis, "")                        \
  X(Effects, effects, kDiagnosis, "")                       \
  X(Budget, budget, kDiagnosis, "")                         \
  X(Remains, remains, kDiagnosis, "")                       \
  X(Confusion, confusion, kTrial, "")                       \
  X(Reliability, reliability, kTrial, "")                   \
  X(Power, power, kTrial, "")                               \
  X(CampaignQuantities, campaign_quantities, kCampaign, "") \
  X(CampaignGaps, campaign_gaps, kCampaign, "")

#define HOWL_FIGURE_FUNCTION(Function, name, section, paper) \
  std::optional<Figure> Function##Figure(const ReportInput& input);
HOWL_FIGURES(HOWL_FIGURE_FUNCTION)
#undef HOWL_FIGURE_FUNCTION

// Those that apply. A fault in one is a sentence in `missing` and leaves the others.
std::vector<Figure> AllFigures(const ReportInput& input, int threads,
                               std::vector<std::string>& missing);

}  // namespace howl

#endif  // HOWL_IO_REPORT_FIGURES_CATALOGUE_H_
