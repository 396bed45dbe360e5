#include "app/text/health_text.h"

#include <cstddef>
#include <iterator>

#include "app/text/text_table.h"

namespace howl {
namespace {

constexpr std::size_t kShownOfAKind = 4;
constexpr std::size_t kIndent = 4;
// The order of the kinds: a mistake comes first, because it explains the findings below it.
constexpr FindingKind kOrder[] = {
    FindingKind::kMistake,      FindingKind::kSampling,  FindingKind::kSamples,
    FindingKind::kNotConverged, FindingKind::kGuardRail, FindingKind::kBound,
    FindingKind::kResidual,     FindingKind::kState,     FindingKind::kSetup};
static_assert(std::size(kOrder) == kFindingKinds, "a finding of any kind is printed");

}  // namespace

std::string HealthText(const Health& health, const std::string& sound, const std::string& file) {
  if (health.empty()) return Wrapped("health: " + sound, 2) + "\n";
  std::string text = Bold("health: " + std::to_string(health.size()) +
                          (health.size() == 1 ? " finding" : " findings")) +
                     "\n";
  for (const FindingKind kind : kOrder) {
    std::size_t count = 0;
    for (const Finding& finding : health) {
      if (finding.kind != kind || ++count > kShownOfAKind) continue;
      text += Wrapped("  " + finding.text, kIndent) + "\n";
    }
    if (count > kShownOfAKind) {
      text +=
          "  and " + std::to_string(count - kShownOfAKind) + " more like these, in " + file + "\n";
    }
  }
  return text;
}

}  // namespace howl
