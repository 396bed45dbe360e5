#include "app/text/loop_gain_text.h"

#include <algorithm>
#include <array>
#include <vector>

#include "app/text/text_table.h"
#include "estimation/analysis/loop/loop_gain_reason.h"

namespace howl {
namespace {

// "0.05 .. 0.07", or "0.05" where both print alike.
std::string RangeText(const std::vector<LowLoopGain>& all, double LowLoopGain::*field,
                      int decimals) {
  const auto [low, high] = std::minmax_element(
      all.begin(), all.end(),
      [&](const LowLoopGain& a, const LowLoopGain& b) { return a.*field < b.*field; });
  const std::string first = Fixed((*low).*field, decimals), last = Fixed((*high).*field, decimals);
  return first == last ? first : first + " .. " + last;
}

std::string Reason(LoopGainReason reason, const std::vector<LowLoopGain>& all) {
  switch (reason) {
    case LoopGainReason::kSteeperInCycle:
      return "the flame is steeper in the cycle than at rest (the third harmonic of q is " +
             RangeText(all, &LowLoopGain::third_harmonic, 3) +
             " of the first and in phase with it; where a flame saturates it is negative). By "
             "(1b) the describing function's loop gain is 1 at the cycle; by this curve it would "
             "grow with the amplitude, as its power " +
             RangeText(all, &LowLoopGain::stiffening, 2) +
             ": so something else limits the cycle (damping or a flame that change with its "
             "amplitude), or the q sensor is not linear";
    case LoopGainReason::kMemory:
      return "the third harmonic of q is turned by " + RangeText(all, &LowLoopGain::turn_deg, 0) +
             " degrees against a flame without memory: a flame or a q sensor with memory, or a "
             "dispersed delay; the curve of q over dp/dt is then not Phi";
    case LoopGainReason::kNoise:
      return "noise of p in the regressor (variance " +
             RangeText(all, &LowLoopGain::regressor_noise, 3) +
             " of its own) flattens the curve by more than can be taken out";
    case LoopGainReason::kNotExplained:
      break;
  }
  return "the records do not show why (the mean cycle of q alone gives " +
         RangeText(all, &LowLoopGain::shape_gain, 2) + ")";
}

}  // namespace

std::string LowLoopGainText(const AnalysisSet& set) {
  std::string text;
  for (const LoopGainReason reason : {LoopGainReason::kSteeperInCycle, LoopGainReason::kMemory,
                                      LoopGainReason::kNoise, LoopGainReason::kNotExplained}) {
    std::vector<LowLoopGain> all;
    std::string names;
    for (const Analysis& analysis : set.analyses) {
      if (!analysis.low_loop_gain || analysis.low_loop_gain->reason != reason) continue;
      all.push_back(*analysis.low_loop_gain);
      names += (names.empty() ? "" : ", ") + analysis.name;
    }
    if (all.empty()) continue;
    text +=
        Wrapped("loop gain below one in a limit cycle (" + names + "): " + Reason(reason, all), 2) +
        "\n";
  }
  return text;
}

}  // namespace howl
