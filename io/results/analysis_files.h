// The files that `howl analyse` writes for a set of records:
//
//   characteristics.csv  the paper's tables 2 and 3
//   name,phi,frequency_hz,frequency_std_hz,phase_deg,phase_std_deg,gain,gain_std,
//                        tau_s,flame_slope,flame_slope_std,loop_gain,stationary
//   lines.csv            every significant spectral line (figure 10)
//   oscillations.csv     the oscillations of each record, the cycle among them
//   transfer.csv         the coherent q-to-p transfer, and the fitted acoustics at each point
//   flame_curve.csv      q against the delayed derivative of p, in bins (figures 5 and 6)
//   analysis.json        all of it but the curves, schema howl.analysis/1
//
// An operating parameter with a name of its own stands under it too, in the last column.
// Cells that do not apply (no limit cycle, no heat release) are empty; in JSON they are null.
#ifndef HOWL_IO_RESULTS_ANALYSIS_FILES_H_
#define HOWL_IO_RESULTS_ANALYSIS_FILES_H_

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "estimation/analysis/analyse.h"

namespace howl {

std::string CharacteristicsCsv(const AnalysisSet& set,
                               std::string_view operating_parameter = "phi");
std::string LinesCsv(const AnalysisSet& set, std::string_view operating_parameter = "phi");
std::string OscillationsCsv(const AnalysisSet& set, std::string_view operating_parameter = "phi");
std::string TransferCsv(const AnalysisSet& set, std::string_view operating_parameter = "phi");
std::string FlameCurveCsv(const AnalysisSet& set, std::string_view operating_parameter = "phi");
nlohmann::ordered_json OscillationsJson(const AnalysisSet& set);
nlohmann::ordered_json AnalysisJson(const AnalysisSet& set);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_ANALYSIS_FILES_H_
