// What a record alone tells of the parameters that a rig's operating points share
// (shared_units.h), by its fit (Laplace): the flame's own are integrated out.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_RECORD_EVIDENCE_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_RECORD_EVIDENCE_H_

#include "estimation/joint_records/parameter_law.h"
#include "estimation/joint_records/shared_units.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

// prior: under which `fit` was found, and which is taken out of it. z: parameter_law.h.
ParameterEvidence EvidenceOf(const PointFit& fit, const PointPrior& prior, const SharedUnits& units,
                             double z);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_RECORD_EVIDENCE_H_
