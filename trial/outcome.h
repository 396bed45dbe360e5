// The outcome of a blind trial's cases: the effects that were withheld, and the diagnosis.
#ifndef HOWL_TRIAL_OUTCOME_H_
#define HOWL_TRIAL_OUTCOME_H_

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace howl {

// An effect that the rig can have.
struct RigEffect {
  std::string id;
  std::string block;  // several where it depends on the draw: "p_instrument or q_instrument"
  bool in_catalogue = true;
  std::string size_name;          // the parameter that carries its size ...
  std::array<double, 3> sizes{};  // ... when small, medium and large
};

// Severities as numbers; sizes lie evenly in the logarithm between them.
inline constexpr std::array<double, 3> kSeverities = {0.25, 0.55, 0.85};
double SizeAtSeverity(const RigEffect& effect, double severity);
std::string SeverityName(double severity);

struct WithheldEffect {
  std::string id;
  std::string block;
  bool in_catalogue = true;
  double severity = 0.0;
};

enum class TruthKind : std::uint8_t { kNone, kCatalogue, kOutside, kPair };

struct CandidateOutcome {
  std::string effect;
  double gap_after = 0.0;
  double shrinkage = 0.0;
  double gain = 0.0;            // of log-likelihood, less a penalty for its parameters
  double in_sample_gain = 0.0;  // without the penalty
};

struct CaseOutcome {
  std::string name;
  std::vector<WithheldEffect> withheld;  // none, one or two

  bool answered = false;  // false: the diagnosis failed
  std::string kind;       // none, effect, unknown
  std::string effect;
  std::vector<std::string> indistinguishable;
  std::map<std::string, double> probability;  // effects, "none", "unknown"
  std::vector<std::string> blocks;            // the most probable first
  double gap_before = 0.0;
  double gap_after = 0.0;
  double gap_floor = 0.0;
  std::vector<CandidateOutcome> candidates;
  double seconds = 0.0;

  TruthKind Truth() const;
  // "none", the effect's identifier, "unknown" for an effect from outside the catalogue, or "A+B"
  // for two effects.
  std::string TruthName() const;
  // The answer in the same words.
  std::string AnswerName() const;
  double Severity() const;  // the largest; NaN without an effect
};

}  // namespace howl

#endif  // HOWL_TRIAL_OUTCOME_H_
