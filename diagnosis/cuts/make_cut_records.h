// From a rig's records to the spectra, the bands and the inputs of the two cuts (cut_record.h).
#ifndef HOWL_DIAGNOSIS_CUTS_MAKE_CUT_RECORDS_H_
#define HOWL_DIAGNOSIS_CUTS_MAKE_CUT_RECORDS_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/records/cut_record.h"

namespace howl {

// Why a record of a rig cannot be cut, for the user to read.
struct CutObstacle {
  std::size_t experiment = 0;
  std::string what;
};
std::optional<CutObstacle> FindCutObstacle(const std::vector<DiagnosisExperiment>& experiments);

// Records of one rig, that nothing keeps from being cut. Both channels are needed, at one sampling
// rate each. The band goes from 0.15 to 8 (cut A) and 6.4 (cut B) times the cycle's frequency, and
// no further than 0.34 and 0.27 of the sampling rate.
std::vector<CutRecord> MakeCutRecords(const std::vector<DiagnosisExperiment>& experiments,
                                      const BaseModel& model = {});

// The first or the second half of each record.
std::vector<DiagnosisExperiment> HalfOfRecords(const std::vector<DiagnosisExperiment>& experiments,
                                               bool second);

// Cut A's input without the shrinkage.
void DriveAsRecorded(CutRecord* record);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_MAKE_CUT_RECORDS_H_
