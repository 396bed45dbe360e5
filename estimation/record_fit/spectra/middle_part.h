// The middle of a record's spectra (record_spectra.h): what a record of these cycles alone would
// show, in the same units and with the same functions of the flame. A fit of it costs as much less
// as it is shorter, and comes to the same loop, to within its own larger errors: enough to tell
// good starts from poor ones.
//
// It is cut in time from the signals of the band alone, which p, q and the flame's functions are
// linear in, so that noise that they are without is out of it too. Where the band ends, and at the
// record's ends, it would differ from what a shorter record had shown: those it leaves out.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_MIDDLE_PART_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_MIDDLE_PART_H_

#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// A fifth of the record, or of a shorter one the hundred cycles that tell all that the base priors
// leave open (point_prior.h). None where the whole is not twice as long: a fit of it costs little
// more.
void SetMiddle(RecordSpectra* record);

// Of spectra on the edges of the record's bins, a column each, those of its middle, which it has.
Eigen::MatrixXcd ColumnsOfMiddle(const RecordSpectra& record, const Eigen::MatrixXcd& edges);

// The record itself where it has none.
inline const RecordSpectra& MiddleOf(const RecordSpectra& record) {
  return record.middle ? *record.middle : record;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_MIDDLE_PART_H_
