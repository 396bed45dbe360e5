// The tables that commands write into a run's folder. `howl simulate` writes each experiment's
// record there as NAME.csv, so that no experiment may have the name of one of these.
#ifndef HOWL_IO_RESULT_FILES_H_
#define HOWL_IO_RESULT_FILES_H_

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace howl {

inline constexpr const char* kCharacteristicsCsv = "characteristics.csv";
inline constexpr const char* kLinesCsv = "lines.csv";
inline constexpr const char* kOscillationsCsv = "oscillations.csv";
inline constexpr const char* kTransferCsv = "transfer.csv";
inline constexpr const char* kFlameCurveCsv = "flame_curve.csv";
inline constexpr const char* kFamilyCsv = "family.csv";
inline constexpr const char* kTradeoffCsv = "tradeoff.csv";
inline constexpr const char* kProfileCsv = "profile.csv";
inline constexpr const char* kSweepCsv = "sweep.csv";
inline constexpr const char* kTrialCsv = "trial.csv";
inline constexpr const char* kPredictionCsv = "prediction.csv";
inline constexpr const char* kPredictionMapCsv = "prediction_map.csv";

inline constexpr const char* kCampaignCsv = "campaign.csv";
inline constexpr const char* kCampaignPointsCsv = "campaign_points.csv";

inline constexpr std::array<std::string_view, 14> kResultTables = {
    kCharacteristicsCsv, kLinesCsv,         kOscillationsCsv, kTransferCsv,      kFlameCurveCsv,
    kFamilyCsv,          kTradeoffCsv,      kProfileCsv,      kSweepCsv,         kTrialCsv,
    kPredictionCsv,      kPredictionMapCsv, kCampaignCsv,     kCampaignPointsCsv};

// An experiment's NAME.csv would overwrite a table of results, as the name "family" would.
inline bool IsResultsName(std::string_view name) {
  return std::ranges::find(kResultTables, std::string(name) + ".csv") != kResultTables.end();
}

}  // namespace howl

#endif  // HOWL_IO_RESULT_FILES_H_
