// Measured records with known effects put into them, for studies and tests of the diagnosis.
#ifndef HOWL_BENCH_MEASURED_RIG_H_
#define HOWL_BENCH_MEASURED_RIG_H_

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/records/channel_signal.h"
#include "model/numerics/smooth_length.h"

namespace howl {

using MeasuredRig = std::vector<DiagnosisExperiment>;

// The part of each record from `from` to `to`, as fractions of its length.
inline MeasuredRig Part(MeasuredRig rig, double from, double to) {
  for (DiagnosisExperiment& each : rig) {
    for (std::vector<double>* signal : {&each.record.pressure, &each.record.heat_release}) {
      const auto n = static_cast<double>(signal->size());
      signal->erase(signal->begin() + static_cast<std::ptrdiff_t>(to * n), signal->end());
      signal->erase(signal->begin(), signal->begin() + static_cast<std::ptrdiff_t>(from * n));
    }
  }
  return rig;
}

inline double MeanOf(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

// sqrt(2) times the standard deviation: a sine's amplitude.
inline double AmplitudeOf(const std::vector<double>& x) {
  const double mean = MeanOf(x);
  double sum = 0.0;
  for (const double value : x) sum += (value - mean) * (value - mean);
  return std::sqrt(2.0 * sum / static_cast<double>(x.size()));
}

// First-order low-pass, bilinear with the corner prewarped.
inline void LowPassQ(MeasuredRig* rig, double cutoff_hz) {
  for (DiagnosisExperiment& each : *rig) {
    std::vector<double>& q = each.record.heat_release;
    const double c = 1.0 / std::tan(std::numbers::pi * cutoff_hz / each.record.sampling_hz);
    double before = q[0];
    double out = q[0];
    for (double& value : q) {
      out = (value + before - (1.0 - c) * out) / (1.0 + c);
      before = value;
      value = out;
    }
  }
}

// q later by skew_s, exactly, as a periodic signal.
inline void SkewQ(MeasuredRig* rig, double skew_s) {
  for (DiagnosisExperiment& each : *rig) {
    std::vector<double>& q = each.record.heat_release;
    const Eigen::Index n = SmoothLength(static_cast<Eigen::Index>(q.size()));
    each.record.pressure.resize(static_cast<std::size_t>(n));
    q.resize(static_cast<std::size_t>(n));
    Eigen::VectorXcd spectrum = ForwardFft(Eigen::Map<const Eigen::VectorXd>(q.data(), n));
    for (Eigen::Index k = 0; k < spectrum.size(); ++k) {
      const double f = static_cast<double>(k) * each.record.sampling_hz / static_cast<double>(n);
      spectrum[k] *= std::polar(1.0, -2.0 * std::numbers::pi * f * skew_s);
    }
    const Eigen::VectorXd moved = InverseFft(spectrum, n);
    q.assign(moved.data(), moved.data() + n);
  }
}

// At `fraction` of the amplitude.
inline void ClipSignal(MeasuredRig* rig, Channel channel, double fraction) {
  for (DiagnosisExperiment& each : *rig) {
    std::vector<double>& x = SignalOf(each.record, channel);
    const double mean = MeanOf(x);
    const double limit = fraction * AmplitudeOf(x);
    for (double& value : x) value = mean + std::clamp(value - mean, -limit, limit);
  }
}

inline void HumInQ(MeasuredRig* rig, double relative) {
  double start = 0.3;
  for (DiagnosisExperiment& each : *rig) {
    std::vector<double>& q = each.record.heat_release;
    const double amplitude = relative * AmplitudeOf(q);
    const double step = 2.0 * std::numbers::pi * 50.0 / each.record.sampling_hz;
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] += amplitude * std::sin(step * static_cast<double>(i) + start);
    }
    start += 1.7;
  }
}

// The same share of p for all experiments: rel is of the mean cycle.
inline void CrosstalkToQ(MeasuredRig* rig, double relative) {
  double ratio = 0.0;
  for (const DiagnosisExperiment& each : *rig) {
    ratio += AmplitudeOf(each.record.heat_release) / AmplitudeOf(each.record.pressure) /
             static_cast<double>(rig->size());
  }
  for (DiagnosisExperiment& each : *rig) {
    const double mean = MeanOf(each.record.pressure);
    for (std::size_t i = 0; i < each.record.pressure.size(); ++i) {
      each.record.heat_release[i] += relative * ratio * (each.record.pressure[i] - mean);
    }
  }
}

}  // namespace howl

#endif  // HOWL_BENCH_MEASURED_RIG_H_
