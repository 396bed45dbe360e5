// The range of frequencies in which a record's cycle is looked for: it picks one of several
// oscillations.
#ifndef HOWL_ESTIMATION_ANALYSIS_CYCLE_CYCLE_BAND_H_
#define HOWL_ESTIMATION_ANALYSIS_CYCLE_CYCLE_BAND_H_

namespace howl {

struct CycleBand {
  double low_hz = 0.0;
  double high_hz = 0.0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_CYCLE_CYCLE_BAND_H_
