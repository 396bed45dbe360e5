#include "io/report/figures/catalogue.h"

#include <exception>
#include <iterator>

#include "estimation/parallel.h"
#include "io/report/fault_words.h"

namespace howl {
namespace {

struct Entry {
  const char* name;
  std::optional<Figure> (*make)(const ReportInput&);
};

constexpr Entry kFigures[] = {{"records", RecordsFigure},
                              {"spectra", SpectraFigure},
                              {"delay", DelayFigure},
                              {"flame_scatter", FlameScatterFigure},
                              {"flame_curves", FlameCurvesFigure},
                              {"loop_gain", LoopGainFigure},
                              {"bode_family", FamilyBodeFigure},
                              {"bode_all", AllBodeFigure},
                              {"transfer", TransferFigure},
                              {"lines", LinesFigure},
                              {"spectrum_comparison", SpectrumComparisonFigure},
                              {"nyquist", NyquistFigure},
                              {"sensitivity_omega", OmegaSensitivityFigure},
                              {"sensitivity_tau", DelaySensitivityFigure},
                              {"bifurcation", BifurcationFigure},
                              {"tradeoff", TradeoffFigure},
                              {"bounds", BoundsFigure},
                              {"prediction", PredictionFigure},
                              {"stability_map", StabilityMapFigure},
                              {"gap_map", GapMapFigure},
                              {"effects", EffectsFigure},
                              {"remains", RemainsFigure},
                              {"budget", BudgetFigure},
                              {"confusion", ConfusionFigure},
                              {"reliability", ReliabilityFigure},
                              {"power", PowerFigure},
                              {"campaign_quantities", CampaignQuantitiesFigure},
                              {"campaign_gaps", CampaignGapsFigure}};

}  // namespace

std::vector<Figure> AllFigures(const ReportInput& input, int threads,
                               std::vector<std::string>& missing) {
  constexpr std::size_t kCount = std::size(kFigures);
  std::vector<std::optional<Figure>> made(kCount);
  std::vector<std::string> faults(kCount);
  RunUnits(kCount, threads, [&](std::size_t i) {
    try {
      made[i] = kFigures[i].make(input);
    } catch (const std::exception& error) {
      faults[i] = FaultWords(error);
    }
  });
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (made[i]) figures.push_back(*std::move(made[i]));
    if (faults[i].empty()) continue;
    missing.push_back("the figure " + std::string(kFigures[i].name) + " is left out: " + faults[i]);
  }
  return figures;
}

}  // namespace howl
