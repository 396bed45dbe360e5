// A budget on one line, as studies of many rigs print it.
#ifndef HOWL_BENCH_BUDGET_ROW_H_
#define HOWL_BENCH_BUDGET_ROW_H_

#include <cstdio>
#include <string>

#include "diagnosis/verdict/budget.h"

namespace howl {

// What the samples show, the gap, and each item with the nats that are lost without it, its
// parameters and its class. The line is left open.
inline void PrintBudget(const Budget& budget) {
  for (const SampleFact& fact : budget.seen_in_samples) std::printf("%s ", fact.effect.c_str());
  std::printf("gap %.3f to %.3f |", budget.gap_before, budget.gap_left);
  for (const BudgetEntry& entry : budget.entries) {
    std::printf(" %s (%.0f nats, %zu of %zu", entry.item.c_str(), entry.lost_nats,
                entry.experiments_better, budget.experiments);
    for (const EstimatedParameter& p : entry.parameters) {
      std::printf(", %s %.4g, %.4g .. %.4g", p.name.c_str(), p.value, p.low, p.high);
    }
    std::printf(")");
    for (const std::string& other : entry.equals) std::printf(" = %s", other.c_str());
  }
}

}  // namespace howl

#endif  // HOWL_BENCH_BUDGET_ROW_H_
