// One operating point as it was recorded, for fits of loops to whole records.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_LOOP_RECORD_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_LOOP_RECORD_H_

#include <string>

#include "estimation/analysis/spectra/record.h"

namespace howl {

struct LoopRecord {
  std::string name;
  double operating_parameter = 0.0;
  double cycle_hz = 0.0;  // of the cycle, or of the strongest peak where there is none
  Record record;          // of both signals
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_LOOP_RECORD_H_
