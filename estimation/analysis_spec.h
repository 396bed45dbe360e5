// How a record becomes characteristics.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPEC_H_
#define HOWL_ESTIMATION_ANALYSIS_SPEC_H_

#include <array>
#include <optional>
#include <string_view>

namespace howl {

// kMl: maximum likelihood over fundamental and harmonics. kSeed: the paper's own procedure (FFT,
// maximum, amplitude-weighted mean over 11 bins).
enum class AnalysisMethod { kMl, kSeed };

inline constexpr std::array kAnalysisMethods = {AnalysisMethod::kMl, AnalysisMethod::kSeed};

// As in configs.
constexpr std::string_view AnalysisMethodName(AnalysisMethod method) {
  constexpr std::array<std::string_view, kAnalysisMethods.size()> kNames = {"ml", "seed"};
  return kNames[static_cast<std::size_t>(method)];
}

struct AnalysisSpec {
  AnalysisMethod method = AnalysisMethod::kMl;
  int harmonics = 5;  // fitted together with the fundamental, which is the first
  int max_lines = 8;  // non-harmonic lines reported at most
  // Whole periods added to the delay of (3); absent: by consistency over the experiments.
  std::optional<int> delay_branch;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPEC_H_
