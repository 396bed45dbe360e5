#include "estimation/health/gain_health.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "estimation/health/number_words.h"

namespace howl {
namespace {

constexpr double kAnotherUnit = 31.6;  // sqrt(1000)

}  // namespace

Health CheckGains(std::vector<NamedGain> gains) {
  std::erase_if(
      gains, [](const NamedGain& each) { return !(each.gain > 0.0) || !std::isfinite(each.gain); });
  std::ranges::sort(gains, {}, &NamedGain::gain);
  std::size_t above = 0;  // the first of the larger gains
  double ratio = kAnotherUnit;
  for (std::size_t i = 1; i < gains.size(); ++i) {
    if (gains[i].gain / gains[i - 1].gain <= ratio) continue;
    ratio = gains[i].gain / gains[i - 1].gain;
    above = i;
  }
  if (above == 0) return {};
  const bool few_are_small = above < gains.size() - above;
  const std::size_t first = few_are_small ? 0 : above;
  const std::size_t end = few_are_small ? above : gains.size();
  const NamedGain& other = gains[few_are_small ? above : above - 1];
  Health health;
  for (std::size_t i = first; i < end; ++i) {
    health.push_back({FindingKind::kMistake, gains[i].name, "gain_unit", gains[i].gain, other.gain,
                      gains[i].name + ": its gain |p| / |q|, " + NumberWord(gains[i].gain, 4) +
                          ", is " + NumberWord(gains[i].gain / other.gain, 4) + " times that of " +
                          other.name + ", " + NumberWord(other.gain, 4) +
                          ", as where p or q of one of them is in another unit (Pa, kPa)"});
  }
  return health;
}

Health CheckGains(const std::vector<Experiment>& experiments) {
  std::vector<NamedGain> gains;
  for (const Experiment& each : experiments) gains.push_back({each.name, each.gain});
  return CheckGains(std::move(gains));
}

}  // namespace howl
