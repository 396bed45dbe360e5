// A record's signals as predictions of them are scored.
#ifndef HOWL_DIAGNOSIS_HELD_OUT_RECORD_SIGNALS_H_
#define HOWL_DIAGNOSIS_HELD_OUT_RECORD_SIGNALS_H_

#include <Eigen/Core>

#include "diagnosis/held_out/band_errors.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// Their errors are none yet.
inline PredictedSignals SignalsOf(const RecordSpectra& record) {
  constexpr Eigen::Index kPowerReach = 4;  // bins to either side, of smoothed powers
  PredictedSignals signals;
  signals.cycle_hz = record.scale.cycle_hz;
  signals.bin_hz = record.bin_hz;
  signals.frequency_hz = record.s.imag() * record.scale.cycle_hz;
  signals.share = record.share;
  signals.pressure = Tapered(record.pressure);
  signals.heat_release = Tapered(record.heat_release);
  signals.pressure_power = SmoothPower(signals.pressure, kPowerReach);
  signals.heat_release_power = SmoothPower(signals.heat_release, kPowerReach);
  return signals;
}

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_RECORD_SIGNALS_H_
