// The config's choices of how a record becomes characteristics.
#ifndef HOWL_ESTIMATION_ANALYSIS_ANALYSIS_SPEC_H_
#define HOWL_ESTIMATION_ANALYSIS_ANALYSIS_SPEC_H_

#include <array>
#include <optional>
#include <string_view>

#include "estimation/analysis/cycle/characteristics.h"

namespace howl {

inline constexpr std::array kAnalysisMethods = {CharacteristicsMethod::kLocal,
                                                CharacteristicsMethod::kPaper};

// The method's name in configs.
constexpr std::string_view AnalysisMethodName(CharacteristicsMethod method) {
  return method == CharacteristicsMethod::kLocal ? "local" : "paper";
}

struct AnalysisSpec {
  CharacteristicsMethod method = CharacteristicsMethod::kLocal;
  // The range of frequencies in which the limit cycle is looked for.
  std::optional<double>
      min_frequency_hz;  // absent: LowestSearched (estimation/analysis/cycle/characteristics.h)
  std::optional<double> max_frequency_hz;  // absent: four tenths of the sampling rate
  // Whole periods added to the delay of (3); absent: by consistency over the experiments.
  std::optional<int> delay_branch;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_ANALYSIS_SPEC_H_
