// How many modes the records ask for: loops of one mode more each, as long as they gain.
//
// The score of a loop is the sum of the densities of each point's record by the law of the others
// (records_fit.h), and of one point its evidence. The search ends where two modes in a row have not
// raised it. Odds of two loops are the ratio of these densities.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_CHOOSE_MODES_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_CHOOSE_MODES_H_

#include <vector>

#include "estimation/joint_records/record_loop_spec.h"
#include "estimation/joint_records/records_fit.h"

namespace howl {

struct ModesTried {
  int modes = 0;
  std::vector<double> log_density;  // of each point, left out
  double Sum() const;
};

struct ChosenLoop {
  RecordsFit fit;
  std::vector<ModesTried> tried;  // in the order of modes
  std::size_t chosen = 0;         // in tried
};

// `spec.choose_modes` or not.
ChosenLoop FitLoop(const std::vector<OperatingPoint>& points, const RecordLoopSpec& spec,
                   const RecordsFitOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_CHOOSE_MODES_H_
