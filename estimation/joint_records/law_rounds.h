// The loops of several operating points and the law by which their parameters vary, each in turn
// given the other (records_fit.h): each point is fitted under the law, and the law anew, until it
// stands; then each point looks for other maxima. What they find moves the law again, until they
// find nothing.
//
// A point looks for other maxima under what the others say of it, its own voice in the law left
// out: a law to which it belongs is narrow about where it stands, and all that moves it elsewhere
// would move the law as well.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_LAW_ROUNDS_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_LAW_ROUNDS_H_

#include <vector>

#include "estimation/joint_records/records_fit.h"
#include "estimation/joint_records/records_fitter.h"

namespace howl {

RecordsFit FitUnderLaw(const RecordsFitter& fitter, const std::vector<OperatingPoint>& points,
                       const StartRows& starts, const RecordsFitOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_LAW_ROUNDS_H_
