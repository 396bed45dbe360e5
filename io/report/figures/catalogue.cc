#include "io/report/figures/catalogue.h"

#include <exception>
#include <iterator>

#include "estimation/parallel.h"
#include "io/report/fault_words.h"

namespace howl {
namespace {

struct Entry {
  const char* name;
  PageSection section;
  const char* paper_figure;
  std::optional<Figure> (*make)(const ReportInput&);
};

#define HOWL_FIGURE_ENTRY(Function, name, section, paper) \
  {#name, PageSection::section, paper, Function##Figure},
constexpr Entry kFigures[] = {HOWL_FIGURES(HOWL_FIGURE_ENTRY)};
#undef HOWL_FIGURE_ENTRY

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
    if (made[i]) {
      made[i]->name = kFigures[i].name;
      made[i]->section = kFigures[i].section;
      made[i]->paper_figure = kFigures[i].paper_figure;
      figures.push_back(*std::move(made[i]));
    }
    if (faults[i].empty()) continue;
    missing.push_back("the figure " + std::string(kFigures[i].name) + " is left out: " + faults[i]);
  }
  return figures;
}

}  // namespace howl
