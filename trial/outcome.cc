#include "trial/outcome.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace howl {

double SizeAtSeverity(const RigEffect& effect, double severity) {
  const std::size_t upper = severity > kSeverities[1] ? 2 : 1;
  const double part =
      (severity - kSeverities[upper - 1]) / (kSeverities[upper] - kSeverities[upper - 1]);
  return effect.sizes[upper - 1] * std::pow(effect.sizes[upper] / effect.sizes[upper - 1], part);
}

std::string SeverityName(double severity) {
  if (severity == kSeverities[0]) return "small";
  if (severity == kSeverities[1]) return "medium";
  if (severity == kSeverities[2]) return "large";
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", severity);
  return text;
}

TruthKind CaseOutcome::Truth() const {
  if (withheld.empty()) return TruthKind::kNone;
  if (withheld.size() > 1) return TruthKind::kPair;
  return withheld[0].in_catalogue ? TruthKind::kCatalogue : TruthKind::kOutside;
}

std::string CaseOutcome::TruthName() const {
  switch (Truth()) {
    case TruthKind::kNone:
      return "none";
    case TruthKind::kOutside:
      return "unknown";
    case TruthKind::kCatalogue:
      return withheld[0].id;
    case TruthKind::kPair:
      break;
  }
  return withheld[0].id + "+" + withheld[1].id;
}

std::string CaseOutcome::AnswerName() const {
  if (!answered) return "failed";
  return kind == "effect" ? effect : kind;
}

double CaseOutcome::Severity() const {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const WithheldEffect& each : withheld) largest = std::fmax(largest, each.severity);
  return largest;
}

}  // namespace howl
