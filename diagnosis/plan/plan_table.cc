#include "diagnosis/plan/plan_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/verdict/verdict.h"
#include "estimation/parallel.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

// The size from rung to rung: the reference, twice the smallest size, is one rung up or two.
constexpr double kWideStep = 2.0;
constexpr double kNarrowStep = 1.4142135623730951;
constexpr double kSteep = 3.0;  // a power of the size, of the gain
constexpr int kRungsBelow = 1;
constexpr int kRungsAbove = 7;
constexpr double kLeastPower = 1.5;  // of the gain in the size: two where the effect is linear
constexpr double kMostPower = 8.0;
constexpr double kReference = 1.9;   // twice, less what interpolation may be off
constexpr int kRounds = 8;           // of the search for the size that is seen
constexpr double kNearEnough = 1.3;  // of the gain that is needed

// Where the gain of a line is followed to the one that is needed, as a power of the size.
struct Approach {
  double size = 0.0;
  double gain = 0.0;
  double power = 2.0;
  bool done = false;

  // The size that is to be looked at next, `found` being the gain at `at`.
  void Take(double found, double at, double needed, double largest) {
    const double ratio = found / gain;
    if (gain > 0.0 && found > 0.0 && at != size) {
      power = std::clamp(std::log(ratio) / std::log(at / size), kLeastPower, kMostPower);
    }
    size = at;
    gain = found;
    done = found > needed / kNearEnough && found < needed * kNearEnough;
    done = done || (at >= largest && found < needed);
  }
  double Next(double needed, double largest) const {
    if (!(gain > 0.0)) return largest;
    return std::min(size * std::pow(needed / gain, 1.0 / power), largest);
  }
};

// By interpolation of the gain as a power of the size.
double SmallestSeen(const std::vector<Rung>& rungs, double needed) {
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    if (rungs[k].gain < needed) continue;
    if (k == 0 || !(rungs[k - 1].gain > 0.0)) return rungs[k].size;
    const Rung& below = rungs[k - 1];
    const double share = std::log(needed / below.gain) / std::log(rungs[k].gain / below.gain);
    return below.size * std::pow(rungs[k].size / below.size, share);
  }
  return kInfinity;
}

}  // namespace

double GainNeeded(const Effect& effect, EffectValues x, const EffectContext& at) {
  const bool flame_alone =
      !effect.ChangesAcousticCut() || effect.PressureLeak(at.cycle_frequency_hz, at, x) != 0.0;
  return DetectionGain(flame_alone) +
         PriceOfParameters(static_cast<double>(effect.parameters().size()));
}

std::vector<PointProducts> ProductsOfAll(const std::vector<WeighedPoint>& points,
                                         const std::vector<EffectLine>& lines,
                                         const std::vector<PlanEntry>& entries, int threads) {
  std::vector<PointProducts> products(points.size());
  RunUnits(points.size(), threads, [&](std::size_t e) {
    products[e] = ProductsOf(*points[e].point, lines, entries, points[e].scale);
  });
  return products;
}

namespace {

std::vector<Approach> Follow(const PlanTable& table, const std::vector<WeighedPoint>& points,
                             const std::function<double(std::size_t)>& needed, int threads) {
  std::vector<Approach> approaches(table.lines.size());
  for (int round = 0; round < kRounds; ++round) {
    std::vector<PlanEntry> entries;
    for (std::size_t l = 0; l < approaches.size(); ++l) {
      const EffectLine& line = table.lines[l];
      const Approach& now = approaches[l];
      if (!now.done) {
        entries.push_back({l, round == 0 ? line.typical : now.Next(needed(l), line.largest)});
      }
    }
    std::vector<PointProducts> squares(points.size());
    RunUnits(points.size(), threads, [&](std::size_t e) {
      squares[e] = SquaresOf(*points[e].point, table.lines, entries, points[e].scale);
    });
    const PlanGains gains(std::move(squares), table.log_delays);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::size_t l = entries[i].line;
      const EffectLine& line = table.lines[l];
      approaches[l].Take(gains.Gain(i, line.effect->parameters().size()), entries[i].size,
                         needed(l), line.largest);
    }
  }
  return approaches;
}

}  // namespace

PlanTable MakePlanTable(std::vector<EffectLine> lines, const std::vector<WeighedPoint>& points,
                        std::vector<double> log_delays, const EffectContext& at, int threads) {
  PlanTable table;
  table.lines = std::move(lines);
  table.log_delays = std::move(log_delays);
  table.ladders.resize(table.lines.size());
  const auto parameters = [&](std::size_t l) { return table.lines[l].effect->parameters().size(); };
  const auto needed = [&](std::size_t l) {
    const EffectLine& line = table.lines[l];
    return GainNeeded(*line.effect, line.ValuesAt(line.typical), at);
  };
  const std::vector<Approach> approaches = Follow(table, points, needed, threads);
  for (std::size_t l = 0; l < table.lines.size(); ++l) {
    Ladder& ladder = table.ladders[l];
    const double largest = table.lines[l].largest;
    const double anchor = approaches[l].Next(needed(l), largest);
    ladder.step = approaches[l].power > kSteep ? kNarrowStep : kWideStep;
    for (int k = -kRungsBelow; k <= kRungsAbove; ++k) {
      const double size = anchor * std::pow(ladder.step, k);
      if (size > largest * (1.0 + 1e-9)) break;
      ladder.rungs.push_back({table.entries.size(), size, 0.0});
      table.entries.push_back({l, size});
    }
  }
  table.products = ProductsOfAll(points, table.lines, table.entries, threads);
  const PlanGains gains = table.Gains();
  for (std::size_t l = 0; l < table.lines.size(); ++l) {
    Ladder& ladder = table.ladders[l];
    for (Rung& rung : ladder.rungs) rung.gain = gains.Gain(rung.entry, parameters(l));
    ladder.smallest = SmallestSeen(ladder.rungs, needed(l));
  }
  return table;
}

double NatsBetween(const PlanTable& table, const PlanGains& gains, std::size_t i, std::size_t line,
                   const std::string& rival) {
  const double scatter = gains.ScatterOf(i);
  const double own = gains.Product(i, i, scatter);
  double least = own;  // where the rival's size is its null
  std::size_t parameters = 0;
  for (std::size_t l = 0; l < table.lines.size(); ++l) {
    const EffectLine& other = table.lines[l];
    if (other.effect->id() != rival) continue;
    parameters = other.effect->parameters().size();
    const Ladder& ladder = table.ladders[l];
    const double reach = std::sqrt(ladder.step);
    for (std::size_t k = 0; k < ladder.rungs.size(); ++k) {
      const std::size_t j = ladder.rungs[k].entry;
      const double norm = gains.Product(j, j, scatter);
      if (!(norm > 0.0)) continue;
      const double with = gains.Product(i, j, scatter);
      // The rival's size lies within half a step of the rung; below the lowest it goes to null.
      const double lowest = k == 0 ? 0.0 : 1.0 / reach;
      const double size = std::clamp(std::abs(with) / norm, lowest, reach);
      const double factor = with < 0.0 && other.both_signs ? -size : size;
      least = std::min(least, own - 2.0 * factor * with + factor * factor * norm);
    }
  }
  const std::size_t own_parameters = table.lines[line].effect->parameters().size();
  return std::max(least, 0.0) + PriceOfParameters(static_cast<double>(parameters)) -
         PriceOfParameters(static_cast<double>(own_parameters));
}

double NatsToTellApart(double gain, const Effect& effect) {
  const double paid = gain - PriceOfParameters(static_cast<double>(effect.parameters().size()));
  return -std::log(kClassProbability) * Temperature(paid);
}

const Rung* ReferenceRung(const Ladder& ladder) {
  if (!std::isfinite(ladder.smallest)) return nullptr;
  for (const Rung& rung : ladder.rungs) {
    if (rung.size >= kReference * ladder.smallest) return &rung;
  }
  return &ladder.rungs.back();
}

}  // namespace howl
