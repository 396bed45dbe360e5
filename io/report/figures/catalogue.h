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
// files, and the figure of the paper that it answers to. What a figure needs its function asks of
// the input, and returns nothing where that is not there.
#define HOWL_FIGURES(X)                            \
  X(Records, records, "1")                         \
  X(Spectra, spectra, "2")                         \
  X(Delay, delay, "4")                             \
  X(FlameScatter, flame_scatter, "5")              \
  X(FlameCurves, flame_curves, "6")                \
  X(LoopGain, loop_gain, "7")                      \
  X(FamilyBode, bode_family, "8")                  \
  X(AllBode, bode_all, "9")                        \
  X(Transfer, transfer, "")                        \
  X(Lines, lines, "10")                            \
  X(SpectrumComparison, spectrum_comparison, "11") \
  X(Nyquist, nyquist, "12")                        \
  X(OmegaSensitivity, sensitivity_omega, "13")     \
  X(DelaySensitivity, sensitivity_tau, "14")       \
  X(Bifurcation, bifurcation, "")                  \
  X(Tradeoff, tradeoff, "")                        \
  X(Bounds, bounds, "")                            \
  X(Prediction, prediction, "")                    \
  X(StabilityMap, stability_map, "")               \
  X(GapMap, gap_map, "")                           \
  X(Effects, effects, "")                          \
  X(Remains, remains, "")                          \
  X(Budget, budget, "")                            \
  X(Confusion, confusion, "")                      \
  X(Reliability, reliability, "")                  \
  X(Power, power, "")                              \
  X(CampaignQuantities, campaign_quantities, "")   \
  X(CampaignGaps, campaign_gaps, "")

#define HOWL_FIGURE_FUNCTION(Function, name, paper) \
  std::optional<Figure> Function##Figure(const ReportInput& input);
HOWL_FIGURES(HOWL_FIGURE_FUNCTION)
#undef HOWL_FIGURE_FUNCTION

// Those that apply. A fault in one is a sentence in `missing` and leaves the others.
std::vector<Figure> AllFigures(const ReportInput& input, int threads,
                               std::vector<std::string>& missing);

}  // namespace howl

#endif  // HOWL_IO_REPORT_FIGURES_CATALOGUE_H_
