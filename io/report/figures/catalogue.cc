#include "io/report/figures/catalogue.h"

#include <exception>

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
                              {"gap_map", GapMapFigure},
                              {"effects", EffectsFigure},
                              {"remains", RemainsFigure}};

}  // namespace

std::vector<Figure> AllFigures(const ReportInput& input, std::vector<std::string>& missing) {
  std::vector<Figure> figures;
  for (const Entry& entry : kFigures) {
    try {
      if (auto figure = entry.make(input)) figures.push_back(*std::move(figure));
    } catch (const std::exception& error) {
      missing.push_back(std::string("the figure ") + entry.name + " is left out: " + error.what());
    }
  }
  return figures;
}

}  // namespace howl
