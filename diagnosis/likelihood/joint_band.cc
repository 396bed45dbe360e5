#include "diagnosis/likelihood/joint_band.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/cuts/make_cut_records.h"

namespace howl {

Eigen::VectorXcd SineTapered(const Eigen::Ref<const Eigen::VectorXcd>& extended,
                             Eigen::Index count) {
  return extended.segment(kTapReach, count) - extended.segment(kTapReach + 1, count);
}

JointBand MakeJointBand(const CutRecord& record) {
  JointBand out;
  out.record = record;
  out.record.derivative_filter = BareDerivativeFilter(record);
  DriveAsRecorded(&out.record);
  out.count = record.flame_count;
  const Eigen::Index start = record.first - kTapReach;
  const Eigen::Index extended = record.flame_count + 2 * kTapReach;
  out.pressure = SineTapered(record.pressure_spectrum.segment(start, extended), out.count);
  out.heat_release = SineTapered(record.heat_release_spectrum.segment(start, extended), out.count);
  out.frequency_hz =
      record.frequency_hz.segment(kTapReach, out.count).array() + 0.5 * record.bin_hz;
  const double low = out.frequency_hz[0];
  const double high = out.frequency_hz[out.count - 1];
  out.log_frequency = 2.0 * (out.frequency_hz.array() / low).log() / std::log(high / low) - 1.0;
  out.share = Eigen::VectorXd::Constant(out.count, kSineTaperShare);
  for (Eigen::Index i = 0; i < out.count; ++i) {
    // The bin stands between two of the record's.
    if (record.masked[static_cast<std::size_t>(i)] ||
        record.masked[static_cast<std::size_t>(i + 1)]) {
      out.share[i] = 0.0;
    }
  }
  out.acoustic_power = Eigen::VectorXd::Ones(out.count);
  out.flame_power = Eigen::VectorXd::Ones(out.count);
  out.pressure_power = SmoothPower(out.pressure, kPowerReach);
  out.heat_release_power = SmoothPower(out.heat_release, kPowerReach);
  return out;
}

}  // namespace howl
