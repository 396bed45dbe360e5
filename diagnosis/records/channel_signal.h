// One channel's signal of a record.
#ifndef HOWL_DIAGNOSIS_RECORDS_CHANNEL_SIGNAL_H_
#define HOWL_DIAGNOSIS_RECORDS_CHANNEL_SIGNAL_H_

#include <glog/logging.h>

#include <Eigen/Core>
#include <vector>

#include "diagnosis/records/cut_record.h"
#include "estimation/analysis/spectra/record.h"
#include "model/effects/effect.h"
#include "model/loop/instrument.h"

namespace howl {

// The channel that one of the two instruments records.
inline Channel ChannelOf(LoopBlock instrument) {
  CHECK(instrument == LoopBlock::kPressureInstrument ||
        instrument == LoopBlock::kHeatReleaseInstrument);
  return instrument == LoopBlock::kPressureInstrument ? Channel::kPressure : Channel::kHeatRelease;
}

inline const Eigen::VectorXd& SignalOf(const CutRecord& record, Channel channel) {
  return channel == Channel::kPressure ? record.pressure : record.heat_release;
}
inline Eigen::VectorXd& SignalOf(CutRecord& record, Channel channel) {
  return channel == Channel::kPressure ? record.pressure : record.heat_release;
}

inline const std::vector<double>& SignalOf(const Record& record, Channel channel) {
  return channel == Channel::kPressure ? record.pressure : record.heat_release;
}
inline std::vector<double>& SignalOf(Record& record, Channel channel) {
  return channel == Channel::kPressure ? record.pressure : record.heat_release;
}

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_RECORDS_CHANNEL_SIGNAL_H_
