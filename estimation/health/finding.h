// The health of a fit or of an analysis: what speaks against taking its numbers as they stand.
// A finding never changes a number; a fit with none may still be of the wrong model.
#ifndef HOWL_ESTIMATION_HEALTH_FINDING_H_
#define HOWL_ESTIMATION_HEALTH_FINDING_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

enum class FindingKind : std::uint8_t {
  kNotConverged,  // of the solver
  kGuardRail,     // a parameter at a bound that no one set
  kBound,         // a parameter at a bound that the config set, or at its physical end
  kResidual,      // data that the fit misses: beyond three standard deviations, or a whole transfer
  kMistake,       // what the data look like, and would not without it
  kSampling,      // a sampling rate that leaves no room for a cycle
  kState,         // no limit cycle, intermittent, not stationary: by which criterion
  kSamples,       // clipped, stuck, held, coarse
  kSetup          // what stands between the experiments and a command that could be asked
};

constexpr std::size_t kFindingKinds = 9;

// The kind's name in files.
constexpr std::string_view FindingKindName(FindingKind kind) {
  constexpr std::array<std::string_view, kFindingKinds> kNames = {
      "not_converged", "guard_rail", "bound",   "residual", "mistake",
      "sampling",      "state",      "samples", "setup"};
  return kNames[static_cast<std::size_t>(kind)];
}

struct Finding {
  FindingKind kind = FindingKind::kResidual;
  std::string experiment;  // empty: of all, or of none in particular
  std::string subject;     // parameter, residual, criterion or mistake
  // The number and what it was held against: a bound, a threshold in the same unit, or the cost
  // before and after a mistake is undone. NaN where there is none.
  double value = std::numeric_limits<double>::quiet_NaN();
  double limit = std::numeric_limits<double>::quiet_NaN();
  std::string text;  // a sentence for a reader, without a full stop
};

using Health = std::vector<Finding>;

inline void Append(Health more, Health& health) {
  std::ranges::move(more, std::back_inserter(health));
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_FINDING_H_
