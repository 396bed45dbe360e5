// How many modes the records ask for, and which signal drives the flame, where the config leaves
// either to them: loops of one mode more each, as long as they gain, with each of the inputs.
//
// The score of a loop is the sum of the densities of each point's record by the law of the others
// (records_fit.h), and of one point its evidence. The search for modes ends where two in a row have
// not raised it. Odds of two loops are the ratio of these densities: all are of the same records.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_CHOOSE_LOOP_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_CHOOSE_LOOP_H_

#include <cstddef>
#include <vector>

#include "estimation/joint_records/half_fits.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "estimation/joint_records/records_fit.h"

namespace howl {

struct LoopTried {
  FlameInput flame_input = FlameInput::kPressureRate;
  int modes = 0;
  std::vector<double> log_density;  // of each point, left out
  double Sum() const;
};

struct ChosenLoop {
  // Made ready for the flame's input that was chosen, and driven as the loop has it (FitDriven).
  std::vector<OperatingPoint> points;
  RecordsFit fit;
  std::vector<HalfFits> halves;
  std::vector<LoopTried> tried;  // by input, in the order of modes
  std::size_t chosen = 0;        // in tried
};

// Whether `spec` leaves a choice or not.
ChosenLoop FitLoop(const std::vector<LoopRecord>& records, const RecordLoopSpec& spec,
                   const RecordsFitOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_CHOOSE_LOOP_H_
