// All figures of the report, in its order. A new figure is one file in this folder, its line here
// and its line in catalogue.cc. Each returns nothing where it does not apply.
#ifndef HOWL_IO_REPORT_FIGURES_CATALOGUE_H_
#define HOWL_IO_REPORT_FIGURES_CATALOGUE_H_

#include <optional>
#include <vector>

#include "io/report/figure.h"
#include "io/report/report_input.h"

namespace howl {

std::optional<Figure> RecordsFigure(const ReportInput& input);             // the paper, figure 1
std::optional<Figure> SpectraFigure(const ReportInput& input);             // 2
std::optional<Figure> DelayFigure(const ReportInput& input);               // 4
std::optional<Figure> FlameScatterFigure(const ReportInput& input);        // 5
std::optional<Figure> FlameCurvesFigure(const ReportInput& input);         // 6
std::optional<Figure> LoopGainFigure(const ReportInput& input);            // 7
std::optional<Figure> FamilyBodeFigure(const ReportInput& input);          // 8
std::optional<Figure> AllBodeFigure(const ReportInput& input);             // 9
std::optional<Figure> LinesFigure(const ReportInput& input);               // 10
std::optional<Figure> SpectrumComparisonFigure(const ReportInput& input);  // 11
std::optional<Figure> NyquistFigure(const ReportInput& input);             // 12
std::optional<Figure> OmegaSensitivityFigure(const ReportInput& input);    // 13
std::optional<Figure> DelaySensitivityFigure(const ReportInput& input);    // 14
std::optional<Figure> TradeoffFigure(const ReportInput& input);
std::optional<Figure> BoundsFigure(const ReportInput& input);
std::optional<Figure> PredictionFigure(const ReportInput& input);
std::optional<Figure> StabilityMapFigure(const ReportInput& input);
std::optional<Figure> TransferFigure(const ReportInput& input);
std::optional<Figure> BifurcationFigure(const ReportInput& input);
std::optional<Figure> GapMapFigure(const ReportInput& input);
std::optional<Figure> EffectsFigure(const ReportInput& input);
std::optional<Figure> RemainsFigure(const ReportInput& input);
std::optional<Figure> BudgetFigure(const ReportInput& input);
std::optional<Figure> ConfusionFigure(const ReportInput& input);
std::optional<Figure> ReliabilityFigure(const ReportInput& input);
std::optional<Figure> PowerFigure(const ReportInput& input);
std::optional<Figure> CampaignQuantitiesFigure(const ReportInput& input);
std::optional<Figure> CampaignGapsFigure(const ReportInput& input);

// Those that apply. A fault in one is a sentence in `missing` and leaves the others.
std::vector<Figure> AllFigures(const ReportInput& input, int threads,
                               std::vector<std::string>& missing);

}  // namespace howl

#endif  // HOWL_IO_REPORT_FIGURES_CATALOGUE_H_
