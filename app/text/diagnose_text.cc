#include "app/text/diagnose_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/text/budget_text.h"
#include "app/text/place_text.h"
#include "app/text/text_table.h"
#include "io/results/verdict_remarks.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr std::size_t kShownCandidates = 5;
constexpr std::size_t kShownMoved = 4;
constexpr double kMovedShare = 0.03;

// Base parameters that had absorbed the effect; empty if none had.
std::string MovedText(const Diagnosis& diagnosis) {
  std::string text;
  for (const MovedParameter& p :
       FarthestMoved(diagnosis.base_parameters, kShownMoved, kMovedShare)) {
    text += text.empty() ? "the fit without it had absorbed some: " : ", ";
    text += p.name + " " + Significant(p.without, 4) + " for " + Significant(p.with, 4);
  }
  return text.empty() ? text : Wrapped(text, 2) + "\n";
}

// The note where the best candidate is at a bound: its size then comes from the search, not from
// the data.
std::string BoundText(const Diagnosis& diagnosis) {
  if (diagnosis.candidates.empty()) return "";
  const Candidate& best = diagnosis.candidates.front();
  std::string names;
  for (const EstimatedParameter& parameter : best.parameters) {
    if (parameter.at_bound) names += (names.empty() ? "" : ", ") + parameter.name;
  }
  if (names.empty()) return "";
  return Wrapped(best.effect + ": at a bound of the search: " + names +
                     "; the data ask for more than the catalogue allows, or for none of it",
                 2) +
         "\n";
}

// Cells of the map that are more than noise.
std::string MapText(const Diagnosis& diagnosis) {
  const auto count = [&](bool GapCell::*found) {
    return std::to_string(std::ranges::count(diagnosis.map, true, found));
  };
  if (diagnosis.map.empty()) return "";
  std::string text = "map: " + count(&GapCell::before_found) + " of " +
                     std::to_string(diagnosis.map.size()) + " cells are more than noise";
  if (!std::isnan(diagnosis.map[0].after)) text += ", " + count(&GapCell::after_found) + " after";
  return text + "\n";
}

// The base: the loop to which each effect is added.
std::string BaseText(const Diagnosis& diagnosis) {
  std::string text = "base: ";
  text += diagnosis.model.modes == 1
              ? "one mode"
              : "two modes, ratio " + Significant(diagnosis.model.harmonic_ratio, 4);
  if (std::isfinite(diagnosis.second_mode_gain)) {
    text += " (the config states no modes: a second gains " + Fixed(diagnosis.second_mode_gain, 1) +
            " nats)";
  }
  text += diagnosis.model.own_delays
              ? "; the delays scatter by " + Fixed(kPerCent * diagnosis.delay_scatter, 2) + " %"
              : "; one delay for all";
  if (std::isfinite(diagnosis.own_delays_gain)) {
    text += " (the config states no scope of tau_s: own delays gain " +
            Fixed(diagnosis.own_delays_gain, 1) + " nats)";
  }
  return Wrapped(text, 2) + "\n";
}

}  // namespace

void PrintDiagnosis(const Diagnosis& diagnosis) {
  switch (diagnosis.kind) {
    case VerdictKind::kNone:
      std::printf("verdict: none; the model's residuals are noise (probability %.2f)\n",
                  diagnosis.probability_none);
      break;
    case VerdictKind::kUnknown:
      std::printf(
          "verdict: unknown; no effect of the catalogue explains the gap (probability "
          "%.2f)\n",
          diagnosis.probability_unknown);
      if (!diagnosis.together.empty()) {
        std::printf("%s\n", Wrapped("  " + RemarkOnTogether(diagnosis.together), 2).c_str());
      }
      break;
    case VerdictKind::kEffect:
      std::printf("verdict: %s (probability %.2f)\n", diagnosis.effect.c_str(),
                  diagnosis.candidates.front().probability);
      for (const std::string& other : diagnosis.indistinguishable) {
        std::printf("  the data cannot tell it from %s\n", other.c_str());
      }
      break;
  }
  for (const Place& place : diagnosis.where) {
    std::printf("where: %s, %s\n", std::string(LoopBlockName(place.block)).c_str(),
                ExtentText(place).c_str());
  }
  // Of a lone experiment nothing can be held out: its gap is that of the fit to itself.
  const auto is_other = [&](const GapCell& cell) {
    return cell.experiment != diagnosis.map[0].experiment;
  };
  const bool lone = !diagnosis.map.empty() && std::ranges::none_of(diagnosis.map, is_other);
  std::printf("gap, %s: %.3f before, %.3f after; floor %.3f\n",
              lone ? "not held out (one experiment)" : "held out", diagnosis.gap_before,
              diagnosis.gap_after, diagnosis.gap_floor);
  std::printf("%s", BaseText(diagnosis).c_str());
  std::printf("%s", MapText(diagnosis).c_str());
  if (std::isfinite(diagnosis.placebo_shrinkage)) {
    std::printf("a placebo effect, as free as the best, shrinks it by %.1f %%\n",
                kPerCent * diagnosis.placebo_shrinkage);
  }
  if (!diagnosis.bootstrap_gains.empty()) {
    std::printf("noise alone, in %zu rigs simulated from the refitted base, gains at most %.1f\n",
                diagnosis.bootstrap_gains.size(), diagnosis.bootstrap_gains.back());
  }
  TextTable table({"candidate", "probability", "gain", "gap after", "shrinks %", "estimate"});
  for (std::size_t i = 0; i < std::min(kShownCandidates, diagnosis.candidates.size()); ++i) {
    const Candidate& candidate = diagnosis.candidates[i];
    table.AddRow({candidate.effect, Fixed(candidate.probability, 3), Fixed(candidate.gain, 1),
                  Fixed(candidate.gap_after, 3), Fixed(kPerCent * candidate.shrinkage, 1),
                  ParameterText(candidate.parameters)});
  }
  std::printf("%s", table.Text().c_str());
  std::printf("%s", BoundText(diagnosis).c_str());
  std::printf("%s", MovedText(diagnosis).c_str());
  std::printf("%s\n", Wrapped("next: " + diagnosis.advice, 2).c_str());
}

}  // namespace howl
