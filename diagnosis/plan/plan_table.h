// The sizes at which a plan looks at its effects, with the products of all their changes, and what
// follows from them: smallest sizes and separations. Inner workings of plan.h.
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_TABLE_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_TABLE_H_

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/plan/plan_gains.h"

namespace howl {

// One size of a line, of those that go up from less than the smallest that is seen.
struct Rung {
  std::size_t entry = 0;
  double size = 0.0;
  double gain = 0.0;
};

struct Ladder {
  std::vector<Rung> rungs;  // ascending
  double step = 2.0;        // of the size from rung to rung
  double smallest = 0.0;    // size that is seen; infinite: none within the bounds
};

// The gain that an effect must have to be seen: the diagnosis' own, and the price of its
// parameters.
double GainNeeded(const Effect& effect, EffectValues x, const EffectContext& at);

// What an experiment of the plan counts for: a record that was cut down stands for its whole.
struct WeighedPoint {
  std::unique_ptr<PlanPoint> point;
  double scale = 1.0;
};

struct PlanTable {
  std::vector<EffectLine> lines;
  std::vector<PlanEntry> entries;
  std::vector<Ladder> ladders;  // one for each line
  std::vector<PointProducts> products;
  std::vector<double> log_delays;

  PlanGains Gains() const { return {products, log_delays}; }
};

PlanTable MakePlanTable(std::vector<EffectLine> lines, const std::vector<WeighedPoint>& points,
                        std::vector<double> log_delays, const EffectContext& at, int threads);

// Products of these entries alone, for one more experiment.
std::vector<PointProducts> ProductsOfAll(const std::vector<WeighedPoint>& points,
                                         const std::vector<EffectLine>& lines,
                                         const std::vector<PlanEntry>& entries, int threads);

// The nats that entry i keeps over the best that the lines of effect `rival` do in its place, the
// prices of both effects' parameters counted.
double NatsBetween(const PlanTable& table, const PlanGains& gains, std::size_t i, std::size_t line,
                   const std::string& rival);

// How many nats are odds of 50 to 1, where the better of two effects gains so much.
double NatsToTellApart(double gain, const Effect& effect);

// The rung of a line at twice its smallest size, or the highest below; null: the line is not seen.
const Rung* ReferenceRung(const Ladder& ladder);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_TABLE_H_
