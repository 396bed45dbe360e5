// Between time and the band of a record's cuts. A band has `count` bins from the record's first on,
// and the window's reach (kTapReach) on both sides.
#ifndef HOWL_DIAGNOSIS_RECORDS_BAND_SIGNAL_H_
#define HOWL_DIAGNOSIS_RECORDS_BAND_SIGNAL_H_

#include <Eigen/Core>

#include "diagnosis/records/cut_record.h"

namespace howl {

Eigen::VectorXcd BandSpectrum(const CutRecord& record, const Eigen::VectorXd& signal,
                              Eigen::Index count);

// The real signal that has this spectrum there, and nothing elsewhere.
Eigen::VectorXd InTime(const CutRecord& record, const Eigen::VectorXcd& band);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_RECORDS_BAND_SIGNAL_H_
