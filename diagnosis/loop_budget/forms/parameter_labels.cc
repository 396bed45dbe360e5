#include "diagnosis/loop_budget/forms/parameter_labels.h"

#include <glog/logging.h>

#include <cstddef>
#include <map>

namespace howl {

std::vector<std::string> ParameterLabels(const PointStructure& structure, Eigen::Index flame) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& name, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) out.push_back(name + std::to_string(i));
  };
  // What modes have in common is the first one's.
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    if (k == 0 || structure.Frequency(k) > 0) out.push_back("omega" + std::to_string(k));
  }
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    if (k == 0 || structure.Damping(k) > 0) out.push_back("xi" + std::to_string(k));
  }
  add("a", structure.modes);
  if (structure.complex_residues) add("b", structure.modes);
  add("g", structure.modes);
  add("h", structure.modes);
  add("d_real", structure.acoustic_lines);
  add("d_imaginary", structure.acoustic_lines);
  if (structure.damping_follows_amplitude)
    add("growing_damping", ColumnsOf(SlowChange::kDamping).count);
  if (structure.frequency_drifts)
    add("drifting_frequency", ColumnsOf(SlowChange::kFrequency).count);
  add("tau", 1);
  if (structure.HasSpread()) add("rho", 1);
  if (structure.second_path) {
    add("share", 1);
    add("lambda", 1);
  }
  add("c", flame);
  add("e_real", structure.flame_lines);
  add("e_imaginary", structure.flame_lines);
  if (structure.delay_follows_amplitude) add("moving_delay", ColumnsOf(SlowChange::kDelay).count);
  if (structure.gain_follows_amplitude) add("moving_gain", ColumnsOf(SlowChange::kGain).count);
  for (const NoiseTerm& term : structure.noise) {
    add(std::string(LoopNoiseName(term.source)), term.coefficients);
  }
  if (HasBackground(structure.noise)) add("background_ratio", 1);
  CHECK_EQ(static_cast<Eigen::Index>(out.size()), structure.Parameters(flame));
  return out;
}

PointPrior WithKnown(PointPrior prior, const std::vector<std::string>& labels,
                     const PointPrior& known, const std::vector<std::string>& known_labels) {
  std::map<std::string, Eigen::Index> at;
  for (std::size_t i = 0; i < known_labels.size(); ++i) {
    at[known_labels[i]] = static_cast<Eigen::Index>(i);
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto found = at.find(labels[i]);
    if (found == at.end()) continue;
    prior.mean[static_cast<Eigen::Index>(i)] = known.mean[found->second];
    prior.deviation[static_cast<Eigen::Index>(i)] = known.deviation[found->second];
  }
  return prior;
}

}  // namespace howl
