// The loop's free parameters: which are shared by all experiments, which each experiment has of its
// own, where the search starts, and the guard rails that it keeps to.
#ifndef HOWL_ESTIMATION_PARAMETERS_H_
#define HOWL_ESTIMATION_PARAMETERS_H_

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/loop/loop.h"

namespace howl {

// kMOverN takes kM's place when the config gives the second mode relative to the first.
enum class ParameterKind { kOmega, kXi, kN, kM, kMOverN, kTau };

inline constexpr std::array kParameterKinds = {ParameterKind::kOmega,  ParameterKind::kXi,
                                               ParameterKind::kN,      ParameterKind::kM,
                                               ParameterKind::kMOverN, ParameterKind::kTau};
inline constexpr std::size_t kNumParameterKinds = kParameterKinds.size();

// The name in configs and files: "omega_hz", "xi", "N", "M", "M_over_N", "tau_s".
constexpr std::string_view ParameterName(ParameterKind kind) {
  constexpr std::array<std::string_view, kNumParameterKinds> kNames = {"omega_hz", "xi",   "N", "M",
                                                                       "M_over_N", "tau_s"};
  return kNames[static_cast<std::size_t>(kind)];
}

enum class ParameterScope { kExperiment, kShared };

struct ParameterSpec {
  ParameterScope scope = ParameterScope::kExperiment;
  std::optional<double> initial;  // default: from the data, by the closed form
  double min = 0.0;               // natural units; zero and infinity: none of its own, so that
  double max = 0.0;               // the search keeps to what the data suggest (search_range.h)
  bool fixed = false;             // held at `initial`
};

// A parameter of one experiment alone, in the place of what holds for all of them; its scope is
// kExperiment.
struct OwnParameter {
  std::string experiment;
  ParameterKind kind = ParameterKind::kXi;
  ParameterSpec spec;
};

struct ModelSpec {
  int modes = 1;  // 1: N alone; 2: N, and M or M_over_N
  double harmonic_ratio = kPaperHarmonicRatio;
  bool second_mode_relative = false;  // the free parameter is M / N instead of M
  std::array<ParameterSpec, kNumParameterKinds> parameters;
  std::vector<OwnParameter> own;

  ParameterSpec& operator[](ParameterKind kind) {
    return parameters[static_cast<std::size_t>(kind)];
  }
  const ParameterSpec& operator[](ParameterKind kind) const {
    return parameters[static_cast<std::size_t>(kind)];
  }
  // The specification for an experiment: its own, or that for all.
  const ParameterSpec& Of(ParameterKind kind, std::string_view experiment) const;
  bool Uses(ParameterKind kind) const {
    if (kind == ParameterKind::kM) return modes == 2 && !second_mode_relative;
    if (kind == ParameterKind::kMOverN) return modes == 2 && second_mode_relative;
    return true;
  }
};

// Documented defaults: all but the second mode per experiment; wide guard rails.
ModelSpec DefaultModelSpec();

// One model of one experiment, in natural units.
struct LoopModel {
  double omega_hz = 0.0;
  double xi = 0.0;
  double N = 0.0;
  double M = 0.0;
  double tau_s = 0.0;
  double harmonic_ratio = kPaperHarmonicRatio;

  LoopParameters<double> Loop() const { return {{omega_hz, xi, N, M, harmonic_ratio}, tau_s}; }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_PARAMETERS_H_
