#include "diagnosis/reference/reference_clipping.h"

#include <algorithm>

#include "diagnosis/records/channel_signal.h"
#include "diagnosis/samples/sample_limits.h"

namespace howl {

std::vector<DiagnosisExperiment> ClippedAlike(std::vector<DiagnosisExperiment> reference,
                                              const std::vector<CutRecord>& rig, Channel channel) {
  double upper = 0.0;
  double lower = 0.0;
  for (const CutRecord& record : rig) {
    const Plateaus plateaus = FindPlateaus(SignalOf(record, channel));
    upper += plateaus.upper.mean() / static_cast<double>(rig.size());
    lower += plateaus.lower.mean() / static_cast<double>(rig.size());
  }
  for (DiagnosisExperiment& each : reference) {
    std::vector<double>& samples = SignalOf(each.record, channel);
    const auto x = Eigen::Map<const Eigen::VectorXd>(samples.data(),
                                                     static_cast<Eigen::Index>(samples.size()));
    const double low = SampleQuantile(x, lower);
    const double high = SampleQuantile(x, 1.0 - upper);
    for (double& value : samples) value = std::clamp(value, low, high);
  }
  return reference;
}

}  // namespace howl
